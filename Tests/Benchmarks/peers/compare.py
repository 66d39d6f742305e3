#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same decaying sinusoids through PhysVib and through what else one could take: speed by turns, error against the closed form.

usage: compare.py BUILD_FOLDER [VOICES]
Each program renders a short and a long piece; the difference of their processor times is the time for the samples, so start-up
does not count. Ours runs before each peer, and the ratio is taken pair by pair."""
import array
import math
import os
import random
import statistics
import subprocess
import sys

import formats

RATE, CHANNELS, SHORT, ROUNDS = formats.RATE, 4, 3, 5


def make_voices(count):
    chance = random.Random(1)
    voices = []
    for _ in range(count):
        gains = [chance.random() for _ in range(CHANNELS)]
        scale = 1 / math.sqrt(sum(g * g for g in gains))
        voices.append((20 * 50 ** chance.random(), chance.uniform(0.005, 0.02), chance.uniform(0.2, 0.9) / count, [g * scale for g in gains]))
    return voices


def seconds_of(command):
    child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise OSError(f"{command[0]} ended with {child.returncode}")
    return usage.ru_utime + usage.ru_stime


def error_of(path, voices):
    """Largest difference from the closed form in 1.5 s of all channels, relative to the peak; the piece begins with its first sample."""
    with open(path, "rb") as file:
        raw = file.read()
    start = raw.find(b"data") + 8 if raw[:4] == b"RIFF" else 0
    samples = array.array("f", raw[start:start + 4 * 4 * 2 * RATE // 16 * 16])
    first = next(i for i, y in enumerate(samples) if abs(y) > 1e-9) // CHANNELS - 1  # sin(0), or what rounding leaves of it, is the frame before
    worst, peak = 0.0, 0.0
    for n in range(0, RATE * 3 // 2, 7):
        t = n / RATE
        x = [a * math.sin(2 * math.pi * f * t) * math.exp(-tau * t) for f, tau, a, _ in voices]
        for j in range(CHANNELS):
            expected = sum(v[3][j] * y for v, y in zip(voices, x))
            at = (n + first) * CHANNELS + j
            worst = max(worst, abs(expected - (samples[at] if at >= 0 else 0.0)))
            peak = max(peak, abs(expected))
    return worst / peak


class Peers:
    """Command lines by name: command(seconds) renders so much into self.out."""

    def __init__(self, build, voices):
        self.build, self.voices, self.out = build, voices, f"{build}/out.raw"
        listed = f"{build}/voices.txt"
        with open(listed, "w", encoding="utf-8") as file:
            file.writelines(f"{f!r} {tau!r} {a!r} " + " ".join(map(repr, gains)) + "\n" for f, tau, a, gains in voices)
        self.program = lambda name: lambda seconds: [f"{build}/{name}", listed, str(seconds), self.out]

    def write(self, name, content):
        path = f"{self.build}/{name}"
        with open(path, "wb" if isinstance(content, bytes) else "w") as file:
            file.write(content)
        return path

    def csound(self, seconds):
        return ["csound", "-d", "-m0", "-f", "-h", "-o", self.out, self.write("voices.csd", formats.as_csound(self.voices, seconds))]

    def supercollider(self, seconds):
        score = self.write("voices.osc", formats.as_supercollider(self.voices, seconds))
        return ["scsynth", "-N", score, "_", self.out, str(RATE), "raw", "float", "-o", str(CHANNELS), "-i", "0"]

    def pure_data(self, seconds):
        return ["pd", "-batch", "-nogui", "-r", str(RATE), "-open", self.write("voices.pd", formats.as_pure_data(self.voices, seconds, self.out))]


def main(build, count):
    voices = make_voices(count)
    peers = Peers(build, voices)
    ours = peers.program("ours")
    work = count * CHANNELS * RATE * 1e-9  # 10^9 mode-sample-channels in a second of sound
    entries = [("PhysVib, whole chain", peers.program("chain"), 300), ("the same, across tiles", peers.program("chain-across"), 300),
               ("naive, double, -O3", peers.program("naive-O3"), 20),
               ("naive, float, -Ofast -march=native", peers.program("naive-Ofast"), 120),
               ("plain SIMD, float, -Ofast -march=native", peers.program("simd"), 300), ("Faust, float", peers.program("faust-float"), 120),
               ("Faust, double", peers.program("faust-double"), 120), ("STK SineWave * Asymp", peers.program("stk"), 40),
               ("Csound poscil * expon", peers.csound, 40), ("SuperCollider SinOsc * XLine", peers.supercollider, 60),
               ("Pd cpole~", peers.pure_data, 40)]

    def rate(command, seconds):
        short = seconds_of(command(SHORT))
        return work * (seconds - SHORT) / max(seconds_of(command(seconds)) - short, 1e-6)

    print(f"{count} voices, {CHANNELS} channels, {RATE} Hz; load {os.getloadavg()[0]:.1f}", flush=True)
    print("| what | 10^9 msc/s | PhysVib's mode bank is faster by | error |\n| --- | --- | --- | --- |", flush=True)
    own, error = [], None
    for name, command, seconds in entries:
        try:
            ratios, rates = [], []
            for _ in range(ROUNDS):
                own.append(rate(ours, 700))  # of the 800 s until the first voice is over
                error = error or error_of(peers.out, voices)
                rates.append(rate(command, seconds))
                ratios.append(own[-1] / rates[-1])
            low, high = min(ratios), max(ratios)
            print(f"| {name} | {statistics.median(rates):.2f} | {statistics.median(ratios):.1f} ({low:.1f} to {high:.1f}) | {error_of(peers.out, voices):.0e} |", flush=True)
        except (OSError, StopIteration, IndexError) as reason:
            print(f"| {name} | not here: {reason} | | |", flush=True)
    print(f"| PhysVib, mode bank | {statistics.median(own):.2f} | | {error:.0e} |")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) == 3 else 64)
