# SPDX-License-Identifier: MIT
"""The shared library and its errors."""
from __future__ import annotations

import contextlib
import ctypes
import os
from ctypes import Structure, c_void_p
from pathlib import Path
from types import SimpleNamespace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ._header import EVENT, signatures


class PhysVibError(ValueError):
    """What was expected, in one line. Nothing has changed."""

    def __init__(self, line: str, code: int) -> None:
        super().__init__(line)
        self.code = code


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


_long = frozenset({"material_load", "layout_load", "layout_save", "events_load", "events_load_field", "events_save_field", "wav_save", "render", "renderer_create", "renderer_pull"})
library = load(_path(), signatures, _long)


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


def blank_events(count: int | tuple[int, ...]) -> NDArray[np.void]:
    """Events of zeros that say their size, as a list has to."""
    made = np.zeros(count, dtype=EVENT)
    made["size"] = EVENT.itemsize
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
