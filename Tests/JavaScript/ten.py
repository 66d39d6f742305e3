# SPDX-License-Identifier: MIT
"""The ten worlds of Tests/Engines in each engine of JavaScript, beside native Box2D: ten.py FOLDER NATIVE. FOLDER: where npm has installed physvib
and the engines; NATIVE: physvib-engine-box2d. Prints the table; leaves the traces in FOLDER/ten.json, which those of a browser are held against."""
import json
import os
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, "..", "Engines"))
import worlds  # noqa: E402

ENGINES = {"Matter": "matter", "Planck": "planck", "Rapier": "rapier2d", "Box2D 3": "box2d3"}
# What an engine, or what it tells, does not give; Docs/javascript-measured.md says more.
KNOWN = {}


def in_node(folder):
    """{ label: play }, which keeps the traces."""
    kept = {}

    def engine(name):
        by_node = worlds.by_command(f"node {here}/trace.mjs {folder} {name}")

        def play(text):
            kept[name + "\n" + text] = by_node(text)
            return kept[name + "\n" + text]
        return play
    return {label: engine(name) for label, name in ENGINES.items()}, kept


def main():
    folder, native = (os.path.abspath(path) for path in sys.argv[1:3])
    engines, kept = in_node(folder)
    failed = worlds.table({"native Box2D 2.4": worlds.by_command(native), **engines}, KNOWN)
    with open(os.path.join(folder, "ten.json"), "w") as file:
        json.dump(kept, file)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
