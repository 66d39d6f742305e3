# SPDX-License-Identifier: MIT
"""Where the enchanters sit, and what a renderer is set up with."""
from __future__ import annotations

import ctypes
import itertools
import os
from typing import Sequence

from ._header import MAX_ENCHANTERS, CLayout, CRendererSettings
from ._library import PhysVibError, call, encoded, filled, library
from .material_table import part

LAWS = tuple(name.decode() for name in itertools.takewhile(bool, map(library.physvib_law_name, itertools.count())))


class Layout:
    """Places of 1 to 64 enchanters in metres, from the lower left corner of the extent; channel j is places_m[j]: (x, y), or in space (x, y, z).
    `parts`: of each, the name or number of the part of the body it is on ("thumb"; 0: none)."""

    def __init__(self, places_m: Sequence[Sequence[float]], extent_m: tuple[float, float], parts: Sequence[str | int] = ()) -> None:
        if not 1 <= len(places_m) <= MAX_ENCHANTERS:
            raise PhysVibError("layout: expected 1 to 64 enchanters", -2)
        if any(len(place) not in (2, 3) for place in places_m) or len(parts) not in (0, len(places_m)):
            raise PhysVibError("layout: expected places (x, y) or (x, y, z), and as many parts or none", -2)
        is_flat = all(len(place) == 2 or place[2] == 0.0 for place in places_m)
        self.places_m = [tuple(map(float, place[:2] if is_flat else (*place, 0.0)[:3])) for place in places_m]
        self.parts = [part(one) if isinstance(one, str) and one else int(one or 0) for one in parts or [0] * len(places_m)]
        self.extent_m = (float(extent_m[0]), float(extent_m[1]))

    @classmethod
    def preset(cls, name: str) -> Layout:
        """By its name, "phone4": they stand in Docs/panning.md."""
        c = filled(CLayout, "layout_init")
        call("layout_preset", name.encode(), ctypes.byref(c))
        return cls._of(c)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Layout:
        """A layout file (JSON)."""
        c = filled(CLayout, "layout_init")
        call("layout_load", encoded(path), ctypes.byref(c))
        return cls._of(c)

    @classmethod
    def parse(cls, text: str) -> Layout:
        """The text of a layout file (JSON)."""
        c = filled(CLayout, "layout_init")
        call("layout_parse", text.encode(), ctypes.byref(c))
        return cls._of(c)

    def __repr__(self) -> str:
        parts = f", parts={self.parts}" if any(self.parts) else ""
        return f"Layout({self.places_m}, extent_m={self.extent_m}{parts})"

    def save(self, path: str | os.PathLike[str], name: str) -> None:
        """A layout file (JSON) of that name."""
        call("layout_save", encoded(path), name.encode(), ctypes.byref(self._c()))

    def __len__(self) -> int:
        return len(self.places_m)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Layout) and (self.places_m, self.extent_m, self.parts) == (other.places_m, other.extent_m, other.parts)

    @classmethod
    def _of(cls, c: CLayout) -> Layout:
        places = list(zip(c.x_m[:c.count], c.y_m[:c.count], c.z_m[:c.count]))
        return cls(places, (c.extent_width_m, c.extent_height_m), c.part[:c.count])

    def _c(self) -> CLayout:
        c = CLayout(size=ctypes.sizeof(CLayout), extent_width_m=self.extent_m[0], extent_height_m=self.extent_m[1], count=len(self))
        for j, (place, part_of_it) in enumerate(zip(self.places_m, self.parts)):
            c.x_m[j], c.y_m[j], c.z_m[j] = (*place, 0.0)[:3]
            c.part[j] = part_of_it
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
