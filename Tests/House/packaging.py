#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a system shows of the programs is whole: every kind of our files has a MIME type, and what menus and software centres read agrees with it,
every package of debian/ is told of in Docs/install.md, and debian/copyright has the licences that files have. packaging.py ROOT"""
import fnmatch
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

root = Path(sys.argv[1])
packaging = root / "Standalone" / "Packaging"
bad = []


def expect(holds: bool, words: str) -> None:
    if not holds:
        bad.append(words)


mime = {"m": "http://www.freedesktop.org/standards/shared-mime-info"}
kinds = ElementTree.parse(packaging / "physvib-mime.xml").getroot().findall("m:mime-type", mime)
types = {kind.attrib["type"] for kind in kinds}
marks = {match.attrib["value"].strip('"') for kind in kinds for match in kind.findall(".//m:match", mime)}
readers = [file for folder in ("Scene", "Live/Documents", "Lab") for file in sorted((root / "Source" / folder).rglob("*.cpp"))]
for file in readers:
    for mark in re.findall(r'"(physvib_[a-z]+)"', file.read_text()): # a plug-in's state is no file
        expect(mark in marks, f"{file.name}: no MIME type for files with {mark}")
columns = re.search(r'value="(time_s,[^"]*)"', (packaging / "physvib-mime.xml").read_text()).group(1).split(",")
expect(all(f'"{column}"' in (root / "Source/Scene/EventColumns.h").read_text() for column in columns), f"event lists begin otherwise than {columns}")

desktop = (packaging / "org.physvib.mixer.desktop").read_text()
opened = set(re.search(r"^MimeType=(.*);$", desktop, re.M).group(1).split(";"))
component = ElementTree.fromstring((packaging / "org.physvib.mixer.metainfo.xml.in").read_text().replace("@PHYSVIB_WEB_FIELDS@", "").encode())
expect(opened <= types, f"the entry of menus opens {opened - types}, which has no MIME type")
expect({told.text for told in component.iter("mediatype")} == opened, "what the mixer opens is told differently in the entry of menus and the metainfo")
expect(component.findtext("launchable") == "org.physvib.mixer.desktop", "metainfo: launchable")
ElementTree.parse(packaging / "org.physvib.mixer.svg")

# What Debian is told of licences is what the files say: the last of its patterns that fits holds.
told = []
for part in (packaging / "debian" / "copyright").read_text().split("\n\n"):
    if files := re.search(r"^Files:(.*?)^\w", part, re.M | re.S):
        licence = re.search(r"^License: (\S+)", part, re.M).group(1)
        told += [(pattern, licence) for pattern in files.group(1).split()]
names = {"MIT": "Expat", "GPL-3.0-or-later": "GPL-3+"}
for folder in ("Docs", "Firmware", "Plugin", "Source", "Standalone", "Tests"):
    for file in sorted(path for path in (root / folder).rglob("*") if path.is_file() and "__pycache__" not in path.parts):
        head = file.read_bytes()[:300].decode(errors="replace")
        if own := re.search(r"SPDX-License-Identifier: ([\w.-]+)", head):
            path = file.relative_to(root).as_posix()
            last = [licence for pattern, licence in told if fnmatch.fnmatch(path, pattern)][-1]
            expect(names.get(own.group(1)) == last, f"debian/copyright: {path} is {own.group(1)}, told as {last}")

# The package for programs in C++ has the modules that CMake installs, and no others.
modules = re.search(r"^foreach\(room ([\w ]+)\)", (root / "Source/Package/CMakeLists.txt").read_text(), re.M).group(1).split()
lines = (packaging / "debian" / "libphysvib-dev.install").read_text().split()
for pattern, spelt in ((r"usr/lib/\*/libphysvib-(\w+)\.a", str.lower), (r"usr/include/physvib/([A-Z]\w+)", str)):
    packed = sorted(found.group(1) for line in lines if (found := re.fullmatch(pattern, line)))
    expect(packed == sorted(map(spelt, modules)), f"libphysvib-dev.install: {packed} of {pattern}, installed are {modules}")

page = (root / "Docs" / "install.md").read_text()
for name in re.findall(r"^Package: (\S+)$", (packaging / "debian" / "control.in").read_text(), re.M):
    expect(f"`{name}`" in page, f"Docs/install.md: not a word of {name}")
if shutil.which("desktop-file-validate"):
    expect(subprocess.run(["desktop-file-validate", packaging / "org.physvib.mixer.desktop"]).returncode == 0, "desktop-file-validate")

sys.exit("\n".join(bad) or 0)
