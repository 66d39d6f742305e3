#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long this machine did not run what was due: away.py, until it is terminated, then one line.

A thread that sleeps for 1 ms at the highest priority that is allowed wakes late only when the machine itself was elsewhere: its host took the processor, or
the priority was not allowed and other programs had it. Tests that play in real time are judged by this: what was late while nothing was away is ours.
"""
import os, signal, time

SLEEP_S, AWAY_S = 0.001, 0.005
try:
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(80))
    kind = "realtime"
except (OSError, AttributeError):
    kind = "ordinary"
ends = []
signal.signal(signal.SIGTERM, lambda *_: ends.append(True))
signal.signal(signal.SIGINT, lambda *_: ends.append(True))
gaps = []
before = time.monotonic()
parent = os.getppid()
while not ends and os.getppid() == parent:
    time.sleep(SLEEP_S)
    now = time.monotonic()
    if now - before - SLEEP_S >= AWAY_S:
        gaps.append(now - before - SLEEP_S)
    before = now
print(f"away {len(gaps)} times for {1e3 * AWAY_S:.0f} ms or more, {1e3 * max(gaps, default=0.0):.0f} ms at most, {1e3 * sum(gaps):.0f} ms in all ({kind} priority)", flush=True)
