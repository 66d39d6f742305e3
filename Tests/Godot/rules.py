# SPDX-License-Identifier: MIT
"""The addon's archive by the rules of Godot's asset library, and by what it promises: rules.py ZIP. All lies in addons/physvib, with
licence and readme; Godot need not write a file into it; its libraries need nothing that neither it nor each Linux has, and ask no folder but
their own; each library of others has its licence beside."""
import configparser
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

SYSTEMS = re.compile(r"lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|asound|jack)\.so\.|ld-linux")
wrong = []


def check(is_right: bool, what: str) -> None:
    if not is_right:
        wrong.append(what)


with tempfile.TemporaryDirectory() as folder:
    with zipfile.ZipFile(sys.argv[1]) as archive:
        archive.extractall(folder)
    addon = Path(folder, "addons/physvib")
    names = sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*") if path.is_file())
    for name in names:
        check(name.startswith("addons/physvib/"), f"{name} is not in addons/physvib")
        check(not re.search(r"/\.git(?!dignore)|\.(exe|zip|tmp|log|o)$|\.godot/", name), f"{name} is no part of an addon")
        writes = {".gd": ".uid", ".gdextension": ".uid", ".svg": ".import"}.get(Path(name).suffix)
        check(writes is None or name + writes in names, f"{name}: Godot writes its {writes} into the user's folder")
    check("Permission is hereby granted" in (addon / "LICENSE").read_text(), "LICENSE is not MIT's")
    check((addon / "README.md").stat().st_size > 200, "README.md says nothing")
    plugin = configparser.ConfigParser()
    plugin.read(addon / "plugin.cfg")
    for key in ("name", "description", "author", "version", "script"):
        check(plugin["plugin"].get(key, '""') != '""', f"plugin.cfg lacks {key}")
    check((addon / plugin["plugin"]["script"].strip('"')).is_file(), "plugin.cfg names a script that is not there")

    named = set(re.findall(r'"(bin/[^"]+)"', (addon / "physvib.gdextension").read_text().replace("res://addons/physvib/", "")))
    systems = [path for path in (addon / "bin").iterdir() if path.is_dir()]
    check(bool(systems), "no library")
    licences = "".join(path.read_text(errors="replace") for path in (addon / "bin").iterdir() if path.is_file())
    for system in systems:
        libraries = sorted(system.iterdir())
        check(any(f"bin/{system.name}/{path.name}" in named for path in libraries), f"physvib.gdextension names nothing in bin/{system.name}")
        beside = {path.name for path in libraries}
        for library in libraries if system.name.startswith("linux") else ():
            said = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
            for need in re.findall(r"NEEDED.*\[(.+?)\]", said):
                check(need in beside or bool(SYSTEMS.match(need)), f"{system.name}/{library.name} needs {need}")
            for path in re.findall(r"(?:RPATH|RUNPATH).*\[(.*?)\]", said):
                check(path == "$ORIGIN", f"{system.name}/{library.name} looks for libraries in {path!r}")
    for other in ("Highway", "nlohmann"):
        check(other.lower() in licences.lower(), f"no licence of {other}")
print("\n".join(f"WRONG: {line}" for line in wrong) or f"right: {len(names)} files, libraries for {', '.join(path.name for path in systems)}")
sys.exit(bool(wrong))
