# SPDX-License-Identifier: MIT
"""Where the enchanters sit, and what a renderer is set up with."""
from __future__ import annotations

import ctypes
import itertools
import os
from typing import Sequence

from ._library import MAX_ENCHANTERS, CLayout, CRendererSettings, PhysVibError, call, encoded, filled, library

LAWS = tuple(name.decode() for name in itertools.takewhile(bool, map(library.physvib_law_name, itertools.count())))


class Layout:
    """Places of 1 to 64 enchanters in metres, from the lower left corner of the extent; channel j is places_m[j]."""

    def __init__(self, places_m: Sequence[tuple[float, float]], extent_m: tuple[float, float]) -> None:
        if not 1 <= len(places_m) <= MAX_ENCHANTERS:
            raise PhysVibError("layout: expected 1 to 64 enchanters", -2)
        self.places_m = [(float(x), float(y)) for x, y in places_m]
        self.extent_m = (float(extent_m[0]), float(extent_m[1]))

    @classmethod
    def preset(cls, name: str) -> Layout:
        """By its name, "phone4": they stand in Docs/panning.md."""
        c = CLayout()
        call("layout_preset", name.encode(), ctypes.byref(c))
        return cls._of(c)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Layout:
        """A layout file (JSON)."""
        c = CLayout()
        call("layout_load", encoded(path), ctypes.byref(c))
        return cls._of(c)

    @classmethod
    def parse(cls, text: str) -> Layout:
        """The text of a layout file (JSON)."""
        c = CLayout()
        call("layout_parse", text.encode(), ctypes.byref(c))
        return cls._of(c)

    def __repr__(self) -> str:
        return f"Layout({self.places_m}, extent_m={self.extent_m})"

    def save(self, path: str | os.PathLike[str], name: str) -> None:
        """A layout file (JSON) of that name."""
        call("layout_save", encoded(path), name.encode(), ctypes.byref(self._c()))

    def __len__(self) -> int:
        return len(self.places_m)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Layout) and (self.places_m, self.extent_m) == (other.places_m, other.extent_m)

    @classmethod
    def _of(cls, c: CLayout) -> Layout:
        return cls(list(zip(c.x_m[:c.count], c.y_m[:c.count])), (c.extent_width_m, c.extent_height_m))

    def _c(self) -> CLayout:
        c = CLayout(extent_width_m=self.extent_m[0], extent_height_m=self.extent_m[1], count=len(self))
        for j, (x, y) in enumerate(self.places_m):
            c.x_m[j], c.y_m[j] = x, y
        return c


def settings(layout: str | Layout, rate_hz: int, law: str, exponent: float, field_m: tuple[float, float] | None, limiter: bool,
             channels: int) -> CRendererSettings:
    """`layout`: a preset's name, a file's (.json), or a Layout."""
    if isinstance(layout, str):
        layout = Layout.load(layout) if layout.endswith(".json") else Layout.preset(layout)
    if law not in LAWS:
        raise PhysVibError(f"law: expected one of {', '.join(LAWS)}", -2)
    width, height = field_m or (0.0, 0.0)
    return filled(CRendererSettings, "renderer_settings_init", layout=layout._c(), rate_hz=rate_hz, law=LAWS.index(law), exponent=exponent,
                  field_width_m=width, field_height_m=height, limiter=int(limiter), channels=channels)
