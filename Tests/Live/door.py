# SPDX-License-Identifier: GPL-3.0-or-later
"""door.c once more, by Python's default call: door.py LIBRARY_OF_ONSETS SECONDS STEPS_PER_S."""
import ctypes
import sys
import time

import physvib

onsets, seconds, rate = ctypes.CDLL(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
onsets.door_onset.restype = ctypes.c_int64
live = physvib.Live("JACK:system", field_m=(1.0, 1.0))
assert onsets.door_listen(live._handle) == 0
world = physvib.World()
world.set_body(0)
world.set_body(1, is_camera=True, mass_kg=1.0, frequency_hz=1000.0, decay_per_s=200.0)
start, due, k = 0, time.monotonic(), 0
for step in range(seconds * rate):
    fraction = step * 37 % 100 / 100
    due += 1.0 / rate
    time.sleep(max(0.0, due - time.monotonic()))
    with world.step(1.0 / rate, 9.81):
        if step > rate // 2 and step % (rate * 15 // 100) == 0:
            print(live.now_ns + round(fraction * 1e9 / rate))
            world.touch(0, 1, x_m=0.5, y_m=0.5, approach_m_per_s=3.0, fraction=fraction)
    start = live.follow(world, start)
while onset := onsets.door_onset(k):
    print("-", onset)
    k += 1
status = live.status
print(f"L {live.latency_ns * 1e-6:.1f} ms, {status.played} played, {status.late} late, {status.xruns} xruns", file=sys.stderr)
onsets.door_leave()
live.close()
