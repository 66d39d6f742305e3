#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a wheel of the package and the library: wheel.py LIBPHYSVIB.so FOLDER. `pip install` takes it without a network or a compiler. As pip's build
backend (pyproject.toml) it compiles the library first.

Libraries that few machines have go with it. Its tag says how old a Linux may be, by the newest symbols that it asks for (PEP 600)."""
from __future__ import annotations

import base64
import hashlib
import os
import platform
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

#: Of every Linux with glibc.
EVERYWHERE = re.compile(r"(libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+|ld-linux[-a-z0-9_]*)\.so\.\d+")
#: The glibc of the first Linux that has this libstdc++ (auditwheel's policies).
GLIBC_OF_CXX = {"3.4.19": (2, 17), "3.4.22": (2, 24), "3.4.24": (2, 27), "3.4.25": (2, 28), "3.4.28": (2, 31), "3.4.29": (2, 34), "3.4.30": (2, 35), "3.4.33": (2, 39)}


def version_of(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in text.split("."))


def output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed(library: Path) -> dict[str, Path]:
    """What goes with it: by name, where it is here."""
    own = set(re.findall(r"NEEDED\s+(\S+)", output("objdump", "-p", str(library))))
    found = dict(re.findall(r"(\S+) => (/\S+)", output("ldd", str(library))))
    return {name: Path(found[name]) for name in sorted(own) if not EVERYWHERE.fullmatch(name)}


def glibc_of(library: Path) -> tuple[int, ...]:
    """The oldest glibc of a Linux on which it loads."""
    symbols = output("objdump", "-T", str(library))
    wanted = [version_of(version) for version in re.findall(r"GLIBC_([0-9.]+)", symbols)] + [(2, 17)]
    newest = max((version_of(version) for version in re.findall(r"GLIBCXX_([0-9.]+)", symbols)), default=(3, 4))
    later = [glibc for cxx, glibc in GLIBC_OF_CXX.items() if version_of(cxx) >= newest]
    if not later:
        raise SystemExit(f"{library}: GLIBCXX_{'.'.join(map(str, newest))}: newer than any that wheel.py knows")
    return max(max(wanted)[:2], min(later))


def tag_of(libraries: list[Path]) -> str:
    if sys.platform != "linux":
        raise SystemExit("wheel.py: expected Linux")
    return "py3-none-manylinux_{}_{}_{}".format(*max(glibc_of(library) for library in libraries), platform.machine())


def make(library: Path, folder: Path, isGivenAway: bool = True) -> Path:
    package, root = Path(__file__).parent / "physvib", Path(__file__).resolve().parents[3]
    version = re.sub(r"-(\w+)\.", r"\1", (root / "VERSION.txt").read_text().strip())  # 1.0.0rc1, as wheels write it
    others = needed(library)
    tag = tag_of([library, *others.values()])
    files = {f"physvib/{path.name}": path.read_bytes() for path in sorted(package.iterdir()) if path.suffix in (".py", ".typed")}
    files["physvib/libphysvib.so.1"] = library.read_bytes()
    for name, path in others.items():
        files[f"physvib/{name}"] = path.read_bytes()
    about = f"physvib-{version}.dist-info"
    addresses = "".join(f"Project-URL: {name}, {os.environ[key]}\n" for name, key in (("Homepage", "PHYSVIB_HOMEPAGE"), ("Source", "PHYSVIB_REPOSITORY")) if os.environ.get(key))
    files[f"{about}/METADATA"] = (f"Metadata-Version: 2.1\nName: physvib\nVersion: {version}\nSummary: Collisions one can feel\nAuthor: The PhysVib developers\nLicense: MIT\n{addresses}"
                                  "Requires-Python: >=3.9\nRequires-Dist: numpy\nProvides-Extra: pandas\nRequires-Dist: pandas; extra == 'pandas'\n").encode()
    files[f"{about}/LICENSE"] = (root / "LICENSES/MIT.txt").read_bytes()
    if isGivenAway:
        files[f"{about}/THIRD-PARTY.txt"] = output(sys.executable, str(root / "Standalone/Packaging/sbom.py"), "--licences", "wheel").encode()
    files[f"{about}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: physvib\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    rows = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}" for name, data in files.items()]
    files[f"{about}/RECORD"] = "\n".join([*rows, f"{about}/RECORD,,", ""]).encode()
    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"physvib-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0)), data)
    return wheel


def build_wheel(folder: str, config_settings: object = None, metadata_directory: object = None) -> str:
    """For pip (PEP 517): compiles the library by the preset `library`, whose packages Docs/c.md names."""
    root = Path(__file__).resolve().parents[3]
    with tempfile.TemporaryDirectory() as build:
        for command in (["cmake", "--preset", "library", "-B", build], ["cmake", "--build", build, "--target", "physvib-c"]):
            subprocess.run(command, check=True, cwd=root)
        return make(next(Path(build).glob("lib/libphysvib.so.1")), Path(folder), isGivenAway=False).name


def build_sdist(folder: str, config_settings: object = None) -> str:
    raise SystemExit("physvib: expected `pip install .` in the repository; there is no source archive of the Python package alone")


if __name__ == "__main__":
    print(make(Path(sys.argv[1]), Path(sys.argv[2])))
