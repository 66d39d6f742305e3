# SPDX-License-Identifier: MIT
"""Materials by name: how a body vibrates, for World.set_body, and the event of one impact."""
from __future__ import annotations

import ctypes
import os
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from ._header import CBody
from ._library import blank_events, call, encoded, filled, library


class Material(TypedDict):
    """What World.set_body takes: `world.set_body(1, mass_kg=0.2, is_camera=True, **material("steel plate"))`"""
    frequency_hz: float
    decay_per_s: float
    grain_m: float
    roughness: float
    rolling: float
    is_ridged: bool


def materials() -> list[str]:
    """The names of the built-in materials that vibrate."""
    names: list[str] = []
    while (name := library.physvib_material_name(len(names))) is not None:
        names.append(name.decode())
    return names


def material(name: str, path: str | os.PathLike[str] | None = None) -> Material:
    """A built-in material, or one of the file of materials (JSON) at `path`."""
    body = filled(CBody, "body_init")
    if path is None:
        call("material", name.encode(), ctypes.byref(body))
    else:
        call("material_load", encoded(path), name.encode(), ctypes.byref(body))
    return Material(frequency_hz=body.frequency_hz, decay_per_s=body.decay_per_s, grain_m=body.grain_m, roughness=body.roughness, rolling=body.rolling,
                    is_ridged=bool(body.is_ridged))


def sound(name: str) -> int:
    """The number that the events of a sound of that name have in their field `sound`."""
    return call("sound", name.encode())


def part(name: str) -> int:
    """The number of the part of a body of that name, such as "thumb": of events' field `part`, and of layouts."""
    return call("part", name.encode())


def impact(x_m: float, y_m: float, strength: float, *, material: str | None = None) -> NDArray[np.void]:
    """One impact at time 0, dtype EVENT, shape (1,): 0 to 1 of full scale; of a built-in material, else of 200 Hz."""
    made = blank_events(1)
    call("event_of", None if material is None else material.encode(), x_m, y_m, strength, made.ctypes.data)
    return made
