# SPDX-License-Identifier: MIT
"""The ten worlds and ten acts of Tests/Engines in each engine of JavaScript, beside native Box2D: ten.py FOLDER NATIVE. FOLDER: where npm has installed physvib
and the engines; NATIVE: physvib-engine-box2d. Prints the table; leaves the traces in FOLDER/ten.json, which those of a browser are held against."""
import json
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, "..", "Engines"))
import acts  # noqa: E402
import worlds  # noqa: E402

ENGINES = {"Matter": "matter", "Planck": "planck", "Rapier": "rapier2d", "Box2D 3": "box2d3"}
# What an engine, or what it tells, does not give: by engine, world and steps a second.
KNOWN = {
    ("Matter", "pole", 60): "momentum alone does not tell the head's push from the foot's, and its head bounces",
    ("Matter", "pole", 240): "momentum alone does not tell the head's push from the foot's",
    ("Matter", "domino row", 240): "one of five is felt late, as it slides",
    ("Matter", "stack that lands", 60): "it stops a stack in several steps",
    ("Matter", "stack that lands", 240): "it stops a stack in several steps",
    ("Matter", "chain of ghosts", 60): "it has no chains: seams jolt",
    ("Matter", "ragdoll", 60): "its feet are not felt",
    ("Matter", "ball on slope", 60): "its ball has 60 corners, and hops as it rolls",
    ("Matter", "ball on slope", 240): "its ball has 60 corners, and hops as it rolls: of 100 it does not",
    ("Matter", "pile at rest", 60): "its pile does not rest",
    ("Planck", "stack that lands", 60): "the boxes above arrive in the next step, as a load",
    ("Rapier", "pole", 60): "it pushes the head in two steps, and both are felt",
    ("Rapier", "Newton's cradle", 60): "it hands on over several steps",
    ("Rapier", "Newton's cradle", 240): "it hands on over several steps",
    ("Rapier", "stack that lands", 240): "a box that leans is felt once more",
    ("Box2D 3", "domino row", 60): "its first step gives one of five less than the threshold",
}


def texts():
    """All worlds at all rates, as text."""
    return [worlds.text_of(make, rate) for _, make, _ in worlds.WORLDS for rate in worlds.rates()]


def in_node(folder, name, texts):
    """{ text: trace } of an engine, by one process."""
    with tempfile.TemporaryDirectory() as work:
        paths = [os.path.join(work, str(i)) for i, _ in enumerate(texts)]
        for path, text in zip(paths, texts):
            with open(path, "w") as file:
                file.write(text)
        subprocess.run(["node", os.path.join(here, "trace.mjs"), folder, name, *paths], check=True)
        return {text: open(path + ".trace").read() for path, text in zip(paths, texts)}


def main():
    folder, native = (os.path.abspath(path) for path in sys.argv[1:3])
    traces = {name: in_node(folder, name, texts()) for name in ENGINES.values()}
    with open(os.path.join(folder, "ten.json"), "w") as file:
        json.dump(traces, file)
    engines = {label: traces[name].__getitem__ for label, name in ENGINES.items()}
    failed = worlds.table({"native Box2D 2.4": worlds.by_command(native), **engines}, KNOWN)
    played = [acts.text_of(make) for _, make, _, _ in acts.ACTS]
    acts.table({label: in_node(folder, name, played).__getitem__ for label, name in ENGINES.items()}) # what they miss is told, not failed
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
