# SPDX-License-Identifier: MIT
"""Where hits are felt by each panning law, as the table of Docs/panning.md says: rendered, and the centroid of what comes out. PHYSVIB_LIBRARY and
PYTHONPATH are set. centroids.py Docs/panning.md"""
import sys
from pathlib import Path

import numpy as np

import physvib
from physvib.layout import LAWS

MEANT = np.array([0.1, 0.2, 0.3, 0.4, 0.5])  # of the way along x, in the middle of y
LAYOUTS = {"two": physvib.Layout([(0.0, 0.0), (1.0, 0.0)], (1.0, 1.0)), "four": physvib.Layout([(0.0, 1.0), (1.0, 1.0), (0.0, 0.0), (1.0, 0.0)], (1.0, 1.0))}


def peaks(layout: physvib.Layout, law: str) -> np.ndarray:
    """Of each channel, for each place."""
    rendered = []
    for x in MEANT:
        hit = physvib.events(0.0, frequency_hz=1000.0, decay_per_s=0.0, duration_s=0.02, amplitude=0.5, x_m=x, y_m=0.5)
        rendered.append(np.abs(physvib.render(hit, 0.03, layout=layout, law=law, field_m=(1.0, 1.0), limiter=False)).max(axis=1) / 0.5)
    return np.array(rendered)


def row(name: str, law: str, coupling: float) -> "tuple[str, np.ndarray]":
    layout = LAYOUTS[name]
    gains = peaks(layout, law)
    felt = gains + coupling * (gains.sum(axis=1, keepdims=True) - gains)
    energy = felt**2
    centroid = (energy * [x for x, _ in layout.places_m]).sum(axis=1) / energy.sum(axis=1)
    cells = [" ".join(f"{value:.2f}" for value in values) for values in (centroid, felt.sum(axis=1), energy.sum(axis=1))]
    return f"| `{law}` | {name} | {round(100 * coupling)} % | {' | '.join(cells)} |", centroid


page = Path(sys.argv[1]).read_text()
missing = []
for coupling in (0.0, 0.1):
    for name in LAYOUTS:
        for law in LAWS:
            text, centroid = row(name, law, coupling)
            missing += [text] if text not in page else []
            if law == "energy" and coupling == 0.0:
                assert np.abs(centroid - MEANT).max() < 0.001, centroid
print("\n".join(missing) or "the table of Docs/panning.md is what is rendered")
sys.exit(1 if missing else 0)
