# SPDX-License-Identifier: MIT
"""Events as arrays, files of them, and whole lists to samples."""
from __future__ import annotations

import ctypes
import os
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._header import EVENT, HIT
from ._library import PhysVibError, blank_events, call, encoded
from .layout import Layout, settings
from .material_table import part


class EventList(np.ndarray):
    """Events of a file: an array of dtype EVENT that knows the field its list says, and so do its slices and copies."""

    field_m: tuple[float, float] | None = None  #: width and height that x_m and y_m span; None: the list says none

    def __array_finalize__(self, of: Any) -> None:
        self.field_m = getattr(of, "field_m", None)


def _listed(count: int, name: str, source: bytes) -> EventList:
    made, width, height = blank_events(count).view(EventList), ctypes.c_double(), ctypes.c_double()
    call(name, source, ctypes.byref(width), ctypes.byref(height))
    made.field_m = (width.value, height.value) if width.value > 0 else None
    return made


def field_of(list_of: Any) -> tuple[float, float] | None:
    """The field that events, or a table of them, know."""
    return getattr(list_of, "attrs", {}).get("field_m") or getattr(list_of, "field_m", None)


def events(time_s: ArrayLike, *, frequency_hz: ArrayLike, decay_per_s: ArrayLike, amplitude: ArrayLike = 1.0, x_m: ArrayLike = 0.0, y_m: ArrayLike = 0.0,
           duration_s: ArrayLike = 0.0, kind: ArrayLike = HIT, z_m: ArrayLike = 0.0, part: ArrayLike = 0) -> NDArray[np.void]:
    """Events of dtype EVENT, shape (n,), sorted by time; each argument one number, or n of them. Times are rounded to nanoseconds.
    `kind`: HIT, or ROLL or SLIDE of a grain. `part`: the name or number of the part of a body on whose actuators they are felt; 0: on all."""
    if any(np.ma.is_masked(values) for values in (time_s, frequency_hz, decay_per_s, amplitude, x_m, y_m, duration_s, kind, z_m, part)):
        raise PhysVibError("events: expected values that are not masked (leave these events out: array.compressed())", -2)
    seconds, durations = np.asarray(time_s, dtype=np.float64), np.asarray(duration_s, dtype=np.float64)
    if not (np.isfinite(seconds).all() and np.isfinite(durations).all()) or np.abs(seconds).max(initial=0.0) > 1e8 or np.abs(durations).max(initial=0.0) > 1e8:
        raise PhysVibError("time: expected 0 to 10^8 s", -2)
    shape = np.broadcast(seconds, frequency_hz, decay_per_s, amplitude, x_m, y_m, durations, kind, z_m, part).shape or (1,)
    if len(shape) > 1:
        raise PhysVibError(f"events: expected one number, or n of them, for each, found an array of shape {shape}", -2)
    made = blank_events(shape)
    made["time_ns"], made["duration_ns"] = np.rint(seconds * 1e9), np.rint(durations * 1e9)
    for name, values in (("frequency_hz", frequency_hz), ("decay_per_s", decay_per_s), ("amplitude", amplitude), ("x_m", x_m), ("y_m", y_m), ("kind", kind), ("z_m", z_m), ("part", _parts(part))):
        made[name] = values
    made["fixture"] = made["other"] = -1
    return made[np.argsort(made["time_ns"], kind="stable")]


def _parts(names: ArrayLike) -> NDArray[np.int32]:
    """Numbers of parts; of names too, where "" and a missing value are none."""
    array = np.asarray(names)
    if array.dtype.kind in "iu":
        return array.astype(np.int32)
    numbers = [part(one) if isinstance(one, str) and one else int(one) if one and one == one else 0 for one in array.reshape(-1).tolist()]
    return np.array(numbers, dtype=np.int32).reshape(array.shape)


#: Columns of an event list, as files have them (Docs/events.md), and the fields they are. `impulse_ns` is N s.
COLUMNS = {"time_s": "time_ns", "frequency_hz": "frequency_hz", "decay_per_s": "decay_per_s", "amplitude": "amplitude", "x_m": "x_m", "y_m": "y_m",
           "duration_s": "duration_ns", "fixture": "fixture", "other": "other", "impulse_ns": "impulse_n_s", "mass_kg": "mass_kg", "kind": "kind", "z_m": "z_m", "part": "part"}
#: Those that only lists have which need them.
SPACE = ("z_m", "part")
KINDS = ("hit", "roll", "slide")


def frame(list_of: NDArray[np.void]) -> Any:
    """Events as a pandas.DataFrame, with the columns of event lists; needs pandas."""
    import pandas

    array = checked(list_of)
    columns = {column: array[field] * 1e-9 if field.endswith("_ns") else array[field] for column, field in COLUMNS.items()
               if column not in SPACE or array[field].any()}
    columns["kind"] = np.array(KINDS)[array["kind"]]
    table = pandas.DataFrame(columns)
    if field_of(list_of):
        table.attrs["field_m"] = field_of(list_of)
    return table


def events_of(table: Any) -> NDArray[np.void]:
    """Events (dtype EVENT, sorted) of a pandas.DataFrame with columns of event lists; the first six must be there. To the bit of a file:
    frame(load_events(path)), or pandas.read_csv(path, comment="#", float_precision="round_trip"), which knows no field."""
    missing = [name for name in list(COLUMNS)[:6] if name not in table.columns]
    if missing:
        raise PhysVibError(f"{missing[0]}: expected this column", -2)
    unknown = [str(name) for name in table.columns if name not in COLUMNS]
    if unknown:
        raise PhysVibError(f"{unknown[0]}: expected columns among {', '.join(COLUMNS)}", -2)
    column = {name: table[name].to_numpy() for name in table.columns}
    kind = column.get("kind", np.full(len(table), "hit"))
    if not np.isin(kind, KINDS).all():
        raise PhysVibError(f"kind: expected one of {', '.join(KINDS)}", -2)
    made = events(column["time_s"], duration_s=column.get("duration_s", 0.0), kind=np.array([KINDS.index(word) for word in kind], dtype=np.int32),
                  **{name: column[name] for name in ("frequency_hz", "decay_per_s", "amplitude", "x_m", "y_m", *SPACE) if name in column})
    order = np.argsort(np.rint(np.asarray(column["time_s"], dtype=np.float64) * 1e9), kind="stable")
    for name in ("fixture", "other", "impulse_ns", "mass_kg"):
        if name in column:
            made[COLUMNS[name]] = column[name][order]
    return made


def checked(list_of: ArrayLike) -> NDArray[np.void]:
    """A copy of events, as the library reads it."""
    array = np.array(events_of(list_of) if hasattr(list_of, "columns") else list_of, order="C")
    if array.dtype != EVENT:
        raise PhysVibError("events: expected an array of physvib.EVENT, or a DataFrame with the columns of event lists", -2)
    array["size"] = EVENT.itemsize
    return array.reshape(-1)


def load_events(path: str | os.PathLike[str]) -> EventList:
    """An event list (CSV): dtype EVENT, shape (n,), and its field_m."""
    made = _listed(call("events_load", encoded(path), None, 0), "events_load_field", encoded(path))
    call("events_load", encoded(path), made.ctypes.data, len(made))
    return made


def parse_events(text: str) -> EventList:
    """The text of an event list (CSV): dtype EVENT, shape (n,), and its field_m."""
    made = _listed(call("events_parse", text.encode(), None, 0), "events_parse_field", text.encode())
    call("events_parse", text.encode(), made.ctypes.data, len(made))
    return made


def save_events(path: str | os.PathLike[str], list_of: NDArray[np.void], *, field_m: tuple[float, float] | None = None) -> None:
    """An event list (CSV) of events in time order; load_events gives them back to the bit. `field_m`: width and height that x_m and y_m
    span, which the list then says; None: what load_events knew, or nothing."""
    array, field = checked(list_of), field_m or field_of(list_of) or (0.0, 0.0)
    call("events_save_field", encoded(path), array.ctypes.data, len(array), *field)


def render(list_of: NDArray[np.void], seconds: float, *, layout: str | Layout = "phone4", rate_hz: int = 48000, law: str = "auto", exponent: float = 1.0,
           field_m: tuple[float, float] | None = None, limiter: bool = True) -> NDArray[np.float32]:
    """Samples of events in time order: float32, shape (enchanters, round(seconds * rate_hz)), frame n at n / rate_hz.

    The same samples as `physvib render --from-events`. `field_m`: width and height that x_m and y_m span; None: what load_events knew,
    or the layout's extent. A warning counts hits outside it."""
    array, chosen = checked(list_of), settings(layout, rate_hz, law, exponent, field_m or field_of(list_of), limiter, 0)
    if not 0.0 <= seconds <= 1e6:
        raise PhysVibError("seconds: expected 0 to 10^6", -2)
    width, height = chosen.field_width_m or chosen.layout.extent_width_m, chosen.field_height_m or chosen.layout.extent_height_m
    near = [np.abs(array[axis] - 0.5 * length) <= 0.55 * length for axis, length in (("x_m", width), ("y_m", height))]  # as outsideFieldWarning of the library
    outside = len(array) - np.count_nonzero(near[0] & near[1])
    if outside:
        warnings.warn(f"{outside} of {len(array)} hits lie outside the field of {width:g} x {height:g} m (see field_m)", stacklevel=2)
    samples = np.zeros((chosen.layout.count, round(seconds * rate_hz)), dtype=np.float32)
    call("render", ctypes.byref(chosen), array.ctypes.data, len(array), samples.shape[1], samples.ctypes.data)
    return samples


def save_wav(path: str | os.PathLike[str], samples: ArrayLike, rate_hz: int = 48000) -> None:
    """Samples of shape (channels, frames), or (frames,), as a WAVE file of 32-bit floats, whose full scale is 1. Integers of 8, 16 and 32 bits
    are scaled by the range of their type, as WAV files have them: int16 by 32768, uint8 (whose silence is 128) by 128. Others are refused
    (PhysVibError), and samples that are masked, NaN or infinite."""
    if np.ma.is_masked(samples):
        raise PhysVibError("samples: expected none that are masked (array.filled(0.0) makes silence of them)", -2)
    array = np.atleast_2d(samples)
    if array.dtype.kind in "iu" and array.dtype.itemsize <= 4:
        half = 2.0 ** (8 * array.dtype.itemsize - 1)
        array = (array.astype(np.float64) - (half if array.dtype.kind == "u" else 0.0)) / half
    elif array.dtype.kind != "f":
        raise PhysVibError(f"samples: expected floats, or integers of 8, 16 or 32 bits, found {array.dtype}", -2)
    if array.ndim > 2:
        raise PhysVibError(f"samples: expected the shape (channels, frames), found {array.shape}", -2)
    with np.errstate(over="ignore"):  # infinite then, which the library refuses
        array = np.ascontiguousarray(array, dtype=np.float32)
    call("wav_save", encoded(path), array.ctypes.data, array.shape[0], array.shape[1], rate_hz)
