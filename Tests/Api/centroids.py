#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where hits are felt by each panning law, as the table of Docs/panning.md says of four actuators: rendered, and the centroid of what comes out. Then what travels over rows and a
sleeve by the default law. PHYSVIB_LIBRARY and PYTHONPATH are set. centroids.py Docs/panning.md"""
import sys
from pathlib import Path

import numpy as np

import physvib
from physvib.layout import LAWS

MEANT = np.array([0.1, 0.2, 0.3, 0.4, 0.5])  # of the way along x, in the middle of y
LAYOUTS = {"two": physvib.Layout([(0.0, 0.0), (1.0, 0.0)], (1.0, 1.0)), "four": physvib.Layout([(0.0, 1.0), (1.0, 1.0), (0.0, 0.0), (1.0, 0.0)], (1.0, 1.0))}

SAME = {"neighbours": "energy", "auto": "linear", "triangles": "energy"}  # on two and on four corners


def peaks(layout: physvib.Layout, law: str) -> np.ndarray:
    """Of each channel, for each place."""
    rendered = []
    for x in MEANT:
        hit = physvib.events(0.0, frequency_hz=1000.0, decay_per_s=0.0, duration_s=0.02, amplitude=0.5, x_m=x, y_m=0.5)
        rendered.append(np.abs(physvib.render(hit, 0.03, layout=layout, law=law, field_m=(1.0, 1.0), limiter=False)).max(axis=1) / 0.5)
    return np.array(rendered)


def row(name: str, law: str) -> "tuple[str, np.ndarray]":
    layout = LAYOUTS[name]
    gains = peaks(layout, law)
    energy = gains**2
    centroid = (energy * [x for x, _ in layout.places_m]).sum(axis=1) / energy.sum(axis=1)
    cells = [" ".join(f"{value:.2f}" for value in values) for values in (centroid, gains.sum(axis=1), energy.sum(axis=1))]
    return f"| `{law}` | {name} | {' | '.join(cells)} |", centroid


page = Path(sys.argv[1]).read_text()
missing = []
for name in LAYOUTS:
    for law in LAWS:
        text, centroid = row(name, law)
        if law in SAME:
            assert text.partition(" | ")[2] == row(name, SAME[law])[0].partition(" | ")[2], text
            continue
        missing += [text] if name == "four" and text not in page else []
        if law == "energy":
            assert np.abs(centroid - MEANT).max() < 0.001, centroid


def felt(layout: physvib.Layout, kind: int, x: np.ndarray) -> np.ndarray:
    """Where 20 ms at each place of x are felt, by the law that nobody named."""
    start = 0.02 * np.arange(len(x))
    passed = physvib.events(start, frequency_hz=1000.0, decay_per_s=0.0, duration_s=0.02, amplitude=0.5, x_m=x, y_m=0.3, kind=kind)
    energy = (physvib.render(passed, 0.02 * len(x), layout=layout, field_m=(1.0, 1.0), limiter=False) ** 2).reshape(len(layout.places_m), len(x), -1).sum(axis=2)
    return np.array([place for place, _ in layout.places_m]) @ energy / energy.sum(axis=0)


for columns, rows in ((3, 1), (4, 1), (8, 1), (16, 1), (4, 2)):
    layout = physvib.Layout([(c / (columns - 1), float(r)) for r in range(rows) for c in range(columns)], (1.0, 1.0))
    way = np.linspace(0.0, 1.0, 101)
    for kind in (physvib.HIT, physvib.ROLL, physvib.SLIDE):
        centroid = felt(layout, kind, way)
        assert abs(np.polyfit(way, centroid, 1)[0] - 1.0) < 0.03 and np.abs(centroid - way).max() < 0.1 / (columns - 1), (columns, rows, kind, centroid)
print("\n".join(missing) or "the table of Docs/panning.md is what is rendered")
sys.exit(1 if missing else 0)
