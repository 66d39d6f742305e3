# SPDX-License-Identifier: MIT
"""What physvib-live.h declares, as ctypes and numpy have it. Written by Source/Api/bindings.py: change the header, not this file."""
from __future__ import annotations

from ctypes import POINTER, Structure, c_char, c_char_p, c_double, c_int, c_int64, c_size_t, c_void_p

from ._header import CRendererSettings

ERROR_DEVICE = -9
BOARD_NONE = 0
BOARD_SOUGHT = 1
BOARD_PLAYS = 2
DEVICE_SOUND = 0
DEVICE_PAD = 1
DEVICE_BOARD = 2


class CLiveSettings(Structure):
    _fields_ = [("size", c_size_t), ("rate_hz", c_int), ("block_frames", c_int), ("steps_per_s", c_int), ("longest_gap_s", c_double), ("level_db", c_double),
                ("save", c_char * 1024), ("first_output", c_int), ("sound_output", c_int), ("sound_db", c_double)]


class CLiveStatus(Structure):
    _fields_ = [("size", c_size_t), ("is_running", c_int), ("is_silent", c_int), ("rate_hz", c_int), ("block_frames", c_int), ("live_modes", c_int),
                ("losses", c_int), ("xruns", c_int), ("load", c_double), ("worst_load", c_double), ("played", c_int64), ("late", c_int64),
                ("rejected", c_int64), ("trouble", c_char * 256), ("board", c_int), ("board_sent", c_int64), ("board_lost", c_int64), ("dropped", c_int64)]


class CLiveReceipt(Structure):
    _fields_ = [("size", c_size_t), ("frames", c_int64), ("peak", c_double), ("mean_square", c_double), ("running", c_int), ("opening", c_int), ("over", c_int),
                ("kept", c_int)]


class CDevice(Structure):
    _fields_ = [("size", c_size_t), ("name", c_char * 256), ("about", c_char * 256), ("kind", c_int), ("channels", c_int)]


#: Of each function its result and its parameters.
signatures: dict[str, tuple] = {
    "live_error": (c_char_p,),
    "live_settings_init": (c_int, POINTER(CLiveSettings), c_size_t),
    "live_status_init": (c_int, POINTER(CLiveStatus), c_size_t),
    "live_receipt_init": (c_int, POINTER(CLiveReceipt), c_size_t),
    "live_devices": (c_int, POINTER(CDevice), c_int, c_size_t),
    "live_open": (c_int, c_char_p, POINTER(CRendererSettings), POINTER(CLiveSettings), POINTER(c_void_p)),
    "live_close": (c_int, c_void_p),
    "live_now_ns": (c_int64, c_void_p),
    "live_latency_ns": (c_int64, c_void_p),
    "live_strike": (c_int, c_void_p, c_void_p, c_int64),
    "live_impact": (c_int, c_void_p, c_double, c_double, c_double),
    "live_impact_of": (c_int, c_void_p, c_char_p, c_double, c_double, c_double),
    "live_align": (c_int, c_void_p, c_void_p, POINTER(c_int64)),
    "live_send": (c_int64, c_void_p, c_void_p, c_int64, c_int),
    "live_send_each": (c_int64, POINTER(c_void_p), c_int, c_void_p, POINTER(c_int64)),
    "live_set_gain": (c_int, c_void_p, c_int, c_double),
    "live_set_mute": (c_int, c_void_p, c_int, c_int),
    "live_set_layout": (c_int, c_void_p, POINTER(CRendererSettings)),
    "live_set_level": (c_int, c_void_p, c_double),
    "live_silence": (c_int, c_void_p, c_int),
    "live_get_status": (c_int, c_void_p, POINTER(CLiveStatus)),
    "live_left": (c_int, c_void_p, c_int64, c_int64, c_int, POINTER(CLiveReceipt)),
    "live_explain": (c_int, c_void_p, c_void_p, c_char_p, c_size_t),
    "session_load": (c_int, c_char_p, POINTER(c_void_p)),
    "session_create": (c_int, POINTER(CRendererSettings), c_void_p, c_int64, c_int64, POINTER(c_void_p)),
    "session_free": (c_int, c_void_p),
    "session_save": (c_int, c_void_p, c_char_p),
    "session_length_ns": (c_int64, c_void_p),
    "session_get_renderer": (c_int, c_void_p, POINTER(CRendererSettings)),
    "session_events": (c_int64, c_void_p, c_int64, c_void_p, c_int64),
    "session_render": (c_int, c_void_p, c_int, c_int64, c_void_p),
}
