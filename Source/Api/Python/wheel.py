#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a wheel of the package and the library: wheel.py LIBPHYSVIB.so FOLDER. `pip install` takes it without a network or a compiler.

libhwy, which few machines have, goes with it."""
import base64
import hashlib
import platform
import subprocess
import sys
import zipfile
from pathlib import Path


def needed(library: Path, name: str) -> Path:
    lines = subprocess.run(["ldd", str(library)], check=True, capture_output=True, text=True).stdout.splitlines()
    return Path(next(line.split("=>")[1].split()[0] for line in lines if name in line))


def main() -> None:
    library, folder = Path(sys.argv[1]), Path(sys.argv[2])
    package = Path(__file__).parent / "physvib"
    version = library.resolve().name.split(".so.")[1]
    tag = f"py3-none-linux_{platform.machine()}"
    files = {f"physvib/{path.name}": path.read_bytes() for path in sorted(package.iterdir()) if path.suffix in (".py", ".typed")}
    files["physvib/libphysvib.so.0"] = library.read_bytes()
    files["physvib/libhwy.so.1"] = needed(library, "libhwy").read_bytes()
    about = f"physvib-{version}.dist-info"
    files[f"{about}/METADATA"] = (f"Metadata-Version: 2.1\nName: physvib\nVersion: {version}\nSummary: Collisions one can feel\nLicense: MIT\n"
                                  "Requires-Python: >=3.9\nRequires-Dist: numpy\n").encode()
    files[f"{about}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: physvib\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    rows = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}" for name, data in files.items()]
    files[f"{about}/RECORD"] = "\n".join([*rows, f"{about}/RECORD,,", ""]).encode()
    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"physvib-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0)), data)
    print(wheel)


main()
