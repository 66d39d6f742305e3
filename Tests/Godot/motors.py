#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Commands of motors that Godot got, against the model itself (Docs/pads.md): motors.py LOG, of motors.gd.

Needs the Python module of PhysVib. Exit 1 if one differs by more than a step of 0.01, or if the motors stood still."""
import sys
from pathlib import Path

import numpy
import physvib

pads = physvib.Pads(8, field_m=(11.52, 6.48))
hits = frames = moved = 0
worst = 0.0
for line in Path(sys.argv[1]).read_text().splitlines():
    word, *numbers = line.split() or ["", ""]
    if word == "h":
        at, frequency, x, y, amplitude = map(float, numbers)
        event = numpy.zeros(1, physvib.EVENT)
        event["time_ns"], event["frequency_hz"], event["decay_per_s"], event["x_m"], event["y_m"], event["amplitude"] = round(at * 1e9), frequency, 30, x, y, amplitude
        pads.strike(0, event)
        hits += 1
    elif word == "m":
        at, low, high = map(float, numbers)
        model = pads.pull(round(at * 1e9))[0]
        worst = max(worst, abs(model[0] - low), abs(model[1] - high))
        frames += 1
        moved += low > 0 or high > 0
print(f"motors: {hits} hits, {moved} of {frames} frames with a command, at most {worst:.3f} from the model")
sys.exit(0 if worst < 0.011 and moved > 10 else 1)
