#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Each finger's actuator plays that finger's hits alone: glove.py GLOVE PHYSVIB LIST. GLOVE writes the list of a hand that closes around a ball, PHYSVIB renders
it for the layout glove5. Every channel has to be what a render of that finger's rows gives, in which all others are silent; it begins with its finger's
first touch. LIST is the one that Docs shows: rows have the same fingers, times and strengths. Exit code 1 with what differs."""
import subprocess
import sys
import tempfile
from array import array
from pathlib import Path

FINGERS = ["thumb", "index", "middle", "ring", "little"]  # A to E of glove5
RATE = 48000
MOST = 1e-6  # what a rendered sample may be off
glove, physvib, shown = sys.argv[1:4]
bad = []


def channels_of(path):
    """Samples of a WAV file of 32-bit floats, a list per channel."""
    data = path.read_bytes()
    at, count = 12, 0
    while at < len(data):
        name, size = data[at:at + 4], int.from_bytes(data[at + 4:at + 8], "little")
        if name == b"fmt ":
            count = int.from_bytes(data[at + 10:at + 12], "little")
        if name == b"data":
            samples = array("f", data[at + 8:at + 8 + size])
            return [samples[i::count] for i in range(count)]
        at += 8 + size + size % 2
    sys.exit(f"{path}: expected a chunk of samples")


def render(folder, comment, header, rows):
    """The channels that these rows of the list give."""
    events, out = folder / "rows.csv", folder / "rows.wav"
    events.write_text("\n".join([comment, header, *rows]) + "\n")
    subprocess.run([physvib, "render", "--from-events", events, "--layout", "glove5", "--seconds", "1.6", "--rate", str(RATE), "--limiter", "off", "--out", out],
                   check=True, stdout=subprocess.DEVNULL)
    return channels_of(out)


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    subprocess.run([glove, "events.csv"], check=True, cwd=folder, stdout=subprocess.DEVNULL)
    comment, header, *rows = (folder / "events.csv").read_text().splitlines()
    part, time = header.split(",").index("part"), header.split(",").index("time_s")
    whole = render(folder, comment, header, rows)
    for j, finger in enumerate(FINGERS):
        own = [row for row in rows if row.split(",")[part] == finger]
        if not own:
            bad.append(f"{finger}: expected a hit")
            continue
        alone = render(folder, comment, header, own)
        for k, other in enumerate(FINGERS):
            if k != j and any(alone[k]):
                bad.append(f"{finger}: is felt by the {other} finger's actuator")
        if max(abs(a - b) for a, b in zip(alone[j], whole[j])) > MOST:
            bad.append(f"{finger}: its actuator plays other than its own hits")
        first = float(own[0].split(",")[time]) * RATE
        begins = next((n for n, sample in enumerate(whole[j]) if sample), len(whole[j]))
        if not 0 <= begins - first < 2:
            bad.append(f"{finger}: begins at frame {begins}, touches at frame {first:.1f}")
    kept = [row.split(",") for row in Path(shown).read_text().splitlines()[2:]]
    now = [row.split(",") for row in rows]
    strength = header.split(",").index("amplitude")
    if len(kept) != len(now) or any(a[part] != b[part] or abs(float(a[time]) - float(b[time])) > 1e-4 or abs(float(a[strength]) - float(b[strength])) > 0.01
                                    for a, b in zip(kept, now)):
        bad.append(f"{shown}: the hand feels something else now: write it anew by physvib-glove-mujoco, then Docs/pictures.sh")
if bad:
    sys.exit("\n".join(bad))
print(f"{len(rows)} hits, each by its finger's actuator alone")
