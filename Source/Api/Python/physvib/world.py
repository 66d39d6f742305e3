# SPDX-License-Identifier: MIT
"""A world of anybody's engine: contacts in, events out."""
from __future__ import annotations

import contextlib
import ctypes
from collections.abc import Sequence
from ctypes import c_void_p
from functools import partial
from typing import Iterator, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._header import POINT_BY_PLACE, SOFT_WHOLE, CBody, CContact, COutputFacts, CWorldCounts, CWorldSettings
from ._library import Owned, PhysVibError, blank_events, call, explained, filled
from .renderer import Renderer

VOICES = ("own", "other", "both")
NOTES = ("sensor", "filtered", "disabled", "asleep")

#: Of `point_id`: the points of a pair are told apart by their places.
#: Of `is_soft`: the impulse is all that the bodies were given in the step. True, or 1, is a load that is no measure of an impact.


class Counts(NamedTuple):
    """What became of contacts, since the world was made."""
    contacts: int         #: pairs that began to touch, and new points of pairs
    below_threshold: int  #: of haptic sources (is_camera): slower than the threshold
    no_source: int        #: neither of the two bodies is a haptic source
    unplayable: int       #: impacts without a frequency, a mass, or outside of what can be played
    muted: int            #: by is_muted, or a gain of 0
    dropped: int          #: more in a step than there is room for, or than hits_per_step
    events: int           #: made
    threshold_m_per_s: float  #: in effect


def _numbers(name: str, found: Sequence[float], count: int) -> ctypes.Array[ctypes.c_double]:
    if len(found) != count:
        raise PhysVibError(f"{name}: expected {count} numbers", -2)
    return (ctypes.c_double * count)(*found)


class World(Owned):
    """Tell which bodies there are and, in each step, which of them touch. Bodies are numbers of yours, from 0 on, and stand in the
    events. None: as physvib.h says under the same name."""
    _frees = "world_free"

    def __init__(self, *, field_width_m: float | None = None, field_x_m: float | None = None, field_y_m: float | None = None, field_radians: float | None = None,
                 normalisation_s_per_m: float | None = None, hand_mass_kg: float | None = None, drive_gain: float | None = None,
                 threshold_m_per_s: float | None = None, hits_per_step: int | None = None, at_body: bool = False, is_muted: bool = False,
                 drops_hits_of_removed: bool = False, full_scale_impulse_n_s: float | None = None, settling_s: float | None = None) -> None:
        self._handle = c_void_p()
        self._chosen = {"field_width_m": field_width_m, "field_x_m": field_x_m, "field_y_m": field_y_m, "field_radians": field_radians,
                        "normalisation_s_per_m": normalisation_s_per_m, "hand_mass_kg": hand_mass_kg, "drive_gain": drive_gain,
                        "threshold_m_per_s": threshold_m_per_s, "hits_per_step": hits_per_step, "at_body": int(at_body), "is_muted": int(is_muted),
                        "drops_hits_of_removed": int(drops_hits_of_removed), "full_scale_impulse_n_s": full_scale_impulse_n_s, "settling_s": settling_s}
        call("world_create", ctypes.byref(filled(CWorldSettings, "world_settings_init", **self._chosen)), ctypes.byref(self._handle))

    def configure(self, **changed: float | bool | None) -> None:
        """Changes settings of the constructor from the next step on; the others stay."""
        unknown = changed.keys() - self._chosen.keys()
        if unknown:
            raise TypeError(f"configure: unknown {', '.join(sorted(unknown))}")
        chosen = {**self._chosen, **{name: int(value) if isinstance(value, bool) else value for name, value in changed.items()}}
        call("world_configure", self._handle, ctypes.byref(filled(CWorldSettings, "world_settings_init", **chosen)))
        self._chosen = chosen

    def __repr__(self) -> str:
        if not self._handle:
            return "<physvib.World, closed>"
        counts = self.counts
        return f"<physvib.World at {self.time_ns * 1e-9:.3f} s: {counts.contacts} contacts, {counts.events} events>"

    def set_body(self, body: int, *, mass_kg: float = 0.0, is_camera: bool = False, frequency_hz: float = 0.0, decay_per_s: float = 0.0, voice: str = "own",
                 surface: int = 0, inertia_kg_m2: float = 0.0, gravity_scale: float = 1.0, static_mass_kg: float = 0.0, gain: float = 1.0,
                 hand_mass_kg: float | None = None, grain_m: float = 0.0, roughness: float = 1.0, rolling: float = 0.2, is_ridged: bool = False,
                 overtones: Sequence[tuple[float, float, float]] = (), device: int = 0, part: int = 0) -> None:
        """A body, at first or again; a mass of 0 is a floor or a wall: what strikes it does not move it. Grains: see `touch`. `overtones`: at most three
        of (frequency_hz, decay_per_s, amplitude relative to the first mode). `device`: the device on which it is felt, see `follow_each`. `part`: number of the
        part of a body on whose actuators it is felt; 0: on all, by place."""
        if len(overtones) > 3:
            raise PhysVibError("overtones: expected at most 3", -2)
        if voice not in VOICES:
            raise PhysVibError(f"voice: expected one of {', '.join(VOICES)}", -2)
        values = filled(CBody, "body_init", mass_kg=mass_kg, is_camera=int(is_camera), frequency_hz=frequency_hz, decay_per_s=decay_per_s,
                        voice=VOICES.index(voice), surface=surface, inertia_kg_m2=inertia_kg_m2, gravity_scale=gravity_scale,
                        static_mass_kg=static_mass_kg, gain=gain, hand_mass_kg=hand_mass_kg, grain_m=grain_m, roughness=roughness, rolling=rolling, is_ridged=int(is_ridged), device=device, part=part)
        for i, (overtone_hz, overtone_decay, amplitude) in enumerate(overtones):
            values.overtone_hz[i], values.overtone_decay_per_s[i], values.overtone_amplitude[i] = overtone_hz, overtone_decay, amplitude
        call("world_set_body", self._handle, body, ctypes.byref(values))

    def device_of(self, body: int) -> int:
        """`device` of a body, also after it was removed; 0: of one that was never there."""
        return call("world_device", self._handle, body)

    def set_mass(self, body: int, mass_kg: float) -> None:
        """The mass that the engine gives a body now, 0: it does not move; its inertia changes by as much."""
        call("world_set_mass", self._handle, body, mass_kg)

    def remove_body(self, body: int) -> None:
        """A body that goes; not within a step."""
        call("world_remove_body", self._handle, body)

    def move(self, body: int, x_m: float, y_m: float, vx_m_per_s: float = 0.0, vy_m_per_s: float = 0.0, spin_rad_per_s: float = 0.0) -> None:
        """Centre of mass and motion before the engine's solver."""
        call("world_move", self._handle, body, x_m, y_m, vx_m_per_s, vy_m_per_s, spin_rad_per_s)

    def moved(self, body: int, vx_m_per_s: float, vy_m_per_s: float, spin_rad_per_s: float = 0.0) -> None:
        """Motion behind the engine's solver, within a step and before its contacts: impulses that they do not tell follow from momentum. `move` has the
        velocity without contacts then, so with what gravity adds in the step."""
        call("world_moved", self._handle, body, vx_m_per_s, vy_m_per_s, spin_rad_per_s)

    def move_in_space(self, body: int, centre_m: Sequence[float], velocity_m_per_s: Sequence[float] = (0.0, 0.0, 0.0),
                      spin_rad_per_s: Sequence[float] = (0.0, 0.0, 0.0), inverse_inertia_per_kg_m2: Sequence[float] | None = None) -> None:
        """`move` in space: x, y and z, the field being the plane of x and y. The inverse of the moments of inertia is a symmetric matrix in the world's axes
        (xx, yy, zz, xy, xz, yz); without it, inertia_kg_m2 counts about every axis, as of a ball."""
        turning = None if inverse_inertia_per_kg_m2 is None else _numbers("inverse_inertia_per_kg_m2", inverse_inertia_per_kg_m2, 6)
        call("world_move_in_space", self._handle, body, _numbers("centre_m", centre_m, 3), _numbers("velocity_m_per_s", velocity_m_per_s, 3),
             _numbers("spin_rad_per_s", spin_rad_per_s, 3), turning)

    def moved_in_space(self, body: int, velocity_m_per_s: Sequence[float], spin_rad_per_s: Sequence[float] = (0.0, 0.0, 0.0)) -> None:
        """`moved` in space."""
        call("world_moved_in_space", self._handle, body, _numbers("velocity_m_per_s", velocity_m_per_s, 3), _numbers("spin_rad_per_s", spin_rad_per_s, 3))

    def pair(self, surface: int, other: int, *, frequency_hz: float, decay_per_s: float, gain: float = 1.0) -> None:
        """How two kinds of surfaces sound together, whatever the camera's voice is."""
        call("world_pair", self._handle, surface, other, frequency_hz, decay_per_s, gain)

    @contextlib.contextmanager
    def step(self, seconds: float, gravity_m_per_s2: float = 9.81) -> Iterator[World]:
        """`with world.step(0.01): world.touch(...)`: the next step; it ends, and time goes on, also if you raise within it."""
        call("world_begin_step", self._handle, seconds, gravity_m_per_s2)
        try:
            yield self
        finally:
            call("world_end_step", self._handle)

    def touch(self, a: int, b: int, x_m: float = 0.0, y_m: float = 0.0, **more: float) -> None:
        """Two bodies touch in this step. A pair that did not in the step before begins; one that is not named again has ended.

        `more`: normal_x, normal_y (from a to b), in space also z_m, normal_z and friction_x_n_s, friction_y_n_s, friction_z_n_s; impulse_n_s, tangential_n_s, or approach_m_per_s with restitution and effective_mass_kg;
        fraction, or gap_m with gap_fraction; is_soft; point_id (a number, or POINT_BY_PLACE) of points that are told apart, with is_impulse_of_pair; along_a_m_per_s and along_b_m_per_s of what rolls or slides over grains: see physvib.h."""
        self._tell("world_touch", a, b, x_m, y_m, more)

    def begin(self, a: int, b: int, x_m: float = 0.0, y_m: float = 0.0, **more: float) -> None:
        """For engines that tell: parts that were apart meet. `more` as of touch."""
        self._tell("world_begin", a, b, x_m, y_m, more)

    def push(self, a: int, b: int, x_m: float = 0.0, y_m: float = 0.0, **more: float) -> None:
        """For engines that tell: a pair goes on pushing. `more` as of touch."""
        self._tell("world_push", a, b, x_m, y_m, more)

    def end(self, a: int, b: int) -> None:
        """For engines that tell: a pair has parted."""
        call("world_end", self._handle, a, b)

    def take(self, at_once: bool = False) -> NDArray[np.void]:
        """Events that are final: a step late and in order, or all of them at once. dtype EVENT, shape (n,)."""
        parts, room = [], 1024
        while True:
            part = blank_events(room)
            count = call("world_take", self._handle, part.ctypes.data, room, int(at_once))
            parts.append(part[:count])
            if count < room:
                return np.concatenate(parts)

    def send(self, renderer: Renderer, later_s: float, at_once: bool = False) -> int:
        """The same into a renderer, so much later (see play_out_s). How many."""
        return call("world_send", self._handle, renderer._handle, round(later_s * 1e9), int(at_once))

    @property
    def time_ns(self) -> int:
        """After the steps done."""
        return call("world_time_ns", self._handle)

    @property
    def drops(self) -> int:
        """Hits lost so far because more came in a step than there is room for."""
        return call("world_drops", self._handle)

    @property
    def counts(self) -> Counts:
        """What became of all contacts so far."""
        told = filled(CWorldCounts, "world_counts_init")
        call("world_get_counts", self._handle, ctypes.byref(told))
        return Counts(*[getattr(told, name) for name in Counts._fields])

    def explain(self, renderer: Renderer | None = None, **output: float | str) -> str:
        """Why nothing, or not everything, is felt of what happened since the last call: the most likely reason, one sentence. `renderer`: the one that
        plays the events, or `output`: what is known of another output (is_missing, is_silent, silent_by, trouble, channels, level, muted_channels, late,
        dropped, rejected, without_part: see physvib_output_facts)."""
        if renderer is not None:
            return explained(partial(call, "renderer_explain"), renderer._handle, self._handle)
        if output:
            values = {name: value.encode() if isinstance(value, str) else value for name, value in output.items()}
            return explained(partial(call, "world_explain_output"), self._handle, ctypes.byref(filled(COutputFacts, "output_facts_init", **values)))
        return explained(partial(call, "world_explain"), self._handle)

    def note(self, body: int, note: str) -> None:
        """What the engine says of a body now, one of NOTES; call it before `explain`, which forgets it."""
        if note not in NOTES:
            raise PhysVibError(f"note: expected one of {', '.join(NOTES)}", -2)
        call("world_note", self._handle, body, NOTES.index(note))

    @property
    def thinned(self) -> int:
        """Grains that were left out, their power being in the others."""
        return call("world_thinned", self._handle)

    def _tell(self, name: str, a: int, b: int, x_m: float, y_m: float, more: dict[str, float]) -> None:
        unknown = more.keys() - {field for field, *_ in CContact._fields_[3:]}
        if unknown:
            raise TypeError(f"{name}: unknown {', '.join(sorted(unknown))}")
        call(name, self._handle, ctypes.byref(filled(CContact, "contact_init", a=a, b=b, x_m=x_m, y_m=y_m, **more)))
