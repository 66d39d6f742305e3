#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""windows-syntax.py BUILD [REGEX]: reads our sources with MinGW's compiler, also those that it cannot build for want of libraries.

BUILD is a configured build of this machine (build/release), whose definitions and folders are used; REGEX says which sources (the rooms
that windows.sh does not build). Nothing is compiled: it shows that names, headers and JUCE's own files are there for Windows. Needs
libz-mingw-w64-dev beside the packages of windows.sh; takes a quarter of an hour."""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOMS = r"(Source/(Session|Host|Api/Live)|Plugin|Standalone/(CommandLine|Mixer))/"
HEADERS = ["nlohmann", "CLI", "box2d", "hwy", "lo", "aubio", "libserialport.h", "samplerate.h", "eigen3/Eigen", "eigen3/unsupported"]
OTHER_SYSTEM = re.compile(r"-D(JUCE_LINUX|LINUX)\b|-I/usr/include")


def flags(command: str) -> list[str]:
    words = shlex.split(command)
    kept = [word for word in words if word.startswith(("-D", "-I")) and not OTHER_SYSTEM.match(word)]
    for word, following in zip(words, words[1:]):
        if word == "-isystem" and not following.startswith("/usr/include"):
            kept += [word, following]
    return kept


def main() -> int:
    root = pathlib.Path(__file__).resolve().parents[2]
    wanted = re.compile(sys.argv[2] if len(sys.argv) > 2 else ROOMS)
    entries = {}
    for entry in json.loads(pathlib.Path(sys.argv[1], "compile_commands.json").read_text()):
        path = os.path.relpath(entry["file"], root)
        if wanted.match(path):
            entries.setdefault(path, entry)
    with tempfile.TemporaryDirectory() as headers:  # not all of /usr/include, which is another system's
        for name in HEADERS:
            pathlib.Path(headers, pathlib.Path(name).name).symlink_to(pathlib.Path("/usr/include", name))

        def read(item):
            path, entry = item
            compiler = ["x86_64-w64-mingw32-g++-posix", "-std=c++20", "-fsyntax-only", "-w", "-DJUCE_MODULE_AVAILABLE_juce_audio_devices=1", "-isystem", headers, "-isystem", "/usr/share/juce/modules"]
            return path, subprocess.run(compiler + flags(entry["command"]) + [entry["file"]], cwd=entry["directory"], capture_output=True, text=True)

        bad = 0
        with concurrent.futures.ThreadPoolExecutor(2) as both:
            for path, result in both.map(read, sorted(entries.items())):
                if result.returncode != 0:
                    bad += 1
                    print(path, *[line for line in result.stderr.splitlines() if "error" in line][:3], sep="\n    ")
    print(f"{len(entries) - bad} of {len(entries)} sources are read without an error")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
