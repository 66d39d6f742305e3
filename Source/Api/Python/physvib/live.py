# SPDX-License-Identifier: MIT
"""A device that plays: strikes at session times, and a world's contacts. It loads libphysvib-live, which is GPL, when it is opened."""
from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, c_char, c_char_p, c_double, c_int, c_int64, c_size_t, c_void_p
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._library import CRendererSettings, PhysVibError, Structure, library
from .files import checked
from .layout import Layout, settings
from .world import World


class CLiveSettings(Structure):
    _fields_ = [("size", c_size_t), ("rate_hz", c_int), ("block_frames", c_int), ("steps_per_s", c_int), ("longest_gap_s", c_double), ("level_db", c_double)]


class CLiveStatus(Structure):
    _fields_ = [("size", c_size_t), *[(name, c_int) for name in ("is_running", "is_silent", "rate_hz", "block_frames", "live_modes", "losses", "xruns")],
                ("load", c_double), ("worst_load", c_double), ("played", c_int64), ("late", c_int64), ("rejected", c_int64), ("trouble", c_char * 256)]


_signatures = {
    "error": (c_char_p,), "settings_init": (c_int, POINTER(CLiveSettings)), "status_init": (c_int, POINTER(CLiveStatus)),
    "open": (c_int, c_char_p, POINTER(CRendererSettings), POINTER(CLiveSettings), POINTER(c_void_p)), "close": (c_int, c_void_p),
    "now_ns": (c_int64, c_void_p), "latency_ns": (c_int64, c_void_p), "strike": (c_int, c_void_p, c_void_p, c_int64),
    "send": (c_int64, c_void_p, c_void_p, c_int64, c_int), "set_gain": (c_int, c_void_p, c_int, c_double), "set_mute": (c_int, c_void_p, c_int, c_int),
    "set_layout": (c_int, c_void_p, POINTER(CRendererSettings)), "set_level": (c_int, c_void_p, c_double), "silence": (c_int, c_void_p, c_int),
    "get_status": (c_int, c_void_p, POINTER(CLiveStatus)),
}


def _load() -> ctypes.CDLL:
    beside = Path(library._name).parent / "libphysvib-live.so.0"
    found = ctypes.CDLL(os.environ.get("PHYSVIB_LIVE_LIBRARY") or (str(beside) if beside.exists() else "libphysvib-live.so.0"))
    for name, (result, *arguments) in _signatures.items():
        function = getattr(found, "physvib_live_" + name)
        function.restype, function.argtypes = result, arguments
    return found


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


class Live:
    """Strikes told from any thread are felt at session time + L, to a fraction of a frame, however busy the interpreter is: it only has
    to have told them by then. One at a time."""

    def __init__(self, device: str = "JACK:system", *, layout: str | Layout = "phone4", channels: int = 0, law: str = "linear", exponent: float = 1.0,
                 field_m: tuple[float, float] | None = None, limiter: bool = True, rate_hz: int = 0, block_frames: int = 0, steps_per_s: int = 100,
                 longest_gap_s: float = 0.026, level_db: float = -12.0) -> None:
        self._handle = c_void_p()
        self._library = _load()
        wanted = CLiveSettings()
        self._call("settings_init", ctypes.byref(wanted))
        wanted.rate_hz, wanted.block_frames, wanted.steps_per_s = rate_hz, block_frames, steps_per_s
        wanted.longest_gap_s, wanted.level_db = longest_gap_s, level_db
        renderer = settings(layout, 48000, law, exponent, field_m, limiter, channels)
        self._call("open", device.encode(), ctypes.byref(renderer), ctypes.byref(wanted), ctypes.byref(self._handle))

    @property
    def now_ns(self) -> int:
        """Session time."""
        return self._call("now_ns", self._handle)

    @property
    def latency_ns(self) -> int:
        """L: what is struck at session time t leaves for the device at t + L."""
        return self._call("latency_ns", self._handle)

    def strike(self, events: NDArray[np.void]) -> None:
        """Plays events (dtype EVENT), whose times are session times; those that are over, at once."""
        array = checked(events)
        self._call("strike", self._handle, array.ctypes.data, len(array))

    def send(self, world: World, start_ns: int, at_once: bool = False) -> int:
        """The events of a world whose time 0 is session time start_ns. How many."""
        return self._call("send", self._handle, world._handle, start_ns, int(at_once))

    def set_gain(self, channel: int, gain: float) -> None:
        self._call("set_gain", self._handle, channel, gain)

    def set_mute(self, channel: int, is_muted: bool) -> None:
        self._call("set_mute", self._handle, channel, int(is_muted))

    def set_layout(self, layout: str | Layout, *, law: str = "linear", exponent: float = 1.0, field_m: tuple[float, float] | None = None) -> None:
        self._call("set_layout", self._handle, ctypes.byref(settings(layout, 48000, law, exponent, field_m, True, 0)))

    def set_level(self, level_db: float) -> None:
        """Of all, -90 to 0 dB; at once, in a ramp."""
        self._call("set_level", self._handle, level_db)

    def silence(self, is_silent: bool = True) -> None:
        """Within a block; back in a ramp."""
        self._call("silence", self._handle, int(is_silent))

    @property
    def status(self) -> LiveStatus:
        told = CLiveStatus()
        self._call("status_init", ctypes.byref(told))
        self._call("get_status", self._handle, ctypes.byref(told))
        values = {name: getattr(told, name) for name in LiveStatus._fields}
        values.update(is_running=bool(told.is_running), is_silent=bool(told.is_silent), trouble=told.trouble.decode(errors="replace"))
        return LiveStatus(**values)

    def close(self) -> None:
        """Silent within two blocks, then closed."""
        if self._handle:
            self._call("close", self._handle)
            self._handle = c_void_p()

    def __enter__(self) -> Live:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _call(self, name: str, *arguments: object) -> int:
        result = getattr(self._library, "physvib_live_" + name)(*arguments)
        if result < 0:
            raise PhysVibError(self._library.physvib_live_error().decode(errors="replace"), result)
        return result
