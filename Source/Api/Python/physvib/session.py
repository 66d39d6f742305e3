# SPDX-License-Identifier: MIT
"""Session files: what the mixer, the plug-in, `physvib play --save` and Live(save=...) write. Loads libphysvib-live."""
from __future__ import annotations

import ctypes
import os
from ctypes import c_void_p

import numpy as np
from numpy.typing import NDArray

from ._header import CRendererSettings
from ._library import Owned, PhysVibError, blank_events, encoded, filled
from ._live_library import live_call
from .files import checked, field_of
from .layout import LAWS, Layout, settings


class Session(Owned):
    """What was done in a session, so that it can be felt again: worlds and what was done to them, strikes, changes of gains and layouts. It does
    not change; any thread."""
    _call = staticmethod(live_call)
    _frees = "session_free"

    def __init__(self, list_of: NDArray[np.void], seconds: float, *, layout: str | Layout = "phone4", channels: int = 0, law: str = "auto",
                 exponent: float = 1.0, field_m: tuple[float, float] | None = None, limiter: bool = True) -> None:
        """One of events alone (dtype EVENT, in time order), without a world; it lasts so many seconds."""
        array, self._handle = checked(list_of), c_void_p()
        renderer = settings(layout, 48000, law, exponent, field_m or field_of(list_of), limiter, channels)
        live_call("session_create", ctypes.byref(renderer), array.ctypes.data, len(array), _ns(seconds), ctypes.byref(self._handle))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Session:
        """A session file (JSON), also one that was cut off while it was played."""
        made = cls.__new__(cls)
        made._handle = c_void_p()
        live_call("session_load", encoded(path), ctypes.byref(made._handle))
        return made

    def save(self, path: str | os.PathLike[str]) -> None:
        """As a file that the mixer and `physvib render` read."""
        live_call("session_save", self._handle, encoded(path))

    @property
    def seconds(self) -> float:
        """How long it was played."""
        return live_call("session_length_ns", self._handle) * 1e-9

    @property
    def channels(self) -> int:
        """Outputs; at least as many as any of its layouts has enchanters."""
        return self._renderer().channels

    @property
    def layout(self) -> Layout:
        """As it was at the start."""
        return Layout._of(self._renderer().layout)

    @property
    def law(self) -> str:
        """Of panning, as it was at the start."""
        return LAWS[self._renderer().law]

    @property
    def exponent(self) -> float:
        """Of the law."""
        return self._renderer().exponent

    @property
    def field_m(self) -> tuple[float, float]:
        """Metres that x_m and y_m span, as they were at the start."""
        renderer = self._renderer()
        return renderer.field_width_m, renderer.field_height_m

    def events(self, seconds: float | None = None) -> NDArray[np.void]:
        """What was felt, dtype EVENT, shape (n,), by simulating its worlds again: of its first seconds, or of all of it."""
        end = live_call("session_length_ns", self._handle) if seconds is None else _ns(seconds)
        made = blank_events(live_call("session_events", self._handle, end, None, 0))
        live_call("session_events", self._handle, end, made.ctypes.data, len(made))
        return made

    def render(self, seconds: float | None = None, rate_hz: int = 48000) -> NDArray[np.float32]:
        """Its samples, float32, shape (channels, round(seconds * rate_hz)): those of `physvib render SESSION.json`."""
        length_ns = live_call("session_length_ns", self._handle) if seconds is None else _ns(seconds)
        samples = np.zeros((self.channels, round(length_ns * 1e-9 * rate_hz)), dtype=np.float32)
        live_call("session_render", self._handle, rate_hz, samples.shape[1], samples.ctypes.data)
        return samples

    def _renderer(self) -> CRendererSettings:
        told = filled(CRendererSettings, "renderer_settings_init")
        live_call("session_get_renderer", self._handle, ctypes.byref(told))
        return told


def _ns(seconds: float) -> int:
    if not 0.0 <= seconds <= 86400.0:
        raise PhysVibError("seconds: expected 0 to 86400", -2)
    return round(seconds * 1e9)
