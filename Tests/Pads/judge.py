#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a controller's motors were told by a live program, against the model.

usage: judge.py PHYSVIB PLUG_IN.so [SECONDS (20)]

1. shake-the-box live on a virtual controller for SECONDS, saved; the session is rendered again to motors.csv, and each command that the
   controller got must be the model's, in its order, as often a second as the pace allows, and at rest at the end.
2. The same while it is pulled out and plugged in by turns every 1.7 s.
3. Two controllers at once.
4. kill -9 while it plays: no command is meant to last longer than 200 ms, and none comes after the kill.
5. SIGTERM and Ctrl-C: the last command is rest."""
import os
import signal
import subprocess
import sys
import tempfile
import time

PHYSVIB, PLUG = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
SECONDS = float(sys.argv[3]) if len(sys.argv) > 3 else 20.0
PROFILE, PACE = "pad-generic", 30


def bound_of(door):
    """In ms, as the table of stops tells it."""
    page = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Docs/silence.md")
    rows = [[cell.strip() for cell in line.split("|")] for line in open(page, encoding="utf-8")]
    return next(float(row[5]) for row in rows if len(row) > 5 and row[1] == door)


def start(folder, log, *options, seconds=SECONDS, pads=("auto@" + PROFILE,), **environment):
    env = dict(os.environ, LD_PRELOAD=PLUG, PHYSVIB_PAD_LOG=log, **{key: str(value) for key, value in environment.items()})
    words = [PHYSVIB, "play", "shake-the-box", "--level", "0", "--seconds", str(seconds), *options]
    for pad in pads:
        words += ["--pad", pad]
    return subprocess.Popen(words, env=env, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def told(log, which=1):
    """(milliseconds, low, high) of one controller."""
    rows = [line.split() for line in open(log)]
    return [(float(r[0]), float(r[2]), float(r[3])) for r in rows if len(r) == 4 and r[1] == str(which)]


def model(folder, session):
    path = os.path.join(folder, "motors.csv")
    subprocess.run([PHYSVIB, "render", session, "--pad", PROFILE, "--out", path], check=True, stdout=subprocess.DEVNULL, cwd=folder)
    rows = [line.strip().split(",") for line in open(path) if line[0].isdigit()]
    return [(1e3 * float(r[0]), float(r[1]), float(r[2])) for r in rows]


def same(a, b):
    return abs(a[1] - b[1]) < 1e-3 and abs(a[2] - b[2]) < 1e-3


def expect(holds, words):
    print(("ok    " if holds else "FAIL  ") + words, flush=True)
    expect.bad += not holds


expect.bad = 0


def pace(rows):
    most = 0
    for i, row in enumerate(rows):
        most = max(most, sum(1 for other in rows[i:i + 200] if other[0] < row[0] + 1000.0))
    return most


def against(rows, wanted, name):
    """Each row is the model's, in order; how many of the model's are missing, and how late the others came."""
    at, missing, lags, strangers = 0, 0, [], 0
    wanted = wanted[1:]

    def is_felt(command):  # what the session has at its very end is not felt any more
        return command[0] < wanted[-1][0] - 200.0

    for row in rows:
        ahead = next((k for k in range(at, min(len(wanted), at + 40)) if same(wanted[k], row)), None)
        if ahead is None:
            strangers += 1
            continue
        missing += sum(is_felt(other) for other in wanted[at:ahead])
        if row[0] > rows[0][0] + 2000.0:  # the device's clock is known then
            lags.append(row[0] - wanted[ahead][0])
        at = ahead + 1
    missing += sum(is_felt(row) for row in wanted[at:])
    base = sorted(lags)[len(lags) // 2] if lags else 0.0
    late = sorted(abs(lag - base) for lag in lags)
    expect(strangers == 0, f"{name}: {len(rows)} commands, {strangers} that are not the model's")
    expect(missing <= len(wanted) // 100, f"{name}: of the model's {len(wanted)}, {missing} were overtaken before they were sent")
    if late:
        print(f"      {name}: against the model's times (and their median), half within {late[len(late) // 2]:.1f} ms, 99 % within {late[int(0.99 * len(late))]:.1f} ms, worst {late[-1]:.1f} ms")


def main():
    with tempfile.TemporaryDirectory() as folder:
        log, session = os.path.join(folder, "1.log"), os.path.join(folder, "s.json")
        player = start(folder, log, "--save", session)
        print(player.communicate()[0].strip())
        expect(player.returncode == 0, "the program ended well")
        rows = told(log)
        against(rows, model(folder, session), "to the command")
        expect(pace(rows) <= PACE + 1, f"at most {pace(rows)} commands in a second, of {PACE}")
        expect(all(v == 0 or v >= 0.3 for r in rows for v in r[1:]), "none below the threshold of 0.3")
        expect(bool(rows) and rows[-1][1:] == (0.0, 0.0), "at rest at the end")

        log = os.path.join(folder, "2.log")
        player = start(folder, log, seconds=min(SECONDS, 20), PHYSVIB_PAD_EVERY=1.7)
        out = player.communicate()[0]
        plugged = sum("plugged in" in line for line in open(log))
        expect(player.returncode in (0, 1), f"pulled out and plugged in {plugged} times: " + out.strip().splitlines()[-1])
        expect(len({int(r[0] // 3400) for r in told(log)}) >= min(SECONDS, 20) / 3.4 - 2, f"it played after each return ({len(told(log))} commands)")

        log = os.path.join(folder, "3.log")
        player = start(folder, log, seconds=6, pads=("virtual 1", "virtual 2"), PHYSVIB_PADS=2)
        player.communicate()
        one, two = told(log, 1), told(log, 2)
        expect(player.returncode == 0 and len(one) > 5 and len(two) > 5, f"two controllers: {len(one)} and {len(two)} commands")
        expect(one[-1][1:] == two[-1][1:] == (0.0, 0.0), "both at rest at the end")

        for number, how in ((4, signal.SIGTERM), (5, signal.SIGINT)):
            log = os.path.join(folder, f"{number}.log")
            player = start(folder, log, seconds=60)
            stopped = stop_while_ringing(player, log, how)
            rows = told(log)
            ms = rows[-1][0] - stopped
            expect(rows[-1][1:] == (0.0, 0.0) and ms <= bound_of("controller: Ctrl-C, `kill`; set to rest"), f"{how.name}: at rest {ms:.0f} ms after it")
        log = os.path.join(folder, "6.log")
        player = start(folder, log, seconds=60)
        stopped = stop_while_ringing(player, log, signal.SIGKILL)
        rows = told(log)
        expect(rows[-1][0] <= stopped + 5, "SIGKILL: nothing was commanded after it; what played is ended by its time-out of 200 ms or by the kernel")
    sys.exit(1 if expect.bad else 0)


def stop_while_ringing(player, log, how):
    for _ in range(20000):
        time.sleep(0.001)
        rows = told(log) if os.path.exists(log) else []
        if len(rows) > 8 and rows[-1][1:] != (0.0, 0.0):
            break
    stopped = 1e3 * time.clock_gettime(time.CLOCK_MONOTONIC)
    player.send_signal(how)
    player.communicate()
    return stopped


main()
