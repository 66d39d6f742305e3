# SPDX-License-Identifier: MIT
"""The library with devices, boards and sessions. It is loaded when something of it is first wanted."""
from __future__ import annotations

import functools
import os
from pathlib import Path
from types import SimpleNamespace

from ._library import PhysVibError, library, load
from ._live_header import signatures

_long = frozenset({"live_devices", "live_open", "live_close", "session_load", "session_save", "session_create", "session_render"})


@functools.lru_cache(maxsize=None)
def live_library() -> SimpleNamespace:
    """PHYSVIB_LIVE_LIBRARY, or libphysvib-live.so.1 beside the other one or where the system finds it."""
    beside = Path(library.path).parent / "libphysvib-live.so.1"
    path = os.environ.get("PHYSVIB_LIVE_LIBRARY") or (str(beside) if beside.exists() else "libphysvib-live.so.1")
    try:
        return load(path, signatures, _long)
    except OSError as fault:
        raise PhysVibError(f"expected {path}, the library with devices (Docs/python.md says whence): {fault}", -4) from None


def live_call(name: str, *arguments: object) -> int:
    """A code or a count; of an error, PhysVibError."""
    result = getattr(live_library(), "physvib_" + name)(*arguments)
    if result < 0:
        raise PhysVibError(live_library().physvib_live_error().decode(errors="replace"), result)
    return result
