# SPDX-License-Identifier: MIT
"""Devices that play: strikes at session times, and a world's contacts. libphysvib-live is loaded when one is opened."""
from __future__ import annotations

import ctypes
import os
from ctypes import c_int64, c_void_p
from functools import partial
from typing import NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from ._library import PhysVibError, encoded, explained
from ._live_header import CDevice, CLiveReceipt, CLiveSettings, CLiveStatus
from ._live_library import live_call
from .files import checked
from .layout import Layout, settings
from .world import World

BOARDS = ("none", "sought", "plays")
KINDS = ("sound", "pad", "board")


class Device(NamedTuple):
    """Something that Live can open."""
    name: str      #: "JACK:system", "PAD:Xbox Controller"
    about: str     #: what is known of it
    kind: str      #: "sound", "pad" or "board"
    channels: int  #: outputs, or motors; 0: the driver could not be asked


def devices() -> list[Device]:
    """What can be opened now. It asks the system, which takes up to seconds."""
    most = 256
    found = (CDevice * most)()
    count = min(live_call("live_devices", found, most, ctypes.sizeof(CDevice)), most)
    return [Device(one.name.decode(errors="replace"), one.about.decode(errors="replace"), KINDS[one.kind], one.channels) for one in found[:count]]


def follow_each(lives: Sequence[Live], world: World, starts_ns: Sequence[int] = ()) -> list[int]:
    """As Live.follow for a world whose bodies are felt on several devices: those with device=k on lives[k], all others on the first. `starts_ns`: what
    the last call returned."""
    starts = (c_int64 * len(lives))(*(starts_ns or [0] * len(lives)))
    live_call("live_send_each", (c_void_p * len(lives))(*[live._handle for live in lives]), len(lives), world._handle, starts)
    return list(starts)


class LiveStatus(NamedTuple):
    """As it was 20 ms ago at most."""
    is_running: bool
    is_silent: bool
    rate_hz: int
    block_frames: int
    live_modes: int
    losses: int    #: times the device had gone and was opened again
    xruns: int     #: as the device counts them; -1: it does not
    load: float
    worst_load: float
    played: int
    late: int      #: played at once, after their time
    rejected: int  #: could not be played
    trouble: str   #: what is missing; "": nothing
    board: str     #: "none", "sought" (it has gone) or "plays"
    board_sent: int  #: strikes on their way to the board so far
    board_lost: int  #: of what was struck: more than the line carries, too old, or not playable there
    dropped: int     #: came while the device did not run, or waited for it


class Receipt(NamedTuple):
    """What left for an actuator in a span of session time, measured at the device's buffer."""
    frames: int         #: that went to its output; 0: it has none
    peak: float         #: 0 to 1 of the output's full scale
    mean_square: float
    running: bool       #: all of the span left, in one piece
    opening: int        #: number of the last start of a device in the span; 0: nothing left
    over: bool          #: False: the end of the span is still to come
    kept: bool          #: False: older than a minute


class Live:
    """Strikes told from any thread are felt at session time + L, to a fraction of a frame, however busy the interpreter is: it only has
    to have told them by then. Several may be open, also on one sound card, on other outputs (`first_output`, from 0).

    `device`: "JACK:system" for instance, a board ("BOARD:auto", "BOARD:/dev/ttyACM0"), or both ("JACK:system+BOARD:auto"). `save`: a session
    file (.json) of all that is struck, written while it plays; see Session."""

    def __init__(self, device: str = "JACK:system", *, layout: str | Layout = "phone4", channels: int = 0, law: str = "auto", exponent: float = 1.0,
                 field_m: tuple[float, float] | None = None, limiter: bool = True, rate_hz: int = 0, block_frames: int = 0, steps_per_s: int = 100,
                 longest_gap_s: float = 0.001, level_db: float = -12.0, save: str | os.PathLike[str] = "", first_output: int = 0,
                 sound_output: int = -1, sound_db: float = -20.0) -> None:
        self._handle = c_void_p()
        wanted = CLiveSettings()
        live_call("live_settings_init", ctypes.byref(wanted), ctypes.sizeof(wanted))
        wanted.rate_hz, wanted.block_frames, wanted.steps_per_s = rate_hz, block_frames, steps_per_s
        wanted.longest_gap_s, wanted.level_db, wanted.first_output = longest_gap_s, level_db, first_output
        wanted.sound_output, wanted.sound_db = sound_output, sound_db
        if len(encoded(save)) >= CLiveSettings.save.size:
            raise PhysVibError("save: expected a path of at most 1023 bytes", -2)
        wanted.save = encoded(save)
        renderer = settings(layout, 48000, law, exponent, field_m, limiter, channels)
        live_call("live_open", device.encode(), ctypes.byref(renderer), ctypes.byref(wanted), ctypes.byref(self._handle))

    @property
    def now_ns(self) -> int:
        """Session time."""
        return live_call("live_now_ns", self._handle)

    @property
    def latency_ns(self) -> int:
        """L: what is struck at session time t leaves for the device at t + L."""
        return live_call("live_latency_ns", self._handle)

    def strike(self, events: NDArray[np.void]) -> None:
        """Plays events (dtype EVENT), whose times are session times; those that are over, at once."""
        array = checked(events)
        live_call("live_strike", self._handle, array.ctypes.data, len(array))

    def impact(self, x_m: float, y_m: float, strength: float, *, material: str | None = None) -> None:
        """One impact now: at that place of the field, 0 to 1 of full scale; of a built-in material (see `materials`), else of 200 Hz."""
        if material is None:
            live_call("live_impact", self._handle, x_m, y_m, strength)
        else:
            live_call("live_impact_of", self._handle, material.encode(), x_m, y_m, strength)

    def send(self, world: World, start_ns: int, at_once: bool = False) -> int:
        """The events of a world whose time 0 is session time start_ns. How many."""
        return live_call("live_send", self._handle, world._handle, start_ns, int(at_once))

    def follow(self, world: World, start_ns: int = 0) -> int:
        """For a world that is stepped as time goes on, after each step: sends its events, and returns the session time of the world's time 0,
        to be given to the next call. It stays the same unless the world is held up, or runs ahead, by more than the latency."""
        start = c_int64(start_ns)
        live_call("live_align", self._handle, world._handle, ctypes.byref(start))
        self.send(world, start.value)
        return start.value

    def set_gain(self, channel: int, gain: float) -> None:
        """From session time on, felt L later: 0 to 10,000, in a glide of 10 ms."""
        live_call("live_set_gain", self._handle, channel, gain)

    def set_mute(self, channel: int, is_muted: bool) -> None:
        """From session time on, felt L later."""
        live_call("live_set_mute", self._handle, channel, int(is_muted))

    def set_layout(self, layout: str | Layout, *, law: str = "auto", exponent: float = 1.0, field_m: tuple[float, float] | None = None) -> None:
        """Later strikes sit there; at most as many enchanters as channels."""
        live_call("live_set_layout", self._handle, ctypes.byref(settings(layout, 48000, law, exponent, field_m, True, 0)))

    def set_level(self, level_db: float) -> None:
        """Of all, -90 to 0 dB; at once, in a ramp."""
        live_call("live_set_level", self._handle, level_db)

    def silence(self, is_silent: bool = True) -> None:
        """Within a block. Only False or 0 lifts it, in a ramp: anything else silences."""
        is_off = getattr(is_silent, "shape", ()) == () and is_silent == 0  # numpy's False as well
        live_call("live_silence", self._handle, 0 if is_off else 1)

    @property
    def status(self) -> LiveStatus:
        """What it does, and what is wrong."""
        told = CLiveStatus()
        live_call("live_status_init", ctypes.byref(told), ctypes.sizeof(told))
        live_call("live_get_status", self._handle, ctypes.byref(told))
        values = {name: getattr(told, name) for name in LiveStatus._fields}
        values.update(is_running=bool(told.is_running), is_silent=bool(told.is_silent), trouble=told.trouble.decode(errors="replace"), board=BOARDS[told.board])
        return LiveStatus(**values)

    def left(self, from_ns: int, to_ns: int, actuator: int) -> Receipt:
        """What left for an actuator, from 0, in a span of session times of events: known a latency after them, for a minute."""
        told = CLiveReceipt()
        live_call("live_receipt_init", ctypes.byref(told), ctypes.sizeof(told))
        live_call("live_left", self._handle, from_ns, to_ns, actuator, ctypes.byref(told))
        return Receipt(told.frames, told.peak, told.mean_square, bool(told.running), told.opening, bool(told.over), bool(told.kept))

    def explain(self, world: World) -> str:
        """As World.explain, also of this device."""
        return explained(partial(live_call, "live_explain"), self._handle, world._handle)

    def close(self) -> None:
        """Silent within two blocks, then closed, also if it says that not all of the session is saved."""
        if self._handle:
            handle, self._handle = self._handle, c_void_p()
            live_call("live_close", handle)

    def __enter__(self) -> Live:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
