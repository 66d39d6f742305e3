#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws Docs/pico-drift.svg: how full the Pico's buffer is for ten minutes with hosts whose clocks are off, by the firmware's own files.
usage: pico_drift.py Docs/pico-drift.svg"""
import os
import subprocess
import sys
import tempfile

CLOCKS = ((-500, "#b04a00"), (0, "#444"), (500, "#00629b"))  # ppm, colour
LEFT, RIGHT, TOP, HIGH, MOST = 56, 600, 34, 220, 176  # the plot; frames at its top


def courses():
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "drift")
        subprocess.run(["g++", "-std=c++20", "-O2", "-ISource", "-IFirmware/Pico", "-ITests", "-ITests/Pico", "Tests/Firmware/pico/drift.cpp", "-o", program], check=True)
        for ppm, colour in CLOCKS:
            lines = subprocess.run([program, str(ppm)], check=True, capture_output=True, text=True).stdout.splitlines()
            yield ppm, colour, [tuple(map(int, line.split())) for line in lines]


def x(second):
    return LEFT + (RIGHT - LEFT) * second / 600


def y(frames):
    return TOP + HIGH * (1 - frames / MOST)


def drawn():
    yield '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 300" font-family="sans-serif" font-size="13" fill="#222">'
    yield '<rect width="720" height="300" fill="#fff"/>'
    yield f'<text x="{LEFT}" y="20">frames in the buffer behind a packet: least and most of each second</text>'
    for frames in (0, 48, 96, 144):
        yield f'<line x1="{LEFT}" x2="{RIGHT}" y1="{y(frames):.1f}" y2="{y(frames):.1f}" stroke="{"#222" if frames == 0 else "#ddd"}"/>'
        yield f'<text x="{LEFT - 8}" y="{y(frames) + 4:.1f}" text-anchor="end">{frames}</text>'
    for minute in range(0, 11, 2):
        yield f'<text x="{x(60 * minute):.1f}" y="{TOP + HIGH + 20}" text-anchor="middle">{minute} min</text>'
    for line, (ppm, colour, course) in enumerate(courses()):
        ends = [f"{x(s + 0.5):.1f},{y(most):.1f}" for s, (_, most) in enumerate(course)] + [f"{x(s + 0.5):.1f},{y(least):.1f}" for s, (least, _) in reversed(list(enumerate(course)))]
        yield f'<polygon points="{" ".join(ends)}" fill="{colour}" fill-opacity="0.35" stroke="{colour}" stroke-width="0.7"/>'
        yield f'<text x="{RIGHT + 10}" y="{y(150) + 20 * line:.1f}" fill="{colour}">{ppm:+d} ppm</text>'.replace("+0 ppm", "0 ppm")
    yield f'<text x="{RIGHT + 10}" y="{y(0) + 4:.1f}">dropout</text>'
    yield "</svg>"


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("\n".join(drawn()) + "\n")
