# SPDX-License-Identifier: MIT
"""A renderer that is pulled block by block, by whoever owns the audio callback."""
from __future__ import annotations

import ctypes
from ctypes import POINTER, c_float, c_void_p
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._header import CRendererStatus
from ._library import Owned, PhysVibError, call, filled, library
from .files import checked
from .layout import Layout, settings


class Status(NamedTuple):
    """Counts since the beginning, as of the last pull."""
    live_modes: int
    pending: int
    frames: int
    played: int
    late: int      #: played at once, after their time
    rejected: int  #: could not be played
    refused: int   #: found 8,192 others waiting


class Renderer(Owned):
    """Strikes in from any thread, samples out to one. Time 0 is the first frame pulled; a strike is heard on its place between two
    frames, however busy the interpreter is, if it is told before that block is pulled."""
    _frees = "renderer_free"

    def __init__(self, *, layout: str | Layout = "phone4", rate_hz: int = 48000, channels: int = 0, law: str = "auto", exponent: float = 1.0,
                 field_m: tuple[float, float] | None = None, limiter: bool = True) -> None:
        self._handle = c_void_p()
        chosen = settings(layout, rate_hz, law, exponent, field_m, limiter, channels)
        call("renderer_create", ctypes.byref(chosen), ctypes.byref(self._handle))
        self.rate_hz, self.channels = rate_hz, channels or chosen.layout.count

    def strike(self, events: NDArray[np.void]) -> None:
        """Plays events (dtype EVENT) at their times; those whose time is over, at once."""
        array = checked(events)
        for i in range(len(array)):
            call("renderer_strike", self._handle, array.ctypes.data + i * array.itemsize)

    def impact(self, x_m: float, y_m: float, strength: float, *, material: str | None = None) -> None:
        """One impact at the next pull: at that place of the field, 0 to 1 of full scale; of a built-in material (see `materials`), else of 200 Hz."""
        if material is None:
            call("renderer_impact", self._handle, x_m, y_m, strength)
        else:
            call("renderer_impact_of", self._handle, material.encode(), x_m, y_m, strength)

    def pull(self, frames: int, out: NDArray[np.float32] | None = None) -> NDArray[np.float32]:
        """The next frames: float32, shape (channels, frames). `out`: such an array, to be written to."""
        if out is None:
            out = np.empty((self.channels, frames), dtype=np.float32)
        if out.shape != (self.channels, frames) or out.dtype != np.float32 or not out.flags.c_contiguous or not out.flags.writeable:
            raise PhysVibError("out: expected float32 of shape (channels, frames), row by row", -2)
        rows = (POINTER(c_float) * self.channels)(*[ctypes.cast(out.ctypes.data + j * out.strides[0], POINTER(c_float)) for j in range(self.channels)])
        code = library.physvib_renderer_pull(self._handle, rows, self.channels, frames)
        if code < 0:  # it has no words for it
            raise PhysVibError("pull: expected a renderer that is not closed, 1 frame or more, one thread at a time", code)
        return out

    def set_gain(self, channel: int, gain: float, time_ns: int = 0) -> None:
        """From time_ns on: 0 to 10,000, in a glide of 10 ms."""
        call("renderer_set_gain", self._handle, time_ns, channel, gain)

    def set_mute(self, channel: int, is_muted: bool, time_ns: int = 0) -> None:
        """From time_ns on."""
        call("renderer_set_mute", self._handle, time_ns, channel, int(is_muted))

    def set_level(self, gain: float, time_ns: int = 0) -> None:
        """Of all channels, on top of their gains."""
        call("renderer_set_level", self._handle, time_ns, gain)

    def set_layout(self, layout: str | Layout, *, law: str = "auto", exponent: float = 1.0, field_m: tuple[float, float] | None = None, time_ns: int = 0) -> None:
        """Later strikes sit there; at most as many enchanters as channels."""
        call("renderer_set_layout", self._handle, time_ns, ctypes.byref(settings(layout, self.rate_hz, law, exponent, field_m, True, 0)))

    def silence(self, until_ns: int, time_ns: int = 0) -> None:
        """What rings at time_ns fades within 10 ms, and no event before until_ns is played."""
        call("renderer_silence", self._handle, time_ns, until_ns)

    @property
    def latency_frames(self) -> int:
        """By which samples lag the events' times: the limiter's look-ahead."""
        return call("renderer_latency_frames", self._handle)

    @property
    def status(self) -> Status:
        """As of the last pull."""
        told = filled(CRendererStatus, "renderer_status_init")
        call("renderer_get_status", self._handle, ctypes.byref(told))
        return Status(*[getattr(told, name) for name in Status._fields])


def play_out_s(*, rate_hz: int = 48000, block_frames: int = 256, steps_per_s: int = 100, longest_gap_s: float = 0.026) -> float:
    """L: how much later a world's hits must be struck so that all of them come in time. Docs/timings.md."""
    return call("play_out_ns", rate_hz, block_frames, steps_per_s, longest_gap_s) * 1e-9
