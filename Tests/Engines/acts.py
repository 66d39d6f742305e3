#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Ten acts at 240 steps a second through every engine: `acts.py NAME=COMMAND...`, commands as of worlds.py. Each has a closed form, of rigid bodies.
Prints the table of Docs/engines.md. A cell has ms and % of strength from the closed form; where one of them is beyond 1 ms or 5 %, behind "own" the
same from the motion that the engine itself computed. Exit 1 if both are beyond, or if impacts are felt that are none. Nobody is excused: SPREADS has another
own motion."""
import math
import sys
from worlds import FLOOR, G, body, by_command, head, total, trace_of

RATE, FALL, MOST_MS, MOST_PART = 240, 0.5, 1.0, 0.05
WALL = 2  # its number


def wall(x):
    """A wall whose left face is at x."""
    return body("box", WALL, x + 0.5, 1, 1, 4, 0, False)


def reach(angle, width, height):
    """How far the lowest corner of a box lies below its centre."""
    return (abs(math.sin(angle)) * width + abs(math.cos(angle)) * height) / 2


class Motion:
    """The engine's own motion of a body: x, y, vx, vy, spin, angle behind each step."""
    def __init__(self, trace, number):
        self.states = trace.motions[number]

    def gaps(self, gap):
        return [gap(state[0], state[1], state[5]) for state in self.states]

    def closes(self, gap):
        """When `gap`(x, y, angle) closes, s: between two steps, or as it would if the body went on as before."""
        gaps = self.gaps(gap)
        for i in range(2, len(gaps) - 1):
            speed = 2 * (gaps[i - 1] - gaps[i]) - (gaps[i - 2] - gaps[i - 1])  # of the next step
            if gaps[i] > 0 and (gaps[i + 1] <= 0 or (speed > 0 and gaps[i] <= speed)):
                return (i + gaps[i] / (speed if speed > 0 else gaps[i] - gaps[i + 1])) / RATE
        return None

    def gained(self, kg, at, along, steps=6):
        """What contacts gave it in these steps from just before that time, N s along a direction."""
        start = max(1, int(at * RATE))
        end = min(len(self.states) - 1, start + steps)
        x, y = (self.states[end][i] - self.states[start - 1][i] for i in (2, 3))
        return kg * (x * along[0] + (y + G * (end - start + 1) / RATE) * along[1])

    def fastest(self, at):
        """Its largest spin in the steps before that time."""
        return max(abs(state[4]) for state in self.states[max(0, int(at * RATE) - 4):int(at * RATE) + 2])


class Hit:
    """When and how hard by the closed form, and by the engine's own motion."""
    def __init__(self, at, impulse, own_at, own_impulse, other=FLOOR, seconds=0.015):
        self.at, self.impulse, self.own_at, self.own_impulse, self.other, self.seconds = at, impulse, own_at, own_impulse, other, seconds

    def near(self, events):
        return [e for e in events if (self.other is None or e[2] == self.other) and abs(e[0] - self.at) < 0.05]


def free_fall(kg, gap, motion, share=1.0):
    """Of a fall from FALL whose contact takes this share of the momentum; against the engine's own at its own speed."""
    at, speed = math.sqrt(2 * FALL / G), math.sqrt(2 * G * FALL)
    own = motion.closes(gap) or at
    return Hit(at, share * kg * speed, own, motion.gained(kg, own, (0, 1), 3))


# 1. A box falls flat.
def flat():
    return ["falling", body("box", 1, 0, 0.1 + FALL, 0.2, 0.2, 1, True)], 1, dict(friction=0.5)


def judge_flat(trace):
    return [free_fall(1, lambda x, y, angle: y - 0.1, Motion(trace, 1))]


# 2. A box falls on a corner, without friction: 1 / (1 / m + lever^2 / inertia) of its speed.
TURN = 0.4


def corner():
    return ["falling", body("box", 1, 0, reach(TURN, 0.2, 0.2) + FALL, 0.2, 0.2, 1, True, angle=TURN)], 0.34, dict(friction=0)


def judge_corner(trace):
    lever = 0.1 * (math.cos(TURN) - math.sin(TURN))
    return [free_fall(1, lambda x, y, angle: y - reach(angle, 0.2, 0.2), Motion(trace, 1), 1 / (1 + lever * lever / (0.08 / 12)))]


# 3. A pole that leans falls about its foot, which holds: its head pushes a third of the mass.
LONG, THIN, LEAN, POLE_KG = 2.0, 0.1, 1.1, 3.0
POLE_INERTIA = POLE_KG * (LONG ** 2 + THIN ** 2) / 3


def topple():
    x, y = (LONG * math.sin(LEAN) - THIN * math.cos(LEAN)) / 2, (LONG * math.cos(LEAN) + THIN * math.sin(LEAN)) / 2
    turn = pulled(LEAN) / POLE_INERTIA
    return [f"starting {turn * y:.9g} {-turn * x:.9g} {-turn:.9g}", body("box", 1, x, y, THIN, LONG, POLE_KG, True, angle=-LEAN)], 1, dict(friction=3)


def pulled(lean):
    """Torque of gravity about the foot."""
    return POLE_KG * G * (LONG * math.sin(lean) - THIN * math.cos(lean)) / 2


def turning(lean, inertia, pull):
    """Time and spin with which `lean` comes to a right angle, from rest: inertia x spin' = pull(lean)."""
    spin = t = 0.0
    dt = 1e-5
    while lean < math.pi / 2:
        spin += dt * pull(lean) / inertia
        lean += dt * spin
        t += dt
    return t, spin


def judge_topple(trace):
    at, spin = turning(LEAN, POLE_INERTIA, pulled)
    motion = Motion(trace, 1)
    own = motion.closes(lambda x, y, angle: y + LONG / 2 * math.cos(angle) - THIN / 2 * abs(math.sin(angle))) or at
    return [Hit(at, POLE_KG / 3 * LONG * spin, own, POLE_KG / 3 * LONG * motion.fastest(own))]


# 4. A ball rolls, and comes to a wall.
def roll():
    return [wall(1.1), body("ball", 1, 0, 0.1, 0.2, 0.2, 1, True, vx=2, spin=-20)], 0.8, dict(friction=0.3)


def to_wall(trace, kg, at, speed, x=1.0):
    motion = Motion(trace, 1)
    own = motion.closes(lambda now, y, angle: x - now) or at
    return Hit(at, kg * speed, own, motion.gained(kg, own, (-1, 0), 3), WALL)


def judge_roll(trace):
    return [to_wall(trace, 1, 0.5, 2)]


# 5. A box slides, slows down, and comes to a wall.
def slide():
    return [wall(1.1), body("box", 1, 0, 0.1, 0.2, 0.2, 1, True, vx=3)], 0.8, dict(friction=0.2)


def judge_slide(trace):
    speed = math.sqrt(9 - 2 * 0.2 * G)
    return [to_wall(trace, 1, (3 - speed) / (0.2 * G), speed)]


# 6. A stack that is made touching, at rest.
def stack():
    return [body("box", i + 1, 0, 0.1 + 0.2 * i, 0.2, 0.2, 1, True) for i in range(3)], 2, dict(friction=0.5)


# 7. A ball on a string of 1 m comes to a wall at its lowest point.
AWAY, STRING_INERTIA = 0.6, 1 + 0.5 * 0.1 * 0.1


def pendulum():
    ball = body("ball", 1, -math.sin(AWAY), 2 - math.cos(AWAY), 0.2, 0.2, 1, True, angle=-AWAY)
    turn = G * math.sin(AWAY) / STRING_INERTIA
    start = f"starting {turn * math.cos(AWAY):.9g} {-turn * math.sin(AWAY):.9g} {turn:.9g}"
    return [wall(0.1), start, ball, "pin 1 0 0 2"], 0.8, dict(friction=0, floor=False)


def judge_pendulum(trace):
    at, spin = turning(math.pi / 2 - AWAY, STRING_INERTIA, lambda lean: G * math.cos(lean))
    motion = Motion(trace, 1)
    own = motion.closes(lambda x, y, angle: -x) or at
    return [Hit(at, STRING_INERTIA * spin, own, motion.gained(STRING_INERTIA, own, (-1, 0), 3), WALL)]


# 8. A bullet of 40 m/s.
SHOT, AHEAD = 40.0, 40 / RATE * 3.37


def bullet():
    return [wall(0), body("ball", 1, -0.1 - AHEAD, 1, 0.2, 0.2, 1, True, vx=SHOT)], 0.1, dict(friction=0, floor=False)


def judge_bullet(trace):
    return [to_wall(trace, 1, AHEAD / SHOT, SHOT, -0.1)]


# 9. A stick falls on one end, and then on the other, without friction.
STICK, SLANT = 0.05, 0.2


def stick():
    return ["falling", body("box", 1, 0, reach(SLANT, 1, STICK) + FALL, 1, STICK, 1, True, angle=SLANT)], 0.6, dict(friction=0)


def judge_stick(trace):
    motion, inertia = Motion(trace, 1), (1 + STICK * STICK) / 12
    arm = lambda angle: (math.cos(angle) - STICK * math.sin(angle)) / 2  # to the end that lies on the floor, along it
    rise = lambda angle: -(math.sin(angle) + STICK * math.cos(angle)) / 2  # change of that by angle
    first = free_fall(1, lambda x, y, angle: y - reach(angle, 1, STICK), motion, 1 / (1 + arm(SLANT) ** 2 / inertia))
    spin, angle, t, dt = -first.impulse * arm(SLANT) / inertia, SLANT, first.at, 1e-5
    while angle > 0:  # its end stays on the floor: y = reach(angle)
        spin -= dt * arm(angle) * (G + rise(angle) * spin * spin) / (inertia + arm(angle) ** 2)
        angle += dt * spin
        t += dt
    other = lambda x, y, angle: y + (math.sin(angle) - STICK * math.cos(angle)) / 2
    own = motion.closes(other) or t
    first.own_impulse = motion.fastest(t) * inertia / arm(SLANT)  # of one push at that end
    return [first, Hit(t, abs(spin) / 3, own, motion.fastest(own) / 3)]


# 10. A ball falls into the notch of a heap of nine.
HEAPED = 10


def heap():
    rows = [(row, i) for row, many in enumerate((4, 3, 2)) for i in range(many)]
    up = 0.1 * math.sqrt(3)
    made = [body("ball", n + 11, 0.1 * row + 0.2 * i, 0.1 + up * row, 0.2, 0.2, 1, False) for n, (row, i) in enumerate(rows)]
    walls = [body("box", 50, -0.6, 1, 1, 4, 0, False), body("box", 51, 1.2, 1, 1, 4, 0, False)]
    return walls + made + ["falling", body("ball", HEAPED, 0.3, 0.1 + 3 * up + FALL, 0.2, 0.2, 1, True)], 0.6, dict(friction=0)


def judge_heap(trace):
    motion, steep = Motion(trace, HEAPED), math.cos(math.radians(30))
    at, speed = math.sqrt(2 * FALL / G), math.sqrt(2 * G * FALL)
    tops = [trace.motions[n] for n in (18, 19)]
    apart = [min(math.hypot(own[0] - top[i][0], own[1] - top[i][1]) for top in tops) - 0.2 for i, own in enumerate(motion.states)]
    gaps = iter(apart)
    own = motion.closes(lambda x, y, angle: next(gaps)) or at
    hit = Hit(at, speed / steep, own, motion.gained(1, own, (0, 1)) / steep, None)
    before = max(-motion.states[i][3] for i in range(int(own * RATE) + 1))
    hit.alone = 2 * before * steep / 2  # each of the two that are met has its mass, and nothing behind it yet
    return [hit]


# Name, act, what judges it, and the body that feels (None: all).
ACTS = [("flat fall", flat, judge_flat, 1), ("corner fall", corner, judge_corner, 1), ("topple", topple, judge_topple, 1), ("roll", roll, judge_roll, 1),
        ("slide", slide, judge_slide, 1), ("stack at rest", stack, lambda trace: [], None), ("pendulum", pendulum, judge_pendulum, 1),
        ("bullet", bullet, judge_bullet, 1), ("stick", stick, judge_stick, 1), ("heap", heap, judge_heap, HEAPED)]

# The heap pushes back over several steps in these, and an impact is that of its first: the two balls that are met, at the speed of the engine's own motion.
SPREADS = ("Box2D 3", "MuJoCo")


def worst(hits, found, at, impulse):
    """The largest deviations of the hits: ms and part of the strength."""
    ms = [1000 * (events[0][0] - at(hit)) for hit, events in zip(hits, found)]
    parts = [total(events, events[0][0], hit.seconds) / impulse(hit) - 1 for hit, events in zip(hits, found)]
    return max(ms, key=abs), max(parts, key=abs)


def cell(hits, events, leaps):
    """What is felt as text, and whether onset, strength and the rest are within bounds. `leaps`: whether the engine's own body had left the floor."""
    found, left = [], list(events)
    for hit in hits:
        near = hit.near(left)
        if not near:
            return "not felt", (False, False, False)
        found.append([e for e in near if e[0] <= near[0][0] + hit.seconds])
        left = [e for e in left if e not in found[-1]]
    none = [e for e in left if not hits or (e[0] < hits[0].at - 0.05 and e[3] > 0.1 * hits[0].impulse)]
    hops = [e for e in none if leaps(e[0])]
    extra = (f"; {len(hops)} hops of its own" if hops else "") + (f"; {len(none) - len(hops)} that are none" if len(none) > len(hops) else "")
    if not hits:
        return "none" + extra, (True, True, len(none) == len(hops))
    text, own, fine = [], [], []
    against = zip(worst(hits, found, lambda h: h.at, lambda h: h.impulse), worst(hits, found, lambda h: h.own_at, lambda h: h.own_impulse),
                  (MOST_MS, MOST_PART), ("{:+.2f}", "{:+.1f}"), (1, 100), ("ms", "%"))
    for off, of_own, most, form, times, unit in against:
        text.append(form.format(times * off))
        fine.append(min(abs(off), abs(of_own)) <= most)
        own += [] if abs(off) <= most else [form.format(times * of_own) + " " + unit]
    return ", ".join(text) + (f" (own {', '.join(own)})" if own else "") + extra, (*fine, len(none) == len(hops))


def has_left_the_floor(trace):
    """Of the box that slides: whether it was half a millimetre above the floor in the ten steps before a time."""
    return lambda at: max(state[1] for state in trace.motions[1][max(0, int(at * RATE) - 10):int(at * RATE) + 1]) > 0.1005


def text_of(make):
    """An act as the file of a world."""
    lines, seconds, how = make()
    return "\n".join([head(seconds, **how)(RATE), *lines]) + "\n"


def of_its_own(hits, label, spreads):
    """The hits as an engine's own motion has them that spreads what a heap pushes."""
    for hit in hits:
        if label.startswith(spreads) and hasattr(hit, "alone"):
            hit.own_impulse = hit.alone
    return hits


def table(engines, spreads=SPREADS, known=()):
    """Prints it for `engines`, { label: play }; how many cells are out of bounds, beside those `known`: pairs of label and act."""
    failed = 0
    print("| act: ms, % | " + " | ".join(engines) + " |\n|" + " --- |" * (len(engines) + 1))
    for name, make, judge, source in ACTS:
        row = []
        for label, play in engines.items():
            trace = trace_of(play(text_of(make)), RATE)
            shown, (onset, strength, rest) = "no trace", (False, False, False)
            if trace.motions:
                leaps = has_left_the_floor(trace) if make is slide else lambda at: False
                shown, (onset, strength, rest) = cell(of_its_own(judge(trace), label, spreads), trace.of(source) if source else trace.events, leaps)
            is_fine = onset and rest and strength
            beyond = "" if is_fine else "; beyond, as known" if (label, name) in known else " FAILED"
            row.append(shown + beyond)
            failed += beyond == " FAILED"
        print(f"| {name} | " + " | ".join(row) + " |", flush=True)
    print(f"{failed} of {len(ACTS) * len(engines)} out of bounds", file=sys.stderr)
    return failed


def main():
    pairs = (engine.split("=", 1) for engine in sys.argv[1:])
    return 1 if table({label: by_command(command) for label, command in pairs}) else 0


if __name__ == "__main__":
    sys.exit(main())
