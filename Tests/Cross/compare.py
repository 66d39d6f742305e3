# SPDX-License-Identifier: MIT
# Renders of two systems side by side: which are the same bytes, and how far apart the others are.
# usage: compare.py FOLDER SCENE...   (scenes that must be the same)
import array
import glob
import os
import sys


def content(path):
    with open(path, "rb") as file:
        return file.read()


def samples(path):
    data = content(path)
    return array.array("f", data[data.index(b"data") + 8:])


def events(path):
    rows = content(path).decode().replace("\r", "").split("\n")
    return [row for row in rows if row and not row.startswith("#")][1:]


def apart(a, b):
    """How many events are the same to the last digit, and the largest difference of a figure as a share of it; None if a course parts."""
    same = sum(x == y for x, y in zip(a, b))
    if len(a) != len(b):
        return same, None
    worst = 0.0
    for x, y in zip(a, b):
        for p, q in zip(x.split(","), y.split(",")):
            if p == q:
                continue
            p, q = float(p), float(q)
            worst = max(worst, abs(p - q) / max(abs(p), abs(q), 1e-300))
    return same, worst if worst < 1e-3 else None


def line(here, there):
    """What is told of one render, and whether it is the same within rounding."""
    mine, theirs = events(here[:-3] + "csv"), events(there[:-3] + "csv")
    same, worst = apart(mine, theirs)
    text = f"{same} of {len(mine)} events to the last digit"
    if worst is None:
        return text + ", then another course", False
    if worst > 0:
        text += f", the others within {worst:.0e}"
    if content(here) == content(there):
        return text + ", all samples the same bytes", True
    far = max(abs(x - y) for x, y in zip(samples(here), samples(there)))
    return text + f", samples within {far:.1e}", worst < 1e-12 and far <= 1e-6


def main(folder, wanted):
    bad = []
    for here in sorted(glob.glob(os.path.join(folder, "*-here.wav"))):
        name = os.path.basename(here)[:-9]
        text, is_same = line(here, here.replace("-here", "-there"))
        print(f"{name}: {text}")
        if not is_same and name.rsplit("-", 1)[0] in wanted:
            bad.append(name)
    if bad:
        sys.exit("expected the same: " + ", ".join(bad))


main(sys.argv[1], sys.argv[2:])
