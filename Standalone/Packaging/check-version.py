#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The version of VERSION.txt is that of all that cannot take it from there, and of the tag, if there is one: check-version.py ROOT [RELEASE].
RELEASE: a folder that release.sh made, whose files have it too."""
import json
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

root = Path(sys.argv[1])
release = Path(sys.argv[2]) if len(sys.argv) > 2 else None
version = (root / "VERSION.txt").read_text().strip()
major = version.split(".")[0]
bad = []


def expect(what: str, found: object, expected: object) -> None:
    if found != expected:
        bad.append(f"{what}: {found}, expected {expected}")


def first(file: str, pattern: str) -> str:
    return found[1] if (found := re.search(pattern, (root / file).read_text(), re.M)) else "nothing"


tags = subprocess.run(["git", "-C", root, "tag", "--points-at", "HEAD", "v*"], capture_output=True, text=True).stdout.split() if (root / ".git").exists() and shutil.which("git") else []
for tag in tags:
    expect("tag", tag, f"v{version}")
expect("CHANGELOG.md", first("CHANGELOG.md", r"^## (\S+)" + ("$" if tags else "")), version)
expect("CITATION.cff", first("CITATION.cff", r'^version: "(.*)"'), version)
expect("plugin.cfg", first("Source/Api/Godot/addons/physvib/plugin.cfg", r'^version="(.*)"'), version)
expect("physvib.map", first("Source/Api/C/physvib.map", r"^PHYSVIB_(\S+)"), f"{major}.0")
expect("physvib-live.map", first("Source/Api/Live/physvib-live.map", r"^PHYSVIB_LIVE_(\S+)"), f"{major}.0")
# Sonames, and packages that are named by them: wherever a file says one.
for file in sorted(path for folder in ("Source", "Standalone", "Tests") for path in (root / folder).rglob("*") if path.is_file() and path.suffix != ".pyc"):
    for name in set(re.findall(r"libphysvib(?:-live)?(?:\.so\.)?\d+", file.name + " " + file.read_text(errors="replace"))):
        expect(f"{file.relative_to(root)}: {name}", re.search(r"\d+$", name)[0], major)

if release:
    for file in release.glob("*.whl"):
        expect(file.name, file.name.split("-")[1], version.replace("-", "").replace("rc.", "rc"))
    for file in release.glob("*.tgz"):
        with tarfile.open(file) as archive:
            expect(file.name, json.load(archive.extractfile("package/package.json"))["version"], version)
    for file in release.glob("*-godot.zip"):
        with zipfile.ZipFile(file) as archive:
            expect(file.name, re.search(r'version="(.*)"', archive.read("addons/physvib/plugin.cfg").decode())[1], version)
    for file in release.glob("*.deb"):
        expect(file.name, file.name.split("_")[1].startswith(version.replace("-", "~")), True)
sys.exit("\n".join(bad) or 0)
