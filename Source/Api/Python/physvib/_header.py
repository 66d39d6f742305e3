# SPDX-License-Identifier: MIT
"""What physvib.h declares, as ctypes and numpy have it. Written by Source/Api/bindings.py: change the header, not this file."""
from __future__ import annotations

from ctypes import POINTER, Structure, c_char_p, c_double, c_float, c_int, c_int64, c_size_t, c_void_p

import numpy as np

OK = 0
ERROR_HANDLE = -1
ERROR_ARGUMENT = -2
ERROR_ORDER = -3
ERROR_FILE = -4
ERROR_MEMORY = -5
ERROR_FULL = -6
ERROR_BUSY = -7
ERROR_INTERNAL = -8
UNKNOWN = -1.0e300
MAX_ENCHANTERS = 64
HIT = 0
ROLL = 1
SLIDE = 2
LAW_LINEAR = 0
LAW_LOG = 1
LAW_LOG_OUTER = 2
LAW_ENERGY = 3
LAW_NEIGHBOURS = 4
LAW_AUTO = 5
LAW_DISTANCE = 6
LAW_TRIANGLES = 7
AUTOMATIC = -1.0
VOICE_OWN = 0
VOICE_OTHER = 1
VOICE_BOTH = 2
POINT_NONE = -1
POINT_BY_PLACE = -2
SOFT = 1
SOFT_WHOLE = 2
NOTE_SENSOR = 0
NOTE_FILTERED = 1
NOTE_DISABLED = 2
NOTE_ASLEEP = 3

EVENT = np.dtype([("size", "<u8"), ("time_ns", "<i8"), ("duration_ns", "<i8"), ("frequency_hz", "<f8"), ("decay_per_s", "<f8"), ("amplitude", "<f8"),
                  ("x_m", "<f8"), ("y_m", "<f8"), ("impulse_n_s", "<f8"), ("mass_kg", "<f8"), ("fixture", "<i4"), ("other", "<i4"), ("kind", "<i4"),
                  ("sound", "<i4"), ("z_m", "<f8"), ("part", "<i4"), ("unused", "<i4")], align=True)


class CLayout(Structure):
    _fields_ = [("size", c_size_t), ("extent_width_m", c_double), ("extent_height_m", c_double), ("x_m", c_double * 64), ("y_m", c_double * 64),
                ("count", c_int), ("z_m", c_double * 64), ("part", c_int * 64)]


class CRendererSettings(Structure):
    _fields_ = [("size", c_size_t), ("rate_hz", c_int), ("channels", c_int), ("law", c_int), ("limiter", c_int), ("exponent", c_double),
                ("field_width_m", c_double), ("field_height_m", c_double), ("layout", CLayout)]


class CRendererStatus(Structure):
    _fields_ = [("size", c_size_t), ("live_modes", c_int), ("pending", c_int), ("frames", c_int64), ("played", c_int64), ("late", c_int64),
                ("rejected", c_int64), ("refused", c_int64)]


class CWorldSettings(Structure):
    _fields_ = [("size", c_size_t), ("is_muted", c_int), ("hits_per_step", c_int), ("at_body", c_int), ("drops_hits_of_removed", c_int),
                ("field_width_m", c_double), ("field_x_m", c_double), ("field_y_m", c_double), ("field_radians", c_double), ("normalisation_s_per_m", c_double),
                ("hand_mass_kg", c_double), ("drive_gain", c_double), ("threshold_m_per_s", c_double), ("full_scale_impulse_n_s", c_double),
                ("settling_s", c_double)]


class CBody(Structure):
    _fields_ = [("size", c_size_t), ("is_camera", c_int), ("voice", c_int), ("surface", c_int), ("mass_kg", c_double), ("inertia_kg_m2", c_double),
                ("gravity_scale", c_double), ("frequency_hz", c_double), ("decay_per_s", c_double), ("static_mass_kg", c_double), ("gain", c_double),
                ("hand_mass_kg", c_double), ("overtone_hz", c_double * 3), ("overtone_decay_per_s", c_double * 3), ("overtone_amplitude", c_double * 3),
                ("grain_m", c_double), ("roughness", c_double), ("rolling", c_double), ("is_ridged", c_int), ("device", c_int), ("part", c_int)]


class CContact(Structure):
    _fields_ = [("size", c_size_t), ("a", c_int), ("b", c_int), ("x_m", c_double), ("y_m", c_double), ("normal_x", c_double), ("normal_y", c_double),
                ("impulse_n_s", c_double), ("tangential_n_s", c_double), ("approach_m_per_s", c_double), ("restitution", c_double),
                ("effective_mass_kg", c_double), ("fraction", c_double), ("gap_m", c_double), ("gap_fraction", c_double), ("along_a_m_per_s", c_double),
                ("along_b_m_per_s", c_double), ("is_soft", c_int), ("point_id", c_int), ("is_impulse_of_pair", c_int), ("z_m", c_double),
                ("normal_z", c_double), ("friction_x_n_s", c_double), ("friction_y_n_s", c_double), ("friction_z_n_s", c_double)]


class CWorldCounts(Structure):
    _fields_ = [("size", c_size_t), ("contacts", c_int64), ("below_threshold", c_int64), ("no_source", c_int64), ("unplayable", c_int64), ("muted", c_int64),
                ("dropped", c_int64), ("events", c_int64), ("threshold_m_per_s", c_double)]


class COutputFacts(Structure):
    _fields_ = [("size", c_size_t), ("is_missing", c_int), ("is_silent", c_int), ("channels", c_int), ("level", c_double), ("muted_channels", c_int64),
                ("late", c_int64), ("dropped", c_int64), ("rejected", c_int64), ("silent_by", c_char_p), ("trouble", c_char_p),
                ("renderer", POINTER(CRendererSettings)), ("without_part", c_int64)]


class CMotors(Structure):
    _fields_ = [("low", c_double), ("high", c_double)]


#: Of each function its result and its parameters.
signatures: dict[str, tuple] = {
    "version": (c_char_p,),
    "law_name": (c_char_p, c_int),
    "error": (c_char_p,),
    "renderer_settings_init": (c_int, POINTER(CRendererSettings), c_size_t),
    "renderer_status_init": (c_int, POINTER(CRendererStatus), c_size_t),
    "world_settings_init": (c_int, POINTER(CWorldSettings), c_size_t),
    "body_init": (c_int, POINTER(CBody), c_size_t),
    "contact_init": (c_int, POINTER(CContact), c_size_t),
    "world_counts_init": (c_int, POINTER(CWorldCounts), c_size_t),
    "output_facts_init": (c_int, POINTER(COutputFacts), c_size_t),
    "event_init": (c_int, c_void_p, c_size_t),
    "layout_init": (c_int, POINTER(CLayout), c_size_t),
    "layout_preset": (c_int, c_char_p, POINTER(CLayout)),
    "layout_load": (c_int, c_char_p, POINTER(CLayout)),
    "layout_parse": (c_int, c_char_p, POINTER(CLayout)),
    "layout_save": (c_int, c_char_p, c_char_p, POINTER(CLayout)),
    "part": (c_int, c_char_p),
    "events_load": (c_int64, c_char_p, c_void_p, c_int64),
    "events_parse": (c_int64, c_char_p, c_void_p, c_int64),
    "events_load_field": (c_int, c_char_p, POINTER(c_double), POINTER(c_double)),
    "events_parse_field": (c_int, c_char_p, POINTER(c_double), POINTER(c_double)),
    "events_save": (c_int, c_char_p, c_void_p, c_int64),
    "events_save_field": (c_int, c_char_p, c_void_p, c_int64, c_double, c_double),
    "wav_save": (c_int, c_char_p, c_void_p, c_int, c_int64, c_int),
    "render": (c_int, POINTER(CRendererSettings), c_void_p, c_int64, c_int64, c_void_p),
    "material_name": (c_char_p, c_int),
    "material": (c_int, c_char_p, POINTER(CBody)),
    "material_load": (c_int, c_char_p, c_char_p, POINTER(CBody)),
    "sound": (c_int, c_char_p),
    "event_of": (c_int, c_char_p, c_double, c_double, c_double, c_void_p),
    "renderer_create": (c_int, POINTER(CRendererSettings), POINTER(c_void_p)),
    "renderer_free": (c_int, c_void_p),
    "renderer_strike": (c_int, c_void_p, c_void_p),
    "renderer_impact": (c_int, c_void_p, c_double, c_double, c_double),
    "renderer_impact_of": (c_int, c_void_p, c_char_p, c_double, c_double, c_double),
    "renderer_pull": (c_int, c_void_p, POINTER(POINTER(c_float)), c_int, c_int),
    "renderer_pull_interleaved": (c_int, c_void_p, c_void_p, c_int, c_int),
    "renderer_set_gain": (c_int, c_void_p, c_int64, c_int, c_double),
    "renderer_set_mute": (c_int, c_void_p, c_int64, c_int, c_int),
    "renderer_set_level": (c_int, c_void_p, c_int64, c_double),
    "renderer_set_layout": (c_int, c_void_p, c_int64, POINTER(CRendererSettings)),
    "renderer_silence": (c_int, c_void_p, c_int64, c_int64),
    "renderer_latency_frames": (c_int, c_void_p),
    "renderer_get_status": (c_int, c_void_p, POINTER(CRendererStatus)),
    "play_out_ns": (c_int64, c_int, c_int, c_int, c_double),
    "world_create": (c_int, POINTER(CWorldSettings), POINTER(c_void_p)),
    "world_free": (c_int, c_void_p),
    "world_configure": (c_int, c_void_p, POINTER(CWorldSettings)),
    "world_set_body": (c_int, c_void_p, c_int, POINTER(CBody)),
    "world_set_mass": (c_int, c_void_p, c_int, c_double),
    "world_device": (c_int, c_void_p, c_int),
    "world_remove_body": (c_int, c_void_p, c_int),
    "world_move": (c_int, c_void_p, c_int, c_double, c_double, c_double, c_double, c_double),
    "world_moved": (c_int, c_void_p, c_int, c_double, c_double, c_double),
    "world_move_in_space": (c_int, c_void_p, c_int, POINTER(c_double), POINTER(c_double), POINTER(c_double), POINTER(c_double)),
    "world_moved_in_space": (c_int, c_void_p, c_int, POINTER(c_double), POINTER(c_double)),
    "world_pair": (c_int, c_void_p, c_int, c_int, c_double, c_double, c_double),
    "world_begin_step": (c_int, c_void_p, c_double, c_double),
    "world_touch": (c_int, c_void_p, POINTER(CContact)),
    "world_begin": (c_int, c_void_p, POINTER(CContact)),
    "world_push": (c_int, c_void_p, POINTER(CContact)),
    "world_end": (c_int, c_void_p, c_int, c_int),
    "world_end_step": (c_int, c_void_p),
    "world_time_ns": (c_int64, c_void_p),
    "world_take": (c_int64, c_void_p, c_void_p, c_int64, c_int),
    "world_send": (c_int64, c_void_p, c_void_p, c_int64, c_int),
    "world_drops": (c_int64, c_void_p),
    "world_get_counts": (c_int, c_void_p, POINTER(CWorldCounts)),
    "world_explain": (c_int, c_void_p, c_char_p, c_size_t),
    "world_explain_output": (c_int, c_void_p, POINTER(COutputFacts), c_char_p, c_size_t),
    "renderer_explain": (c_int, c_void_p, c_void_p, c_char_p, c_size_t),
    "world_note": (c_int, c_void_p, c_int, c_int),
    "world_thinned": (c_int64, c_void_p),
    "pads_create": (c_int, c_int, c_double, c_double, c_char_p, POINTER(c_void_p)),
    "pads_free": (c_int, c_void_p),
    "pads_strike": (c_int, c_void_p, c_int, c_void_p),
    "pads_send": (c_int64, c_void_p, c_int, c_void_p, c_int64, c_int),
    "pads_pull": (c_int, c_void_p, c_int64, POINTER(CMotors), c_int),
    "pads_stop": (c_int, c_void_p),
    "pads_set_level": (c_int, c_void_p, c_double),
}
