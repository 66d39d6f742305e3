#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does what a page says, word for word, and prints how long it took: follow.py ROOT BUILD PAGE [INSTALLED].

A block ```LANGUAGE NAME is saved as NAME, ```sh is run, ```python is run. ```sh once (as root) and ```sh device (a device, or a display) are left to the reader. In what is
run, the device is one that plays for nobody: "None:no device". BUILD is a release build; INSTALLED an installed library, for pages that use one. Everything happens in a folder
of its own, whose build/release, Source, Standalone and Tests are the project's. Exit code 1 with the command and what it printed, where one fails."""
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

root, build, page = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
installed = Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None


def blocks(text):
    return re.findall(r"^```([^\n]*)\n(.*?)^```$", text, re.S | re.M)


def environment():
    libraries = {name: next(iter(build.glob(f"lib/{file}")), None) for name, file in
                 (("PHYSVIB_LIBRARY", "libphysvib.so.0"), ("PHYSVIB_LIVE_LIBRARY", "libphysvib-live.so.0"))}
    return os.environ | {"PATH": f"{build / 'bin'}:/usr/bin:{os.environ['PATH']}", "device": "None:no device", "PYTHONPATH": str(root / "Source/Api/Python"),
                         "PYTHONDONTWRITEBYTECODE": "1"} | {name: str(file) for name, file in libraries.items() if file}


def run(script, folder):
    """In one shell, as a reader has one terminal; what is left running in it ends with it."""
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", "trap 'kill $(jobs -p) 2>/dev/null || true' EXIT\n" + script], cwd=folder, env=environment(), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", timeout=300)
    sys.stdout.write(done.stdout)
    if done.returncode != 0:
        sys.exit(f"{page}: exit code {done.returncode} of\n{script}")


def follow(folder):
    (folder / "build").mkdir()
    for name in ("Source", "Standalone", "Tests"):
        (folder / name).symlink_to(root / name)
    if not installed:
        (folder / "build/release").symlink_to(build)
    else:  # a page that builds something of its own in build/
        (folder / "installed").symlink_to(installed)
    count, script = 0, ""
    for info, body in blocks((root / page).read_text()):
        words = info.split()
        body = body.replace('"JACK:system"', '"None:no device"')
        if words == ["sh"]:
            script += body
        elif words == ["python"]:
            script += f"/usr/bin/python3 - <<'END_OF_PYTHON'\n{body}END_OF_PYTHON\n"
        elif len(words) == 2 and words[0] != "sh":
            (folder / words[1]).write_text(body)
        else:
            continue
        count += 1
    run(script, folder)
    return count


with tempfile.TemporaryDirectory() as place:
    begin = time.monotonic()
    done = follow(Path(place))
    if done == 0:
        sys.exit(f"{page}: nothing to follow")
    print(f"{page}: {done} blocks in {time.monotonic() - begin:.0f} s")
