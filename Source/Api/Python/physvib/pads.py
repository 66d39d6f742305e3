# SPDX-License-Identifier: MIT
"""Motor commands of game controllers, for programs that have a rumble call of their own (SDL's, pygame's)."""
from __future__ import annotations

import ctypes
import os
from ctypes import c_void_p

import numpy as np
from numpy.typing import NDArray

from ._header import CMotors
from ._library import Owned, call, encoded
from .files import checked
from .world import World


class Pads(Owned):
    """Controllers, numbered from 0: events in, the commands of their two motors out, once per frame. Any thread; a second one waits.

    Times are those of any clock that never goes back. `profile`: a name or a file of Docs/pads.md."""
    _frees = "pads_free"

    def __init__(self, count: int = 1, *, field_m: tuple[float, float] = (1.0, 1.0), profile: str | os.PathLike[str] = "pad-generic") -> None:
        self._handle = c_void_p()
        call("pads_create", count, *field_m, encoded(profile), ctypes.byref(self._handle))
        self._motors = (CMotors * count)()

    def strike(self, pad: int, events: NDArray[np.void]) -> None:
        """Events (dtype EVENT) at the times at which they are to be felt; those that are over, at the next pull."""
        array = checked(events)
        for i in range(len(array)):
            call("pads_strike", self._handle, pad, array.ctypes.data + i * array.itemsize)

    def send(self, pad: int, world: World, later_s: float = 0.0, at_once: bool = False) -> int:
        """A world's events for one controller, so much later. How many."""
        return call("pads_send", self._handle, pad, world._handle, round(later_s * 1e9), int(at_once))

    def pull(self, until_ns: int) -> list[tuple[float, float]]:
        """The commands to send now, (low, high) of each controller, 0 to 1: the strongest since the last pull."""
        call("pads_pull", self._handle, until_ns, self._motors, len(self._motors))
        return [(motors.low, motors.high) for motors in self._motors]

    def stop(self) -> None:
        """For a pause, or a new level: discards all events, and times may begin again."""
        call("pads_stop", self._handle)

    def set_level(self, gain: float) -> None:
        """Of all events; 0 stops the motors."""
        call("pads_set_level", self._handle, gain)
