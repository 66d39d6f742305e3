# SPDX-License-Identifier: GPL-3.0-or-later
"""Strikes a live device from a busy interpreter, at times of its own and by a world's contacts, and writes what should have been
heard. Usage: library.py EXPECTED.raw SECONDS"""
import sys
import threading

import numpy as np
import physvib

RATE, SECOND = 48000, 1_000_000_000
path, seconds = sys.argv[1], int(sys.argv[2])
FIELD = (1.0, 1.0)


def refused(call, *arguments, **named):
    try:
        call(*arguments, **named)
    except physvib.PhysVibError as error:
        assert str(error), error
        return
    raise AssertionError(f"{call} took {arguments} {named}")


refused(physvib.Live, "JACK:nobody")
refused(physvib.Live, "JACK:system", steps_per_s=5)
live = physvib.Live("JACK:system", field_m=FIELD, level_db=0.0)
refused(physvib.Live, "JACK:system")  # one at a time
assert live.status.is_running and live.status.rate_hz == RATE, live.status
assert live.latency_ns > 0

base = (live.now_ns // SECOND + 2) * SECOND
chance = np.random.default_rng(5)
count = 20 * seconds
hits = physvib.events(np.sort(chance.uniform(0.1, seconds - 1.0, count)), frequency_hz=chance.uniform(60.0, 500.0, count), decay_per_s=chance.uniform(20.0, 80.0, count),
                      amplitude=chance.uniform(0.05, 0.4, count), x_m=chance.uniform(0.0, 1.0, count), y_m=chance.uniform(0.0, 1.0, count))

done = False


def burn():  # what an experiment's own work does to a callback in Python
    while not done:
        sum(range(20_000))


threads = [threading.Thread(target=burn, daemon=True) for _ in range(3)]
for thread in threads:
    thread.start()

def bouncing():  # a bounce every tenth of a second, stepped as fast as it can be, ahead of time
    world = physvib.World(normalisation_s_per_m=0.05, hand_mass_kg=0.0)
    world.set_body(0)
    world.set_body(1, mass_kg=0.2, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
    for step in range(100 * (seconds - 1)):
        with world.step(0.01):
            if step % 10 == 3:
                world.touch(0, 1, x_m=0.3, approach_m_per_s=2.0, restitution=0.5, gap_m=0.0137)
    return world


bounces = bouncing().take(at_once=True)
assert live.send(bouncing(), base, at_once=True) == len(bounces) > 5

# The strikes: each is told 0.2 to 1 s before its time, one by one.
for hit in hits:
    told = hit.copy()
    told["time_ns"] += base
    while live.now_ns < told["time_ns"] - SECOND:
        pass
    live.strike(told.reshape(1))

expected = np.concatenate([hits, bounces])
expected = expected[np.argsort(expected["time_ns"], kind="stable")]
expected["time_ns"] += base  # from session time 0 on: sums are rounded by where they lie in all frames
samples = physvib.render(expected, base / SECOND + seconds, field_m=FIELD, rate_hz=RATE)
np.ascontiguousarray(samples.T).tofile(path)

while live.now_ns < base + seconds * SECOND:
    pass
while live.status.played < len(expected):
    pass
done = True
status = live.status
assert status.late == 0 and status.rejected == 0 and status.played == len(expected), status
print(f"{status.played} strikes, {status.late} late, L {live.latency_ns * 1e-6:.1f} ms")

live.set_gain(1, 0.5)
live.set_mute(2, True)
live.set_layout("ring4", field_m=FIELD)
live.set_level(-6.0)
refused(live.set_gain, 4, 1.0)
refused(live.set_gain, 0, float("nan"))
refused(live.set_level, 1.0)
refused(live.set_layout, physvib.Layout([(0.1, 0.1)] * 5, (1.0, 1.0)))
for odd in (True, "0", "false", "off", None, 0.4, float("nan"), 2 ** 40, [], np.zeros(2)):  # all but off
    live.silence(odd)
    assert live.status.is_silent, odd
    for off in (False, 0, 0.0, np.bool_(False)):
        live.silence(off)
        assert not live.status.is_silent, off
live.silence()
assert live.status.is_silent
live.close()
physvib.Live("JACK:system").close()  # and again
physvib.Live("JACK:system")  # left open: the end of the program closes it
