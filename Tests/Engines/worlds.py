# SPDX-License-Identifier: MIT
"""Ten worlds through every engine: how many impacts are felt, when and how hard, against closed forms and against the motion that the engine
itself computed. `worlds.py NAME=COMMAND...`: each command takes the file of a world and prints a trace (Trace.h). Exit 1 if a bound is exceeded.

felt: events, of rows and ragdolls the bodies that have one. onset: ms from the wanted one. level: the impulse by the wanted one."""
import math
import os
import subprocess
import sys
import tempfile
from bisect import bisect_left

G, FLOOR, THRESHOLD = 9.81, 100, 0.15


class Trace:
    def __init__(self, text, rate):
        self.rate, self.motions, self.events = rate, {}, []
        for line in text.splitlines():
            word, *numbers = line.split()
            if word == "m":
                self.motions.setdefault(int(numbers[1]), []).append([float(n) for n in numbers[2:]])
            elif word == "e":
                self.events.append([float(numbers[0]), int(numbers[1]), int(numbers[2]), *(float(n) for n in numbers[3:])])
        self.events.sort()

    def of(self, body, other=None):
        return [e for e in self.events if e[1] == body and (other is None or e[2] == other)]

    def kick(self, body, step):
        """What contacts and joints changed of a body's velocity in a step, m/s."""
        before, after = self.motions[body][step - 1], self.motions[body][step]
        return after[2] - before[2], after[3] - before[3] + G / self.rate

    def upwards(self, masses, at):
        """What the engine itself gave these bodies ({number: kg}) in three steps from then on, N s upwards, without what carries them."""
        start = int(at * self.rate + 0.001) + 1
        return sum(kg * max(0, self.kick(i, s)[1] - G / self.rate) for i, kg in masses.items() for s in range(start, start + 3))

    def first(self, body, is_so):
        """The first step (1 is the first) behind which a motion is so."""
        return next((i for i, motion in enumerate(self.motions[body]) if i > 0 and is_so(motion)), None)


def total(events, start, seconds=0.03):
    return sum(e[3] for e in events if start - 1e-9 <= e[0] <= start + seconds)


def body(kind, number, x, y, width, height, mass, source, angle=0, vx=0, vy=0, spin=0):
    return f"{kind} {number} {x:.9g} {y:.9g} {angle:.9g} {width:.9g} {height:.9g} {mass:.9g} {vx:.9g} {vy:.9g} {spin:.9g} {int(source)}"


def head(seconds, restitution=0, friction=0.6, floor=True):
    return lambda rate: f"world {rate} {restitution} {friction} {seconds}" + ("\nfloor" if floor else "")


class Result:
    """What is felt, what is wanted, and how far they may differ."""
    def __init__(self, felt, wanted, onset_ms=None, level=None, onset_most=None, level_most=None, note=""):
        self.felt, self.wanted, self.onset_ms, self.level, self.note = felt, wanted, onset_ms, level, note
        self.onset_most, self.level_most = onset_most, level_most

    def is_fine(self):
        low, high = self.wanted if isinstance(self.wanted, tuple) else (self.wanted, self.wanted)
        return (low <= self.felt <= high and (self.onset_most is None or (self.onset_ms is not None and abs(self.onset_ms) <= self.onset_most)) and
                (self.level_most is None or (self.level is not None and abs(self.level - 1) <= self.level_most)))


def closest(events, at):
    return min((e[0] for e in events), key=lambda t: abs(t - at), default=None)


# 1. A pole of 2 m topples about its foot: rigid, its head pushes m/3 of its speed.
def pole():
    return [body("box", 1, 0, 1, 0.1, 2, 3, True, vx=0.3, spin=-0.3)], 3, dict(friction=1)


def judge_pole(trace):
    fastest = max(abs(m[4]) for m in trace.motions[1])
    lands = next((i for i in range(1, len(trace.motions[1])) if abs(trace.motions[1][i - 1][4]) > 2 and abs(trace.motions[1][i][4]) < 0.5 * abs(trace.motions[1][i - 1][4])), 0)
    events = [e for e in trace.of(1) if e[4] > 1.5]
    if not events:
        return Result(0, 1)
    step = 1000 / trace.rate
    return Result(len([e for e in events if e[3] > 0.1 * events[0][3]]), (1, 2), 1000 * events[0][0] - (lands - 0.5) * step, total(events, events[0][0]) / (3 / 3 * 2 * fastest), 1.6 * step, 0.2, "m/3 of its head's speed")


# 2. A crate rocks from corner to corner (Housner): each rock keeps 1 - 1.5 sin^2(alpha) of the spin, and pushes m b spin (1 + that).
WIDE, HIGH, LEAN, CRATE = 0.5, 1.0, 0.2, 2.0


def crate():
    y = (math.sin(LEAN) * WIDE + math.cos(LEAN) * HIGH) / 2
    return [body("box", 1, 0, y, WIDE, HIGH, CRATE, True, angle=LEAN)], 3, dict(friction=1)


def rocking():
    """Time and spin at the first rock, of a rigid crate that turns about its corner."""
    alpha, radius = math.atan2(WIDE, HIGH), math.hypot(WIDE, HIGH) / 2
    lean, spin, t, dt = LEAN, 0.0, 0.0, 1e-5
    while lean > 0:
        spin -= dt * G * math.sin(alpha - lean) / (4 / 3 * radius)
        lean += dt * spin
        t += dt
    return t, abs(spin), 1 - 1.5 * math.sin(alpha) ** 2


def judge_crate(trace):
    at, spin, kept = rocking()
    events = [e for e in trace.of(1) if e[0] > 0.15] # before, its corner settles
    if not events:
        return Result(0, (2, 30))
    felt, rigid = total(events, events[0][0]), CRATE * WIDE / 2 * spin * (1 + kept)
    own = trace.upwards({1: CRATE}, events[0][0])
    return Result(len(events), (1, 12), 1000 * (events[0][0] - at), felt / rigid, 2500 / trace.rate, 0.4, f"Housner's rocking block; by the engine's own momentum {felt / own:.2f}")


# 3. Six dominoes: each is struck by the one before it.
def dominoes():
    return [body("box", i + 1, 0.3 * i, 0.3, 0.1, 0.6, 1, i > 0, **(dict(spin=-3, vx=0.9) if i == 0 else {})) for i in range(6)], 3, {}


def judge_dominoes(trace):
    onsets, levels, felt = [], [], 0
    for i in range(2, 7):
        start = trace.first(i, lambda m: abs(m[4]) > 0.3)
        events = trace.of(i, i - 1)
        if start is None or not events:
            continue
        felt += 1
        first = events[0]
        onsets.append(1000 * (first[0] - (start - 0.5) / trace.rate))
        after = max(start, min(start + 2, len(trace.motions[i]) - 1))
        wanted = (0.01 + 0.36) / 3 * abs(trace.motions[i][after][4]) / first[5]
        levels.append(total(events, first[0]) / wanted)
    return Result(felt, (4, 5), max(onsets, key=abs, default=None), sorted(levels)[len(levels) // 2] if levels else None, 1600 / trace.rate, 0.25, "inertia about the foot x spin / height")


# 4. A stack of three lands flat, as one.
def stack():
    return ["falling"] + [body("box", i + 1, 0, 0.75 + 0.5 * i, 0.5, 0.5, 1, i == 0) for i in range(3)], 2, {}


def judge_stack(trace):
    events, speed = [e for e in trace.of(1) if e[0] < 0.4], math.sqrt(G)
    at = speed / G
    if not events:
        return Result(0, 1)
    felt, own = total(events, events[0][0]), trace.upwards({1: 1, 2: 1, 3: 1}, events[0][0])
    return Result(len(events), (1, 2), 1000 * (events[0][0] - at), felt / own, 1000 / trace.rate, 0.4, f"free fall; momentum that the engine stops then, {own / 3 / speed:.2f} of the stack's")


# 5. A ball flies up through a platform, and lands on it.
def platform():
    return [body("box", 2, 0, 1.45, 3, 0.1, 0, False), "falling", body("ball", 1, 0, 0.3, 0.2, 0.2, 1, True, vy=6), "oneway 2"], 2, {}


def judge_platform(trace):
    fall = 6 * 6 / 2 / G + 0.3 - 1.6
    # an engine's continuous collision may hold the ball for a moment below the platform: then it does not rise as high
    step = int(0.75 * trace.rate)
    t = step / trace.rate
    fall -= 0.3 + 6 * t - G * t * t / 2 - trace.motions[1][step][1]
    at, speed = 6 / G + math.sqrt(2 * fall / G), math.sqrt(2 * G * fall)
    events = trace.of(1)
    if not events:
        return Result(0, 1)
    return Result(len(events), (1, 2), 1000 * (events[0][0] - at), total(events, events[0][0]) / speed, 1000 / trace.rate, 0.25, "free fall from the engine's own height")


# 6. A box slides over twenty tiles.
def ghosts():
    return ["tiles -1 9 40", body("box", 1, 0, 0.2, 0.4, 0.4, 1, True, vx=4)], 2, dict(friction=0.1, floor=False)


def judge_ghosts(trace):
    own = len([i for i in range(3, len(trace.motions[1])) if math.hypot(*trace.kick(1, i)) > 2 * THRESHOLD + G / trace.rate])
    return Result(len(trace.of(1)), (0, own), note=f"the engine's own jolts: {own}")


# 7. A ragdoll falls from half a metre: both of its feet land, then the rest.
def ragdoll():
    parts = [("box", 1, 0, 2.1, 0.4, 0.8, 10), ("ball", 2, 0, 2.65, 0.3, 0.3, 2), ("box", 3, -0.15, 1.1, 0.15, 1.2, 4), ("box", 4, 0.15, 1.1, 0.15, 1.2, 4),
             ("box", 5, -0.5, 2.4, 0.6, 0.12, 2), ("box", 6, 0.5, 2.4, 0.6, 0.12, 2)]
    return ["falling"] + [body(*part, True) for part in parts] + ["pin 1 2 0 2.5", "pin 1 3 -0.15 1.7", "pin 1 4 0.15 1.7", "pin 1 5 -0.2 2.4", "pin 1 6 0.2 2.4"], 4, {}


def judge_ragdoll(trace):
    at = math.sqrt(2 * 0.5 / G)
    feet = [e for e in trace.events if e[1] in (3, 4) and e[2] == FLOOR and e[0] < at + 0.1]
    parts = {e[1] for e in trace.events if e[2] == FLOOR}
    if not feet:
        return Result(0, 2)
    masses = {1: 10, 2: 2, 3: 4, 4: 4, 5: 2, 6: 2}
    own = trace.upwards(masses, feet[0][0])
    return Result(len({e[1] for e in feet}), 2, 1000 * (feet[0][0] - at), total(feet, feet[0][0]) / own, 1000 / trace.rate, None, f"free fall; momentum that the engine stops then, {own / 24 / math.sqrt(G):.2f} of the whole; {len(parts)} parts and {len(trace.events)} impacts")


# 8. A ball falls onto a slope of 30 degrees, and rolls.
TILT = math.radians(30)


def slope():
    y = 0.5 + (0.1 + 0.1) / math.cos(TILT) # above its surface
    return [body("box", 2, 0, 0, 8, 0.2, 0, False, angle=-TILT), "falling", body("ball", 1, 0, y, 0.2, 0.2, 1, True)], 1.2, dict(floor=False)


def judge_slope(trace):
    events, speed = trace.of(1), math.sqrt(2 * G * 0.5)
    if not events:
        return Result(0, 1)
    return Result(len(events), (1, 2), 1000 * (events[0][0] - speed / G), events[0][3] / (speed * math.cos(TILT)), 1000 / trace.rate, 0.2, "m v cos 30")


# 9. Newton's cradle: the first ball falls from 0.6 rad, the last one is felt.
def cradle():
    made = [body("ball", i + 1, 0.2 * i, 1, 0.2, 0.2, 1, i == 4) for i in range(1, 5)]
    made.append(body("ball", 1, -math.sin(0.6), 2 - math.cos(0.6), 0.2, 0.2, 1, False, angle=-0.6))
    return made + [f"pin {i + 1} 0 {0.2 * i:.9g} 2" for i in range(5)], 1.0, dict(restitution=1, friction=0, floor=False)


def judge_cradle(trace):
    events = trace.of(5)
    starts = trace.first(5, lambda m: math.hypot(m[2], m[3]) > 0.5)
    if not events or starts is None:
        return Result(0, 1)
    own = max(math.hypot(*m[2:4]) for m in trace.motions[5][starts:starts + 4])
    return Result(len(events), (1, 3), 1000 * (events[0][0] - (starts - 0.5) / trace.rate), events[0][3] / own, 1600 / trace.rate, 0.15, "the last ball's own start and momentum")


# 10. A pile that has come to rest is silent.
def pile():
    walls = [body("box", 50, -1.1, 1, 0.2, 3, 0, False), body("box", 51, 1.1, 1, 0.2, 3, 0, False)]
    return walls + [body("box" if i % 2 else "ball", i + 1, -0.6 + 0.6 * (i % 3) + 0.02 * i, 0.3 + 0.45 * (i // 3), 0.3, 0.3, 1, True) for i in range(12)], 8, {}


def judge_pile(trace):
    speed = lambda number, step: math.hypot(*trace.motions[number][step][2:4], 0.2 * trace.motions[number][step][4])
    fastest = lambda at: max(speed(i, s) for i in trace.motions for s in range(max(0, int(at * trace.rate) - 3), min(len(trace.motions[i]), int(at * trace.rate) + 3)))
    late = [e for e in trace.events if e[0] > 6 and fastest(e[0]) < 2 * THRESHOLD]
    return Result(len(late), 0, note=f"{len(trace.events)} impacts before")


WORLDS = [("pole", pole, judge_pole), ("rocking crate", crate, judge_crate), ("domino row", dominoes, judge_dominoes), ("stack that lands", stack, judge_stack),
          ("one-way platform", platform, judge_platform), ("chain of ghosts", ghosts, judge_ghosts), ("ragdoll", ragdoll, judge_ragdoll),
          ("ball on slope", slope, judge_slope), ("Newton's cradle", cradle, judge_cradle), ("pile at rest", pile, judge_pile)]


def text_of(make, rate):
    """A world as its file has it."""
    lines, seconds, how = make()
    return "\n".join([head(seconds, **how)(rate), *lines]) + "\n"


def by_command(command):
    """An engine that a program is: from a world's text to a trace."""
    def play(text):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "world.txt")
            with open(path, "w") as file:
                file.write(text)
            ran = subprocess.run([*command.split(), path], capture_output=True, text=True, cwd=folder)
        if ran.returncode != 0 or "expected" in ran.stderr or not ran.stdout:
            print(f"{command} {path}: exit code {ran.returncode}: {ran.stderr.strip()[:300]}")
        return ran.stdout
    return play


def trace_of(text, rate):
    return Trace("\n".join(line for line in text.splitlines() if line[:2] in ("m ", "e ")), rate)


def number(value, form):
    return "-" if value is None else form.format(value)


def rates():
    return [int(r) for r in os.environ.get("RATES", "60 240").split()]


def table(engines, known=None):
    """Prints it for `engines`, { label: play }; how many are out of bounds. `known`: why, by (label, world, steps/s)."""
    failed = 0
    print("| world | engine | steps/s | felt | wanted | onset, ms | level | against |\n| --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, make, judge in WORLDS:
        if name not in os.environ.get("WORLDS", name).split(","):
            continue
        for label, play in engines.items():
            for rate in rates():
                r = judge(trace_of(play(text_of(make, rate)), rate))
                wanted = r.wanted if not isinstance(r.wanted, tuple) else f"{r.wanted[0]} to {r.wanted[1]}"
                beyond = "" if r.is_fine() else f"; beyond, as known: {known[label, name, rate]}" if (label, name, rate) in (known or {}) else " FAILED"
                failed += beyond == " FAILED"
                print(f"| {name} | {label} | {rate} | {r.felt} | {wanted} | {number(r.onset_ms, '{:+.2f}')} | {number(r.level, '{:.2f}')} | {r.note}{beyond} |", flush=True)
    print(f"{failed} of {len(WORLDS) * len(rates()) * len(engines)} out of bounds")
    return failed


def main():
    pairs = (engine.split("=", 1) for engine in sys.argv[1:])
    return 1 if table({label: by_command(command) for label, command in pairs}) else 0


if __name__ == "__main__":
    sys.exit(main())
