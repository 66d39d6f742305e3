# SPDX-License-Identifier: MIT
"""The shared library, its structures and its errors: physvib.h, line by line."""
from __future__ import annotations

import contextlib
import ctypes
import os
from ctypes import POINTER, Structure, c_char_p, c_double, c_float, c_int, c_int64, c_size_t, c_void_p
from pathlib import Path
from types import SimpleNamespace
from typing import TypeVar

import numpy as np

UNKNOWN = -1.0e300
#: Of `full_scale_impulse_n_s`: learned from the world's hits, see Docs/actuators.md.
AUTOMATIC = -1.0
MAX_ENCHANTERS = 64

#: A collision as it is felt, as numpy has it: fields as in physvib.h, times in whole nanoseconds.
EVENT = np.dtype([("time_ns", "<i8"), ("duration_ns", "<i8"), ("frequency_hz", "<f8"), ("decay_per_s", "<f8"), ("amplitude", "<f8"),
                  ("x_m", "<f8"), ("y_m", "<f8"), ("impulse_n_s", "<f8"), ("mass_kg", "<f8"), ("fixture", "<i4"), ("other", "<i4"), ("kind", "<i4"), ("sound", "<i4"),
                  ("z_m", "<f8"), ("part", "<i4"), ("unused", "<i4")])

#: What an event came of, as its field `kind` says it.
HIT, ROLL, SLIDE = 0, 1, 2


class PhysVibError(ValueError):
    """What was expected, in one line. Nothing has changed."""

    def __init__(self, line: str, code: int) -> None:
        super().__init__(line)
        self.code = code


class CLayout(Structure):
    _fields_ = [("extent_width_m", c_double), ("extent_height_m", c_double), ("x_m", c_double * MAX_ENCHANTERS),
                ("y_m", c_double * MAX_ENCHANTERS), ("count", c_int), ("z_m", c_double * MAX_ENCHANTERS), ("part", c_int * MAX_ENCHANTERS)]


class CRendererSettings(Structure):
    _fields_ = [("size", c_size_t), ("rate_hz", c_int), ("channels", c_int), ("law", c_int), ("limiter", c_int), ("exponent", c_double),
                ("field_width_m", c_double), ("field_height_m", c_double), ("layout", CLayout)]


class CRendererStatus(Structure):
    _fields_ = [("size", c_size_t), ("live_modes", c_int), ("pending", c_int), ("frames", c_int64), ("played", c_int64), ("late", c_int64),
                ("rejected", c_int64), ("refused", c_int64)]


class CWorldSettings(Structure):
    _fields_ = [("size", c_size_t), ("is_muted", c_int), ("hits_per_step", c_int), ("at_body", c_int), ("drops_hits_of_removed", c_int),
                *[(name, c_double) for name in ("field_width_m", "field_x_m", "field_y_m", "field_radians", "normalisation_s_per_m",
                                                "hand_mass_kg", "drive_gain", "threshold_m_per_s", "full_scale_impulse_n_s", "settling_s")]]


class CBody(Structure):
    _fields_ = [("size", c_size_t), ("is_camera", c_int), ("voice", c_int), ("surface", c_int),
                *[(name, c_double) for name in ("mass_kg", "inertia_kg_m2", "gravity_scale", "frequency_hz", "decay_per_s", "static_mass_kg",
                                                "gain", "hand_mass_kg")],
                *[(name, c_double * 3) for name in ("overtone_hz", "overtone_decay_per_s", "overtone_amplitude")],
                *[(name, c_double) for name in ("grain_m", "roughness", "rolling")], ("is_ridged", c_int), ("device", c_int), ("part", c_int), ("unused", c_int)]


class CContact(Structure):
    _fields_ = [("size", c_size_t), ("a", c_int), ("b", c_int),
                *[(name, c_double) for name in ("x_m", "y_m", "normal_x", "normal_y", "impulse_n_s", "tangential_n_s", "approach_m_per_s",
                                                "restitution", "effective_mass_kg", "fraction", "gap_m", "gap_fraction", "along_a_m_per_s",
                                                "along_b_m_per_s")],
                ("is_soft", c_int), ("unused", c_int), ("point_id", c_int), ("is_impulse_of_pair", c_int),
                *[(name, c_double) for name in ("z_m", "normal_z", "friction_x_n_s", "friction_y_n_s", "friction_z_n_s")]]


class CWorldCounts(Structure):
    _fields_ = [("size", c_size_t), *[(name, c_int64) for name in ("contacts", "below_threshold", "no_source", "unplayable", "muted", "dropped", "events")],
                ("threshold_m_per_s", c_double)]


class COutputFacts(Structure):
    _fields_ = [("size", c_size_t), ("is_missing", c_int), ("is_silent", c_int), ("channels", c_int), ("unused", c_int), ("level", c_double),
                *[(name, c_int64) for name in ("muted_channels", "late", "dropped", "rejected")], ("silent_by", c_char_p), ("trouble", c_char_p),
                ("renderer", POINTER(CRendererSettings)), ("without_part", c_int64)]


class CMotors(Structure):
    _fields_ = [("low", c_double), ("high", c_double)]


def load(path: str, signatures: dict[str, tuple], long: frozenset[str]) -> SimpleNamespace:
    """The functions of a library. Those that are `long` let other threads of Python run. The others take microseconds and keep the interpreter: to have it
    back from three busy threads takes up to 15 ms (sys.getswitchinterval for each), three times in every step of a world."""
    lets_go, keeps = ctypes.CDLL(path), ctypes.PyDLL(path)
    functions = {}
    for name, (result, *arguments) in signatures.items():
        function = getattr(lets_go if name in long else keeps, "physvib_" + name)
        function.restype, function.argtypes = result, arguments
        functions["physvib_" + name] = function
    return SimpleNamespace(path=path, **functions)


def _path() -> str:
    here = Path(__file__).parent
    for beside in sorted(here.glob("lib*.so.*")):  # of a wheel, for a machine that lacks them
        if not beside.name.startswith("libphysvib"):
            ctypes.CDLL(str(beside), mode=ctypes.RTLD_GLOBAL)
    own = here / "libphysvib.so.1"
    return os.environ.get("PHYSVIB_LIBRARY") or (str(own) if own.exists() else "libphysvib.so.1")


_handle, _time, _events, _samples = c_void_p, c_int64, c_void_p, c_void_p
_signatures = {
    "version": (c_char_p,), "error": (c_char_p,), "law_name": (c_char_p, c_int),
    "renderer_settings_init": (c_int, POINTER(CRendererSettings), c_size_t), "renderer_status_init": (c_int, POINTER(CRendererStatus), c_size_t),
    "world_settings_init": (c_int, POINTER(CWorldSettings), c_size_t), "body_init": (c_int, POINTER(CBody), c_size_t), "contact_init": (c_int, POINTER(CContact), c_size_t),
    "world_counts_init": (c_int, POINTER(CWorldCounts), c_size_t), "world_get_counts": (c_int, _handle, POINTER(CWorldCounts)),
    "world_explain": (c_int, _handle, c_char_p, c_size_t), "renderer_explain": (c_int, _handle, _handle, c_char_p, c_size_t),
    "output_facts_init": (c_int, POINTER(COutputFacts), c_size_t), "world_note": (c_int, _handle, c_int, c_int),
    "world_explain_output": (c_int, _handle, POINTER(COutputFacts), c_char_p, c_size_t), "layout_parse": (c_int, c_char_p, POINTER(CLayout)),
    "events_parse": (c_int64, c_char_p, _events, c_int64),
    "layout_preset": (c_int, c_char_p, POINTER(CLayout)), "layout_load": (c_int, c_char_p, POINTER(CLayout)),
    "layout_save": (c_int, c_char_p, c_char_p, POINTER(CLayout)),
    "events_load": (c_int64, c_char_p, _events, c_int64),
    "events_load_field": (c_int, c_char_p, POINTER(c_double), POINTER(c_double)), "events_parse_field": (c_int, c_char_p, POINTER(c_double), POINTER(c_double)),
    "events_save_field": (c_int, c_char_p, _events, c_int64, c_double, c_double),
    "wav_save": (c_int, c_char_p, _samples, c_int, c_int64, c_int),
    "render": (c_int, POINTER(CRendererSettings), _events, c_int64, c_int64, _samples),
    "renderer_create": (c_int, POINTER(CRendererSettings), POINTER(_handle)), "renderer_free": (c_int, _handle),
    "renderer_strike": (c_int, _handle, _events),
    "material_name": (c_char_p, c_int), "material": (c_int, c_char_p, POINTER(CBody)), "material_load": (c_int, c_char_p, c_char_p, POINTER(CBody)), "sound": (c_int, c_char_p), "part": (c_int, c_char_p),
    "event_of": (c_int, c_char_p, *[c_double] * 3, _events), "renderer_impact": (c_int, _handle, *[c_double] * 3), "renderer_impact_of": (c_int, _handle, c_char_p, *[c_double] * 3),
    "renderer_pull": (c_int, _handle, POINTER(POINTER(c_float)), c_int, c_int),
    "renderer_set_gain": (c_int, _handle, _time, c_int, c_double), "renderer_set_mute": (c_int, _handle, _time, c_int, c_int),
    "renderer_set_level": (c_int, _handle, _time, c_double), "renderer_set_layout": (c_int, _handle, _time, POINTER(CRendererSettings)),
    "renderer_silence": (c_int, _handle, _time, _time), "renderer_latency_frames": (c_int, _handle),
    "renderer_get_status": (c_int, _handle, POINTER(CRendererStatus)), "play_out_ns": (c_int64, c_int, c_int, c_int, c_double),
    "world_create": (c_int, POINTER(CWorldSettings), POINTER(_handle)), "world_free": (c_int, _handle),
    "world_configure": (c_int, _handle, POINTER(CWorldSettings)),
    "world_set_body": (c_int, _handle, c_int, POINTER(CBody)), "world_remove_body": (c_int, _handle, c_int),
    "world_move": (c_int, _handle, c_int, *[c_double] * 5), "world_moved": (c_int, _handle, c_int, *[c_double] * 3),
    "world_move_in_space": (c_int, _handle, c_int, *[POINTER(c_double)] * 4), "world_moved_in_space": (c_int, _handle, c_int, *[POINTER(c_double)] * 2),
    "world_pair": (c_int, _handle, c_int, c_int, *[c_double] * 3),
    "world_begin_step": (c_int, _handle, c_double, c_double), "world_end_step": (c_int, _handle),
    "world_touch": (c_int, _handle, POINTER(CContact)), "world_begin": (c_int, _handle, POINTER(CContact)),
    "world_push": (c_int, _handle, POINTER(CContact)), "world_end": (c_int, _handle, c_int, c_int),
    "world_time_ns": (c_int64, _handle), "world_take": (c_int64, _handle, _events, c_int64, c_int),
    "world_send": (c_int64, _handle, _handle, c_int64, c_int), "world_drops": (c_int64, _handle), "world_thinned": (c_int64, _handle),
    "world_device": (c_int, _handle, c_int), "pads_create": (c_int, c_int, c_double, c_double, c_char_p, POINTER(_handle)), "pads_free": (c_int, _handle), "pads_strike": (c_int, _handle, c_int, _events),
    "pads_send": (c_int64, _handle, c_int, _handle, c_int64, c_int), "pads_pull": (c_int, _handle, _time, POINTER(CMotors), c_int),
    "pads_stop": (c_int, _handle), "pads_set_level": (c_int, _handle, c_double),
}
_long = frozenset({"material_load", "layout_load", "layout_save", "events_load", "events_load_field", "events_save_field", "wav_save", "render", "renderer_create", "renderer_pull"})
library = load(_path(), _signatures, _long)


def call(name: str, *arguments: object) -> int:
    """A code or a count; of an error, PhysVibError."""
    result = getattr(library, "physvib_" + name)(*arguments)
    if result < 0:
        raise PhysVibError(library.physvib_error().decode(errors="replace"), result)
    return result


_AnyOwned = TypeVar("_AnyOwned", bound="Owned")


class Owned:
    """What a library has made for its owner, who frees it by close(), or at the end of a `with`."""
    _call = staticmethod(call)
    _frees: str  # the function's name
    _handle: c_void_p

    def close(self) -> None:
        """Frees it; later calls raise."""
        if self._handle:
            self._call(self._frees, self._handle)
            self._handle = c_void_p()

    def __enter__(self: _AnyOwned) -> _AnyOwned:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_handle", None) and library is not None:  # what was never made, or a moment at which modules have gone
            with contextlib.suppress(PhysVibError):
                self.close()


def filled(structure: type, init: str, **values: object) -> Structure:
    """A structure as its init has it, and the values that are given; None is what init says."""
    made = structure()
    call(init, ctypes.byref(made), ctypes.sizeof(made))
    for name, value in values.items():
        if value is not None:
            setattr(made, name, value)
    return made


def encoded(path: "str | os.PathLike[str]") -> bytes:
    return os.fsencode(path)


def version() -> str:
    return library.physvib_version().decode()


#: What explanations of the C functions name otherwise here.
_names = {"physvib_world_begin_step and physvib_world_end_step": "World.step", "physvib_world_begin_step": "World.step", "physvib_world_": "World.",
          "physvib_renderer_": "Renderer.", "physvib_live_": "Live.",
          "divide lengths by the pixels of a metre (100, say)": "divide lengths by the pixels of a metre, or set metres_per_unit of attach (0.01, say)"}


def explained(explain, *arguments) -> str:  # type: ignore[no-untyped-def]
    """The sentence that `explain(*arguments, text, size)` writes, with Python's names."""
    text = ctypes.create_string_buffer(512)
    explain(*arguments, text, len(text))
    sentence = text.value.decode(errors="replace")
    for name, here in _names.items():
        sentence = sentence.replace(name, here)
    return sentence
