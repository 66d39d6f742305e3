#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the tables of Docs/pads.md: what motors of a game controller make of our commands, and of calls where the last one wins.

usage: pads.py PHYSVIB [PROFILE]

A motor here is stated again from its description, not our program's: nothing below the threshold, straight lines to half and full, a
first-order lag. It is also tried with motors 30 % slower and 30 % faster than the profile believes. A hit is felt if a motor that has
stood still, or not, is stronger than FELT within 150 ms of it. Energy: of all four channels of the render, and of both motors, in windows of 50 ms.
The naive way: each hit is one call as games make it (amplitude as command, until its mode has fallen to a tenth), and it replaces what played;
and the same with commands moved above the threshold.
Needs Debian's python3-numpy."""
import csv
import io
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

SCENES = ("shake-the-box", "fruit-basket", "driving", "drop", "marbles")
SECONDS, STEP, FELT, WINDOW, WITHIN = 20.0, 0.001, 0.1, 0.05, 0.15
FLOOR = 0.01  # weakest amplitude that counts


def motor(commands, profile, slower):
    """Strength of one motor, by STEP, of (time, command) pairs."""
    steps = int(SECONDS / STEP) + 500
    held = np.zeros(steps)
    for time, command in commands:
        held[max(0, int(round(time / STEP))):] = command
    aim = np.interp(held, [profile["threshold"], profile["half"], profile["full"]], [0.0, 0.5, 1.0])
    up, down = (1 - np.exp(-np.log(10) * STEP / (profile[key] * slower)) for key in ("rise_s", "fall_s"))
    strength, now = np.zeros(steps), 0.0
    for i in range(steps):
        now += (aim[i] - now) * (up if aim[i] > now else down)
        strength[i] = now
    return strength


def table(text):
    return list(csv.DictReader(io.StringIO("".join(line for line in text.splitlines(True) if not line.startswith("#")))))


def naive(events, threshold=0.0):
    """Calls of (time, low, high): the last wins, and ends all by itself."""
    calls = []
    for i, event in enumerate(events):
        time, amplitude, hz, tau = (float(event[key]) for key in ("time_s", "amplitude", "frequency_hz", "decay_per_s"))
        gated = float(event.get("duration_s") or 0)
        ends = time + (gated if gated > 0 else np.log(10) / tau)
        command = threshold + (1 - threshold) * min(1.0, amplitude)
        calls.append((time, command if hz < 100 else 0.0, command if hz >= 100 else 0.0))
        if i + 1 == len(events) or float(events[i + 1]["time_s"]) > ends:
            calls.append((ends, 0.0, 0.0))
    return calls


def felt(events, low, high):
    strongest = np.maximum(low, high)
    hits = [float(e["time_s"]) for e in events if float(e["amplitude"]) >= FLOOR]
    count = sum(strongest[int(t / STEP):int((t + WITHIN) / STEP)].max() >= FELT for t in hits)
    return count, len(hits)


def windows(energy, per):
    whole = len(energy) // per * per
    return energy[:whole].reshape(-1, per).mean(axis=1)


def correlation(samples, rate, low, high):
    render = windows((samples ** 2).sum(axis=1), int(rate * WINDOW))
    pad = windows(low[:int(SECONDS / STEP)] ** 2 + high[:int(SECONDS / STEP)] ** 2, int(WINDOW / STEP))
    n = min(len(render), len(pad))
    return np.corrcoef(np.sqrt(render[:n]), np.sqrt(pad[:n]))[0, 1] if pad[:n].std() > 0 else 0.0


def wav(path):
    data = open(path, "rb").read()
    at = data.index(b"fmt ") + 8
    channels, rate = int.from_bytes(data[at + 2:at + 4], "little"), int.from_bytes(data[at + 4:at + 8], "little")
    start = data.index(b"data") + 8
    return np.frombuffer(data[start:start + (len(data) - start) // 4 * 4], "<f4").reshape(-1, channels), rate


def pairs(rows, key):
    return [(float(row["time_s"]), float(row[key])) for row in rows]


def scenes(physvib, name, profile):
    print("| scene | hits | felt: last call wins | and above the threshold | physvib | energy: last call wins | and above the threshold | physvib |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    worst = []
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            out, listed, motors = (os.path.join(folder, file) for file in ("o.wav", "o.csv", "m.csv"))
            call = [physvib, "render", scene, "--seconds", str(SECONDS)]
            subprocess.run([*call, "--out", out, "--events", listed], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            subprocess.run([*call, "--pad", name, "--out", motors], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            events, rows, (samples, rate) = table(open(listed).read()), table(open(motors).read()), wav(out)
            ways = [naive(events), naive(events, profile["low"]["threshold"]), [(float(row["time_s"]), float(row["low"]), float(row["high"])) for row in rows]]
            for slower in (1.0, 1.3, 0.7):
                shares, energies = [], []
                for calls in ways:
                    low, high = (motor([(call[0], call[1 + k]) for call in calls], profile[key], slower) for k, key in enumerate(("low", "high")))
                    count, n = felt(events, low, high)
                    shares.append(100 * count / n)
                    energies.append(correlation(samples, rate, low, high))
                if slower == 1.0:
                    print(f"| {scene} | {n} | " + " | ".join(f"{s:.0f} %" for s in shares) + " | " + " | ".join(f"{e:.2f}" for e in energies) + " |", flush=True)
                worst.append((shares[-1], energies[-1]))
    print(f"\nwith motors 30 % slower or faster: at least {min(w[0] for w in worst):.0f} % felt, energy at least {min(w[1] for w in worst):.2f}\n")


def pulses(physvib, name, profile):
    print("| level of a 20 ms pulse | strongest, one call of 20 ms | strongest, physvib |\n| --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for tenth in range(1, 11):
            listed, motors = os.path.join(folder, "p.csv"), os.path.join(folder, "m.csv")
            open(listed, "w").write(f"time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m,duration_s\n0.500000000,50,0,{tenth / 10},0.06,0.03,0.02\n")
            subprocess.run([physvib, "render", "--from-events", listed, "--seconds", "2", "--pad", name, "--out", motors], check=True, stdout=subprocess.DEVNULL)
            ours = motor(pairs(table(open(motors).read()), "low"), profile["low"], 1.0).max()
            theirs = motor([(0.5, tenth / 10), (0.52, 0.0)], profile["low"], 1.0).max()
            print(f"| {tenth / 10:.1f} | {theirs:.2f} | {ours:.2f} |")


def main():
    physvib, name = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "pad-generic"
    path = name if name.endswith(".json") else os.path.join(os.path.dirname(__file__), "../../Source/Scene/Pads", name + ".json")
    profile = json.load(open(path))
    print(f"{name}, {profile['commands_per_s']} commands a second\n")
    scenes(physvib, name, profile)
    pulses(physvib, name, profile)


main()
