# SPDX-License-Identifier: MIT
"""The library with devices, boards and sessions: physvib-live.h, line by line. It is loaded when something of it is first wanted."""
from __future__ import annotations

import functools
import os
from ctypes import POINTER, Structure, c_char, c_char_p, c_double, c_int, c_int64, c_size_t, c_void_p
from pathlib import Path
from types import SimpleNamespace

from ._library import CRendererSettings, PhysVibError, library, load


class CLiveSettings(Structure):
    _fields_ = [("size", c_size_t), ("rate_hz", c_int), ("block_frames", c_int), ("steps_per_s", c_int), ("longest_gap_s", c_double), ("level_db", c_double),
                ("save", c_char * 1024), ("first_output", c_int), ("unused", c_int)]


class CDevice(Structure):
    _fields_ = [("size", c_size_t), ("name", c_char * 256), ("about", c_char * 256), ("kind", c_int), ("channels", c_int)]


class CLiveStatus(Structure):
    _fields_ = [("size", c_size_t), *[(name, c_int) for name in ("is_running", "is_silent", "rate_hz", "block_frames", "live_modes", "losses", "xruns")],
                ("load", c_double), ("worst_load", c_double), ("played", c_int64), ("late", c_int64), ("rejected", c_int64), ("trouble", c_char * 256),
                ("board", c_int), ("unused", c_int), ("board_sent", c_int64), ("board_lost", c_int64), ("dropped", c_int64)]


class CLiveReceipt(Structure):
    _fields_ = [("size", c_size_t), ("frames", c_int64), ("peak", c_double), ("mean_square", c_double),
                *[(name, c_int) for name in ("running", "opening", "over", "kept")]]


_handle = c_void_p
_signatures = {
    "live_error": (c_char_p,), "live_settings_init": (c_int, POINTER(CLiveSettings), c_size_t), "live_status_init": (c_int, POINTER(CLiveStatus), c_size_t),
    "live_receipt_init": (c_int, POINTER(CLiveReceipt), c_size_t), "live_left": (c_int, _handle, c_int64, c_int64, c_int, POINTER(CLiveReceipt)),
    "live_devices": (c_int, POINTER(CDevice), c_int, c_size_t), "live_send_each": (c_int64, POINTER(_handle), c_int, _handle, POINTER(c_int64)),
    "live_open": (c_int, c_char_p, POINTER(CRendererSettings), POINTER(CLiveSettings), POINTER(_handle)), "live_close": (c_int, _handle),
    "live_now_ns": (c_int64, _handle), "live_latency_ns": (c_int64, _handle), "live_strike": (c_int, _handle, c_void_p, c_int64),
    "live_impact": (c_int, _handle, *[c_double] * 3), "live_impact_of": (c_int, _handle, c_char_p, *[c_double] * 3),
    "live_align": (c_int, _handle, _handle, POINTER(c_int64)), "live_send": (c_int64, _handle, _handle, c_int64, c_int),
    "live_set_gain": (c_int, _handle, c_int, c_double), "live_set_mute": (c_int, _handle, c_int, c_int),
    "live_set_layout": (c_int, _handle, POINTER(CRendererSettings)), "live_set_level": (c_int, _handle, c_double), "live_silence": (c_int, _handle, c_int),
    "live_get_status": (c_int, _handle, POINTER(CLiveStatus)), "live_explain": (c_int, _handle, _handle, c_char_p, c_size_t),
    "session_load": (c_int, c_char_p, POINTER(_handle)), "session_free": (c_int, _handle), "session_save": (c_int, _handle, c_char_p),
    "session_create": (c_int, POINTER(CRendererSettings), c_void_p, c_int64, c_int64, POINTER(_handle)),
    "session_length_ns": (c_int64, _handle), "session_get_renderer": (c_int, _handle, POINTER(CRendererSettings)),
    "session_events": (c_int64, _handle, c_int64, c_void_p, c_int64), "session_render": (c_int, _handle, c_int, c_int64, c_void_p),
}
_long = frozenset({"live_devices", "live_open", "live_close", "session_load", "session_save", "session_create", "session_render"})


@functools.lru_cache(maxsize=None)
def live_library() -> SimpleNamespace:
    """PHYSVIB_LIVE_LIBRARY, or libphysvib-live.so.1 beside the other one or where the system finds it."""
    beside = Path(library.path).parent / "libphysvib-live.so.1"
    return load(os.environ.get("PHYSVIB_LIVE_LIBRARY") or (str(beside) if beside.exists() else "libphysvib-live.so.1"), _signatures, _long)


def live_call(name: str, *arguments: object) -> int:
    """A code or a count; of an error, PhysVibError."""
    result = getattr(live_library(), "physvib_" + name)(*arguments)
    if result < 0:
        raise PhysVibError(live_library().physvib_live_error().decode(errors="replace"), result)
    return result
