#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""2,000 balls land in one step, in each door: how many are felt, which, what is told of the others, and what it costs. `render` and `play` on no
device, Python's world and its default call on no device. C: StormTest.cpp; JavaScript: storm.mjs. Usage: storm.py PHYSVIB, with PHYSVIB_LIBRARY,
PHYSVIB_LIVE_LIBRARY and PYTHONPATH."""
import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import physvib

program, count, kept = sys.argv[1], 2000, 1024
folder = Path(tempfile.mkdtemp())


def scene():
    ball = {"shape": "circle", "radius_m": 0.02, "material": "glass"}
    return {"physvib_scene": 1, "name": "storm", "description": "", "field_m": [100, 4], "gravity_m_per_s2": [0, -9.8],
            "materials": [{"name": "glass", "density_kg_per_m2": 250, "friction": 0, "restitution": 0, "frequency_hz": 480, "decay_per_s": 60}],
            "bodies": [{"name": "floor", "type": "static", "position_m": [50, 1], "mass_kg": 80,
                        "fixtures": [{"shape": "box", "size_m": [99, 0.2], "material": "glass", "camera": True}]}]
            + [{"name": f"b{i}", "position_m": [1.0 + 0.049 * i, 1.62], "mass_kg": 0.1 + 0.001 * i, "fixtures": [ball]} for i in range(count)]}


def ran(*words):
    start = time.perf_counter()
    done = subprocess.run([program, *words], capture_output=True, text=True, check=True)
    return done.stdout + done.stderr, time.perf_counter() - start


(folder / "storm.json").write_text(json.dumps(scene()))
text, seconds = ran("render", str(folder / "storm.json"), "--seconds", "1", "--events", str(folder / "hits.csv"), "--out", str(folder / "felt.wav"), "--explain")
rows = [line.split(",") for line in (folder / "hits.csv").read_text().splitlines() if line and not line.startswith("#")]
column = rows[0].index("impulse_ns")
impulses = sorted(float(row[column]) for row in rows[1:])
print(f"render: {len(impulses)} of {count} felt, the weakest {impulses[0]:.3f} of {impulses[-1]:.3f} N s, {seconds:.1f} s for 1 s:", " / ".join(re.findall(r"^dropped: .*", text, re.M)))
assert len(impulses) == kept and impulses[0] > impulses[-1] * 0.4

text, seconds = ran("play", str(folder / "storm.json"), "--device", "None:no device", "--seconds", "2")
print("play:", " / ".join(line.strip() for line in text.splitlines() if "events left" in line))

world = physvib.World()
world.set_body(0)
for i in range(1, count + 1):
    world.set_body(i, mass_kg=0.1, is_camera=True, frequency_hz=60.0 + 0.2 * i, decay_per_s=20.0)
with physvib.Live("None:no device", field_m=(1.0, 1.0)) as live:
    time.sleep(0.5)
    start = 0
    for step in range(20):
        begin = time.perf_counter()
        with world.step(0.01, 9.81):
            for i in range(1, count + 1) if step == 10 else ():
                world.touch(i, 0, x_m=i / count, y_m=0.5, normal_y=-1.0, approach_m_per_s=0.1 + 0.001 * i)
        start = live.follow(world, start)
        if step == 10:
            cost = time.perf_counter() - begin
        time.sleep(max(0.0, 0.01 - (time.perf_counter() - begin)))
    time.sleep(1.0)
    status, counts = live.status, world.counts
    print(f"Python, on a device: {status.played} played, {status.late} late, {status.rejected} rejected, {counts.dropped} dropped by the world; {1e3 * cost:.0f} ms for step and call; load {status.worst_load:.2f}")
    assert status.played == kept and counts.dropped == count - kept and status.rejected == 0
