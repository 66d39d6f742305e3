#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws Docs/lasting-contacts.svg: our rolling and sliding beside the control models of the Sound Design Toolkit, at the same speeds and
loads, through the same resonator; and prints the slopes.

usage: lasting.py PHYSVIB Docs/lasting-contacts.svg

What is beside ours is the toolkit's model, stated again from its description (Rath and Fontana 2003; Baldan, Delle Monache, Rocchesso 2017),
not its program: a trace follows noise upwards at once and falls by 2 grain |v| a sample; where it rises, a bump of rise / sqrt(fall) is
felt, times force v^2 when scraping, times depth m v^2 / 2 when rolling, then only after a flight. The toolkit's nonlinear contact, which rolling
passes there, is left out: both drive one mode of 349 Hz and 107 /s. Needs Debian's python3-numpy."""
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy as np

RATE, SECONDS, SKIP = 48000, 3.0, 0.5
HZ, TAU = 349.0, 107.0
GRAIN, SPEEDS, LOADS = 0.002, (0.05, 0.1, 0.2, 0.5, 1.0, 2.0), (0.1, 0.3, 1.0, 3.0, 10.0)  # m, m/s, of the usual
USUAL = 0.5  # m/s
GRAVITY, RADIUS, DENSITY = 10.0, 0.2, 10.0


def ours(physvib, rolls, speed, load):
    """What `render` makes of a ball on rough ground: it rolls, or it slides without friction."""
    friction = 1.0 if rolls else 0.0
    scene = {"physvib_scene": 1, "name": "one", "description": "a ball", "field_m": [20, 4], "gravity_m_per_s2": [0, -GRAVITY], "normalisation": {"a_star_s_per_m": 1, "hand_mass_kg": 0},
             "materials": [{"name": "ground", "density_kg_per_m2": 10, "friction": friction, "restitution": 0, "frequency_hz": HZ, "decay_per_s": TAU, "grain_m": GRAIN},
                           {"name": "ball", "density_kg_per_m2": DENSITY * load, "friction": friction, "restitution": 0}],
             "bodies": [{"name": "floor", "type": "static", "position_m": [10, 1], "mass_kg": 20, "fixtures": [{"shape": "box", "size_m": [20, 0.2], "material": "ground", "camera": True}]},
                        {"name": "ball", "position_m": [1, 1.1 + RADIUS], "velocity_m_per_s": [speed, 0], "spin_rad_per_s": -speed / RADIUS if rolls else 0,
                         "fixtures": [{"shape": "circle", "radius_m": RADIUS, "material": "ball"}]}]}
    with tempfile.TemporaryDirectory() as folder:
        path, wav = os.path.join(folder, "one.json"), os.path.join(folder, "one.wav")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        subprocess.run([physvib, "render", path, "--layout", "phone1", "--limiter", "off", "--seconds", str(SECONDS), "--out", wav], check=True, capture_output=True)
        with open(wav, "rb") as file:
            data = file.read()
    return np.frombuffer(data[data.index(b"data") + 8:], dtype="<f4").astype(float)


def theirs(rolls, speed, load, grain):
    """The toolkit's control models: force, sample by sample. Also how many bumps there are."""
    noise = np.random.default_rng(1).uniform(-1.0, 1.0, int(SECONDS * RATE))
    fall = min(2.0, 2.0 * grain * abs(speed))
    mass = load * DENSITY * math.pi * RADIUS ** 2
    strength = 0.5 * mass * speed ** 2 if rolls else mass * GRAVITY * speed ** 2
    weight = mass * GRAVITY
    force, trace, flight, bumps = np.zeros(len(noise)), 0.0, 0.0, 0
    for n, height in enumerate(noise):
        now = max(trace - fall, height)
        if now > trace and flight <= 0.0:
            force[n] = strength * (now - trace) / math.sqrt(fall)
            bumps += 1
            if rolls:
                flight = 2.0 * force[n]
        trace = now
        flight = max(0.0, flight - weight)
    return force, bumps / SECONDS


def rung(force):
    """One mode, struck by a force."""
    turn, shrink = 2.0 * math.pi * HZ / RATE, math.exp(-TAU / RATE)
    n = 1 << (2 * len(force) - 1).bit_length()
    t = np.arange(len(force))
    answer = shrink ** t * np.sin(turn * t)
    return np.fft.irfft(np.fft.rfft(force, n) * np.fft.rfft(answer, n), n)[:len(force)]


def steady(x):
    x = x[int(SKIP * RATE):]
    return x - x.mean()


def level(x):
    return 10.0 * math.log10(float(np.mean(steady(x) ** 2)) + 1e-30)


def spectrum(x):
    """Third octaves from 20 to 2000 Hz, dB of the whole."""
    x = steady(x)
    power = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    hz = np.fft.rfftfreq(len(x), 1.0 / RATE)
    centres = [20.0 * 2.0 ** (k / 3.0) for k in range(21)]
    share = [float(power[(hz >= c * 2 ** (-1 / 6)) & (hz < c * 2 ** (1 / 6))].sum() / power.sum()) for c in centres]
    return [(c, 10.0 * math.log10(s + 1e-9)) for c, s in zip(centres, share)]


def grain_for(speed, per_second):
    """The toolkit's grain has no unit: the one that gives as many bumps as there are grains of ours."""
    low, high = 1e-6, 1.0
    for _ in range(18):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if theirs(False, speed, 1.0, middle)[1] < per_second else (low, middle)
    return middle


def slope(points):
    """dB for ten times as much."""
    x, y = np.log10([p[0] for p in points]), [p[1] for p in points]
    return float(np.polyfit(x, y, 1)[0])


def panel(at, title, unit, curves, x_range, y_range, ticks):
    left, top = at
    width, height = 330.0, 190.0
    px = lambda x: left + width * math.log(x / x_range[0]) / math.log(x_range[1] / x_range[0])
    py = lambda y: top + height * (y_range[1] - max(min(y, y_range[1]), y_range[0])) / (y_range[1] - y_range[0])
    yield f'<text x="{left}" y="{top - 8}" font-weight="bold">{title}</text>'
    yield f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>'
    for y in range(int(y_range[0]), int(y_range[1]) + 1, 20):
        yield f'<path d="M{left} {py(y):.1f}h{width}" stroke="#ddd"/><text x="{left - 5}" y="{py(y) + 4:.1f}" text-anchor="end">{y}</text>'
    for x in ticks:
        yield f'<path d="M{px(x):.1f} {top}v{height}" stroke="#ddd"/><text x="{px(x):.1f}" y="{top + height + 14}" text-anchor="middle">{x:g}</text>'
    yield f'<text x="{left + width}" y="{top + height + 28}" text-anchor="end">{unit}</text>'
    for points, colour, dash in curves:
        path = "M" + "L".join(f"{px(x):.1f} {py(y):.1f}" for x, y in points)
        yield f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/>'


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    physvib, out = sys.argv[1:]
    grain = grain_for(USUAL, USUAL / GRAIN)
    kinds = {("ours", rolls): (lambda s, l, r=rolls: ours(physvib, r, s, l)) for rolls in (False, True)}
    kinds |= {("SDT's model", rolls): (lambda s, l, r=rolls: rung(theirs(r, s, l, grain)[0])) for rolls in (False, True)}
    style = {("ours", False): ("#0b5394", ""), ("ours", True): ("#0b5394", "6 4"), ("SDT's model", False): ("#c55a11", ""), ("SDT's model", True): ("#c55a11", "6 4")}
    spectra, speeds, loads = {}, {}, {}
    for kind, play in kinds.items():
        usual = play(USUAL, 1.0)
        spectra[kind] = spectrum(usual)
        speeds[kind] = [(s, level(play(s, 1.0)) - level(usual)) for s in SPEEDS]
        loads[kind] = [(l, level(play(USUAL, l)) - level(usual)) for l in LOADS]
        print(f"{kind[0]}, {'rolling' if kind[1] else 'sliding'}: {slope(speeds[kind]):.1f} dB for ten times the speed, {slope(loads[kind]):.1f} dB for ten times the load")
    svg = ['<svg xmlns="http://www.w3.org/2000/svg" width="840" height="560" font-family="sans-serif" font-size="11"><rect width="840" height="560" fill="white"/>']
    curves = lambda table, wanted=(False, True): [(table[k], *style[k]) for k in kinds if k[1] in wanted]
    svg += panel((60, 40), "Sliding at 0.5 m/s: third octaves, dB of the whole", "Hz", curves(spectra, (False,)), (20, 2000), (-60, 0), (20, 50, 100, 200, 500, 1000, 2000))
    svg += panel((480, 40), "Rolling at 0.5 m/s", "Hz", curves(spectra, (True,)), (20, 2000), (-60, 0), (20, 50, 100, 200, 500, 1000, 2000))
    svg += panel((60, 310), "Level over speed, dB of that at 0.5 m/s", "m/s", curves(speeds), (0.05, 2), (-60, 40), SPEEDS)
    svg += panel((480, 310), "Level over load, dB of the usual", "times the usual load", curves(loads), (0.1, 10), (-40, 40), LOADS)
    for n, (kind, (colour, dash)) in enumerate(style.items()):
        svg.append(f'<path d="M{60 + 190 * n} 548h30" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/><text x="{96 + 190 * n}" y="552">{kind[0]}, {"rolling" if kind[1] else "sliding"}</text>')
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(svg) + "\n</svg>\n")


main()
