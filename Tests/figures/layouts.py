#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws layouts in space as one SVG: a picture in a page; opened by itself in a browser, it turns under the pointer or by the arrow keys.
usage: layouts.py OUT.svg NAME-OR-FILE...   (PYTHONPATH: Source/Api/Python; PHYSVIB_LIBRARY: libphysvib.so)"""
import html
import json
import math
import os
import sys
import tempfile

from physvib import Layout

SIDE, TOP = 260, 34  # of one view, and above it
YAW, PITCH = 0.6, 0.35  # radians at first
COLOURS = ("#00629b", "#b04a00", "#1b7f4b", "#7d3c98", "#8a6d00", "#a02040")

TURN = """
const svg = document.documentElement;
let yaw = %(yaw)s, pitch = %(pitch)s, held = null;
function draw() {
    const [a, b, c, d] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    const seen = ([x, y, z]) => [x * a + z * b, -(y * c + (x * b - z * a) * d), z * a * c - x * b * c + y * d];
    for (const view of svg.querySelectorAll("g.view")) {
        for (const path of view.querySelectorAll("path"))
            path.setAttribute("d", JSON.parse(path.dataset.points).map((p, i) => (i %% 2 ? "L" : "M") + seen(p).slice(0, 2).map(v => v.toFixed(1))).join(" "));
        const all = [...view.querySelectorAll("g.place")].map(place => [place, seen(JSON.parse(place.dataset.at))]);
        for (const [place, at] of all.sort((m, n) => m[1][2] - n[1][2])) {
            place.setAttribute("transform", `translate(${at[0].toFixed(1)} ${at[1].toFixed(1)}) scale(${(1 + at[2] / 400).toFixed(3)})`);
            view.append(place);
        }
    }
}
function turn(right, up) { yaw += right; pitch = Math.max(-1.5, Math.min(1.5, pitch + up)); draw(); }
svg.addEventListener("pointerdown", event => { held = event; svg.setPointerCapture(event.pointerId); });
svg.addEventListener("pointerup", () => held = null);
svg.addEventListener("pointermove", event => { if (held) { turn((event.clientX - held.clientX) / 120, (event.clientY - held.clientY) / 120); held = event; } });
addEventListener("keydown", ({ key }) => turn({ ArrowLeft: -0.1, ArrowRight: 0.1 }[key] ?? 0, { ArrowUp: -0.1, ArrowDown: 0.1 }[key] ?? 0));
"""


def read(name):
    """(name, extent, [(label, (x, y, z), part)]) of a preset or a file, as a layout file has them."""
    layout = Layout.load(name) if os.path.exists(name) else Layout.preset(name)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "layout.json")
        layout.save(path, os.path.splitext(os.path.basename(name))[0])
        with open(path, encoding="utf-8") as file:
            told = json.load(file)
    return told["name"], told["extent_m"], [(e["label"], (e["x_m"], e["y_m"], e.get("z_m", 0.0)), e.get("part", "")) for e in told["enchanters"]]


def seen(point):
    """As TURN has it: (x to the right, y down, depth towards the viewer)."""
    x, y, z = point
    a, b, c, d = math.cos(YAW), math.sin(YAW), math.cos(PITCH), math.sin(PITCH)
    return x * a + z * b, -(y * c + (x * b - z * a) * d), z * a * c - x * b * c + y * d


def line(points, colour, dashes=""):
    path = " ".join(f"{'ML'[i % 2]}{seen(p)[0]:.1f},{seen(p)[1]:.1f}" for i, p in enumerate(points))
    told = json.dumps([[round(v, 1) for v in p] for p in points], separators=(",", ":"))
    return f'<path d="{path}" data-points="{told}" stroke="{colour}" fill="none"{dashes}/>'


def view(column, name, extent, places):
    corners = [(0.0, 0.0, 0.0), (*extent, 0.0)] + [at for _, at, _ in places]
    low, high = ([f(axis) for axis in zip(*corners)] for f in (min, max))
    middle = [(l + h) / 2 for l, h in zip(low, high)]
    scale = 0.72 * SIDE / math.dist(low, high)
    drawn = [tuple(scale * (v - m) for v, m in zip(at, middle)) for _, at, _ in places]
    box = [[scale * (bound[axis] - middle[axis]) for axis in range(3)] for bound in (low, high)]
    edges = []
    for axis in range(3):
        for near in range(4):
            others = [k for k in range(3) if k != axis]
            for end in (0, 1):
                start = [0.0, 0.0, 0.0]
                start[axis] = box[end][axis]
                start[others[0]], start[others[1]] = box[near & 1][others[0]], box[near >> 1][others[1]]
                edges.append(tuple(start))
    yield f'<g class="view" transform="translate({SIDE * column + SIDE / 2:.0f} {TOP + SIDE / 2:.0f})">'
    yield line(edges, "#c8ced4")
    zero = tuple(box[0])
    for axis, word in enumerate("xyz"):
        tip = list(zero)
        tip[axis] += 34.0
        yield line([zero, tuple(tip)], "#556270")
        tip[axis] += 9.0
        yield f'<g class="place" data-at="{json.dumps([round(v, 1) for v in tip])}" transform="translate({seen(tip)[0]:.1f} {seen(tip)[1]:.1f})">' \
              f'<text y="4" fill="#556270">{word}</text></g>'
    names = list(dict.fromkeys(part for _, _, part in places))
    for (label, _, part), at in sorted(zip(places, drawn), key=lambda pair: seen(pair[1])[2]):
        x, y, depth = seen(at)
        yield f'<g class="place" data-at="{json.dumps([round(v, 1) for v in at])}" transform="translate({x:.1f} {y:.1f}) scale({1 + depth / 400:.3f})">' \
              f'<circle r="11" fill="{COLOURS[names.index(part) % len(COLOURS)]}" stroke="#fff"/><text y="4" fill="#fff">{html.escape(label)}</text>' \
              f"<title>{html.escape(f'{label}, {part}' if part else label)}</title></g>"
    yield "</g>"
    yield f'<text x="{SIDE * column + SIDE / 2:.0f}" y="24" font-size="15" font-weight="bold">{html.escape(name)}</text>'
    for row, part in enumerate(names):
        if part:
            yield f'<text x="{SIDE * column + SIDE / 2:.0f}" y="{TOP + SIDE + 14 + 15 * row}" fill="{COLOURS[row % len(COLOURS)]}">{html.escape(part)}</text>'


def main(out, names):
    layouts = [read(name) for name in names]
    rows = max(len({part for _, _, part in places if part}) for _, _, places in layouts)
    wide, high = SIDE * len(layouts), TOP + SIDE + 15 * rows + 28
    body = ["<!-- SPDX-License-Identifier: MIT -->",
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" font-family="sans-serif" font-size="12" text-anchor="middle" style="touch-action:none">',
            f"<title>Actuators in space: {html.escape(', '.join(name for name, _, _ in layouts))}</title>", f'<rect width="{wide}" height="{high}" fill="#f4f6f8"/>']
    for column, (name, extent, places) in enumerate(layouts):
        body += view(column, name, extent, places)
    body.append(f'<text x="{wide / 2:.0f}" y="{high - 8}" fill="#556270">Opened by itself in a browser, it turns: drag, or arrow keys.</text>')
    body += [f"<script><![CDATA[{TURN % {'yaw': YAW, 'pitch': PITCH}}]]></script>", "</svg>"]
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(body) + "\n")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
