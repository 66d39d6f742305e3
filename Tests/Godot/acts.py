#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The ten acts of Tests/Engines/acts.py in Godot's three engines; prints the table of Docs/godot.md.

Usage: acts.py PROJECT COMMAND...: the command runs Godot in the folder PROJECT, which has acts.gd and a project.godot. Exit 1 as acts.py of the engines."""
import pathlib
import subprocess
import sys

engines = pathlib.Path(__file__).resolve().parents[1] / "Engines"
if not engines.exists():
    sys.exit("acts.py: expected Tests/Engines beside this folder")
sys.path.insert(0, str(engines))
import acts  # noqa: E402

project, command = pathlib.Path(sys.argv[1]), sys.argv[2:]
settings = project / "project.godot"
plain = settings.read_text()


def play(space, engine):
    """What runs the text of a world and returns its trace."""
    def run(text):
        (project / "world.txt").write_text(text)
        settings.write_text(plain + (f'3d/physics_engine="{engine}"\n' if engine else ""))
        done = subprocess.run([*command, "-s", "acts.gd", "--fixed-fps", "240", "--", f"space={space}", "world=world.txt"], capture_output=True, text=True, check=False)
        return "\n".join(line for line in done.stdout.splitlines() if line.startswith(("m ", "e ")))
    return run


try:
    failed = acts.table({"GodotPhysics2D": play(2, ""), "GodotPhysics3D": play(3, "GodotPhysics3D"), "Jolt": play(3, "Jolt Physics")}, spreads=("Jolt",), known=[("GodotPhysics3D", "heap")])
finally:
    settings.write_text(plain)
sys.exit(1 if failed else 0)
