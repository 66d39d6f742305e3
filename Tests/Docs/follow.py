#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Types what a page says, word for word, as a reader who begins in the folder of the source, and looks at what was felt: follow.py ROOT PAGE [BUILD [INSTALLED]].

A block ```LANGUAGE NAME is saved as NAME where the reader is, ```sh is typed, ```python is run. ```sh device (a device, or a display) is left to the reader.
<!-- felt FILE.wav PEAK...; ... --> stands behind what made the file: the peak of each of its channels. <!-- has python.md --> says that Python knows the package from there on.

Without BUILD, ```sh once is typed as well, in ROOT itself: on a bare Debian, as root (fresh-machine.sh --tutorials). With it the reader has a copy of the source, in which BUILD
is what ```sh once has built; INSTALLED is what it has installed, as ~/physvib. Nothing is linked, and PATH is what the page has made of it. In what is typed, the device is
one that plays for nobody: "None:no device". Exit code 1 with the command and what it printed, where one fails or feels otherwise."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

root, page = Path(sys.argv[1]).resolve(), sys.argv[2]
build, installed = (Path(sys.argv[i]).resolve() if len(sys.argv) > i else None for i in (3, 4))
parts = re.compile(r"^```([^\n]*)\n(.*?)^```$|<!-- (felt|has) (.*?) -->$", re.S | re.M)
programs = ("physvib", "physvib-render", "physvib-virtual-board")


def copied(home):
    """The reader's source, built."""
    here = home / "PhysVib"
    shutil.copytree(root, here, ignore=lambda folder, names: {"build", ".git", "out"} & set(names) if Path(folder) == root else ())
    there = here / "build/release"
    for name in (*(f"bin/{name}" for name in programs), "firmware/physvib-f334.elf", "firmware/physvib-f334.bin"):
        if (build / name).exists():
            (there / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(build / name, there / name)
    if installed:
        shutil.copytree(installed, home / "physvib")
    return here


def environment(home):
    kept = {name: os.environ[name] for name in ("LANG", "http_proxy") if name in os.environ}
    return kept | {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": str(home), "device": "None:no device", "PYTHONDONTWRITEBYTECODE": "1"}


def has_python():
    """What python.md leaves behind; on a bare Debian its own test does that (ten-minutes.sh)."""
    libraries = {name: next(iter(build.glob(f"lib/{file}")), "") for name, file in (("PHYSVIB_LIBRARY", "libphysvib.so.1"), ("PHYSVIB_LIVE_LIBRARY", "libphysvib-live.so.1"))}
    return "".join(f"export {name}='{file}'\n" for name, file in ({"PYTHONPATH": root / "Source/Api/Python"} | libraries).items())


def typed(text):
    """One script, as a reader has one terminal, whose folder and PATH go on; and how many blocks it is of."""
    script, count = "", 0
    for info, body, mark, words in parts.findall(text):
        named = info.split()
        body = body.replace('"JACK:system"', '"None:no device"')
        if mark == "felt":
            for file in words.split("; "):  # a person looks when it is there
                script += f"for _ in $(seq 100); do [ ! -s {file.split()[0]} ] || break; sleep 0.1; done; sleep 0.3; /usr/bin/python3 '{root}/Tests/Docs/felt.py' {file}\n"
        elif mark == "has":
            script += has_python() if build else "exit 0\n"
        elif named == ["sh"] or (named == ["sh", "once"] and not build):
            script += body
        elif named == ["python"]:
            script += f"/usr/bin/python3 - <<'END_OF_PYTHON'\n{body}END_OF_PYTHON\n"
        elif len(named) == 2 and named[0] != "sh":
            script += f"cat >{named[1]} <<'END_OF_FILE'\n{body}END_OF_FILE\n"
        else:
            continue
        count += 1
    return script, count


def follow(home):
    script, count = typed((root / page).read_text())
    here = copied(home) if build else root
    # What is left running in the terminal ends with it.
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", "trap 'kill $(jobs -p) 2>/dev/null || true' EXIT\n" + script], cwd=here, env=environment(home), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", timeout=300 if build else None)
    sys.stdout.write(done.stdout)
    if done.returncode != 0:
        sys.exit(f"{page}: exit code {done.returncode} of\n{script}")
    return count


with tempfile.TemporaryDirectory() as place:
    begin = time.monotonic()
    done = follow(Path(place))
    if done == 0:
        sys.exit(f"{page}: nothing to follow")
    print(f"{page}: {done} blocks in {time.monotonic() - begin:.0f} s")
