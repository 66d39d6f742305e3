# SPDX-License-Identifier: MIT
"""Events as arrays, files of them, and whole lists to samples."""
from __future__ import annotations

import ctypes
import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import EVENT, HIT, PhysVibError, call, encoded
from .layout import Layout, settings


def events(time_s: ArrayLike, *, frequency_hz: ArrayLike, decay_per_s: ArrayLike, amplitude: ArrayLike = 1.0, x_m: ArrayLike = 0.0, y_m: ArrayLike = 0.0,
           duration_s: ArrayLike = 0.0, kind: ArrayLike = HIT) -> NDArray[np.void]:
    """Events of dtype EVENT, shape (n,), sorted by time; each argument one number, or n of them. Times are rounded to nanoseconds.
    `kind`: HIT, or ROLL or SLIDE of a grain."""
    seconds, durations = np.asarray(time_s, dtype=np.float64), np.asarray(duration_s, dtype=np.float64)
    if not (np.isfinite(seconds).all() and np.isfinite(durations).all()) or np.abs(seconds).max(initial=0.0) > 1e8 or np.abs(durations).max(initial=0.0) > 1e8:
        raise PhysVibError("time: expected 0 to 10^8 s", -2)
    made = np.zeros(np.broadcast(seconds, frequency_hz, decay_per_s, amplitude, x_m, y_m, durations, kind).shape or (1,), dtype=EVENT)
    made["time_ns"], made["duration_ns"] = np.rint(seconds * 1e9), np.rint(durations * 1e9)
    for name, values in (("frequency_hz", frequency_hz), ("decay_per_s", decay_per_s), ("amplitude", amplitude), ("x_m", x_m), ("y_m", y_m), ("kind", kind)):
        made[name] = values
    made["fixture"] = made["other"] = -1
    return made[np.argsort(made["time_ns"], kind="stable")]


#: Columns of an event list, as files have them (Docs/events.md), and the fields they are. `impulse_ns` is N s.
COLUMNS = {"time_s": "time_ns", "frequency_hz": "frequency_hz", "decay_per_s": "decay_per_s", "amplitude": "amplitude", "x_m": "x_m", "y_m": "y_m",
           "duration_s": "duration_ns", "fixture": "fixture", "other": "other", "impulse_ns": "impulse_n_s", "mass_kg": "mass_kg", "kind": "kind"}
KINDS = ("hit", "roll", "slide")


def frame(list_of: NDArray[np.void]) -> Any:
    """Events as a pandas.DataFrame, with the columns of event lists; needs pandas."""
    import pandas

    array = checked(list_of)
    columns = {column: array[field] * 1e-9 if field.endswith("_ns") else array[field] for column, field in COLUMNS.items()}
    columns["kind"] = np.array(KINDS)[array["kind"]]
    return pandas.DataFrame(columns)


def events_of(table: Any) -> NDArray[np.void]:
    """Events (dtype EVENT, sorted) of a pandas.DataFrame with columns of event lists, as pandas.read_csv reads one; the first six must be there."""
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
                  **{name: column[name] for name in ("frequency_hz", "decay_per_s", "amplitude", "x_m", "y_m")})
    order = np.argsort(np.rint(np.asarray(column["time_s"], dtype=np.float64) * 1e9), kind="stable")
    for name in ("fixture", "other", "impulse_ns", "mass_kg"):
        if name in column:
            made[COLUMNS[name]] = column[name][order]
    return made


def checked(list_of: ArrayLike) -> NDArray[np.void]:
    """Events that the library can read where they are."""
    array = np.ascontiguousarray(events_of(list_of) if hasattr(list_of, "columns") else list_of)
    if array.dtype != EVENT:
        raise PhysVibError("events: expected an array of physvib.EVENT, or a DataFrame with the columns of event lists", -2)
    return array.reshape(-1)


def load_events(path: str | os.PathLike[str]) -> NDArray[np.void]:
    """An event list (CSV): dtype EVENT, shape (n,)."""
    made = np.zeros(call("events_load", encoded(path), None, 0), dtype=EVENT)
    call("events_load", encoded(path), made.ctypes.data, len(made))
    return made


def parse_events(text: str) -> NDArray[np.void]:
    """The text of an event list (CSV): dtype EVENT, shape (n,)."""
    made = np.zeros(call("events_parse", text.encode(), None, 0), dtype=EVENT)
    call("events_parse", text.encode(), made.ctypes.data, len(made))
    return made


def save_events(path: str | os.PathLike[str], list_of: NDArray[np.void]) -> None:
    """An event list (CSV) of events in time order; load_events gives them back to the bit."""
    array = checked(list_of)
    call("events_save", encoded(path), array.ctypes.data, len(array))


def render(list_of: NDArray[np.void], seconds: float, *, layout: str | Layout = "phone4", rate_hz: int = 48000, law: str = "linear", exponent: float = 1.0,
           field_m: tuple[float, float] | None = None, limiter: bool = True) -> NDArray[np.float32]:
    """Samples of events in time order: float32, shape (enchanters, round(seconds * rate_hz)), frame n at n / rate_hz.

    The same samples as `physvib render --from-events`. `field_m`: width and height that x_m and y_m span; None: the layout's extent."""
    array, chosen = checked(list_of), settings(layout, rate_hz, law, exponent, field_m, limiter, 0)
    if not 0.0 <= seconds <= 1e6:
        raise PhysVibError("seconds: expected 0 to 10^6", -2)
    samples = np.zeros((chosen.layout.count, round(seconds * rate_hz)), dtype=np.float32)
    call("render", ctypes.byref(chosen), array.ctypes.data, len(array), samples.shape[1], samples.ctypes.data)
    return samples


def save_wav(path: str | os.PathLike[str], samples: ArrayLike, rate_hz: int = 48000) -> None:
    """Samples of shape (channels, frames), or (frames,), as a WAVE file of 32-bit floats."""
    array = np.ascontiguousarray(np.atleast_2d(samples), dtype=np.float32)
    call("wav_save", encoded(path), array.ctypes.data, array.shape[0], array.shape[1], rate_hz)
