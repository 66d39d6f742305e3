# SPDX-License-Identifier: MIT
"""Gains of the laws `triangles` and `distance` on ten layouts in space, rendered, against numpy from the published formulas: vector base panning (V. Pulkki, J. Audio Eng. Soc. 45(6), 1997,
Eq. 9), applied to intensities (Pernaux, Boussard, Jot, DAFx 1998), with a virtual loudspeaker in the middle of faces that are no triangles (ITU-R BS.2127, 6.1.3); and Shepard's
weights (Proc. ACM 1968). No hull is built here: of all triples whose weights are not negative, that of the hull is the one with the least sum. PHYSVIB_LIBRARY and PYTHONPATH are set."""
import itertools
import sys
import warnings

import numpy as np

import physvib

PLACES, TONE_S, APART_S = 200, 0.002, 0.01


def prism(count: int, height: float) -> np.ndarray:
    angle = 2 * np.pi * np.arange(count) / count
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.concatenate([np.column_stack([ring, np.full(count, z)]) for z in (0.0, height)])


def layouts(random: np.random.Generator) -> "dict[str, np.ndarray]":
    golden = (1 + 5**0.5) / 2
    icosahedron = np.array([np.roll((0, a, b * golden), turn) for turn in range(3) for a in (-1, 1) for b in (-1, 1)])
    directions = {count: (lambda d: d / np.linalg.norm(d, axis=1, keepdims=True))(random.normal(size=(count, 3))) for count in (12, 24)}
    rim = prism(8, 1.0)[8:] * (1, 1, 0)
    presets = {name: np.array(physvib.Layout.preset(name).places_m) for name in ("sleeve8", "vest16")}
    return {"tetrahedron": np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1.0)]), "octahedron": np.concatenate([np.eye(3), -np.eye(3)]),
            "cube": np.array(list(itertools.product((0.0, 1.0), repeat=3))), "icosahedron": icosahedron, "prism": prism(5, 1.2),
            "helmet": np.concatenate([rim, 0.7 * prism(6, 0.0)[:6] + (0, 0, 0.7), [(0, 0, 1.0)]]), **presets,
            "uneven 12": directions[12] * random.uniform(0.7, 1.3, (12, 1)), "uneven 24": directions[24] * random.uniform(0.8, 1.2, (24, 1))}


def by_triangles(places: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Gains, shape (places, actuators), of places in no actuator's direction."""
    count, centre = len(places), places.mean(axis=0)
    vectors = places - centre
    units = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    triples = np.array(list(itertools.combinations(range(count), 3)))
    bases = units[triples]
    triples, bases = (array[np.abs(np.linalg.det(bases)) > 1e-9] for array in (triples, bases))
    inverse = np.linalg.inv(bases)
    gains = np.zeros((len(at), count))
    for k, out in enumerate(at - centre):
        weights = np.einsum("j,tji->ti", out, inverse)
        sums = np.where((weights >= -1e-9 * np.linalg.norm(out)).all(axis=1), weights.sum(axis=1), np.inf)
        face = sorted(set(triples[sums < sums.min() * (1 + 1e-7)].reshape(-1)))  # more than three, if they lie in one plane
        shares = np.zeros(count)
        if len(face) == 3:
            corners = [(vectors[j], {j: 1.0}) for j in face]
        else:  # the middle, and two that are next to each other: between their directions there is no other
            middle = (vectors[face].mean(axis=0), {j: 1.0 / len(face) for j in face})
            normal = units[face].mean(axis=0) / np.linalg.norm(units[face].mean(axis=0))
            flat = units[face] - np.outer(units[face] @ normal, normal)
            angle = np.arctan2(flat @ np.cross(normal, flat[0]), flat @ flat[0])
            order = np.array(face)[np.argsort(angle)]
            found = [(a, b) for a, b in zip(order, np.roll(order, -1))
                     if (np.linalg.solve(np.array([middle[0], vectors[a], vectors[b]]).T, out) >= -1e-9).all()]
            corners = [middle, *[(vectors[j], {j: 1.0}) for j in found[0]]]
        weights = np.linalg.solve(np.array([vector for vector, _ in corners]).T, out)
        reach = weights.sum()
        for weight, (_, who) in zip(weights / max(1.0, reach), corners):
            for j, part in who.items():
                shares[j] += weight * part
        gains[k] = np.sqrt(np.maximum(shares + (1 - min(1.0, reach)) / count, 0.0))
    return gains


def by_distance(places: np.ndarray, at: np.ndarray) -> np.ndarray:
    weights = 1.0 / ((at[:, None, :] - places[None]) ** 2).sum(axis=2)
    return np.sqrt(weights / weights.sum(axis=1, keepdims=True))


def rendered(places: np.ndarray, at: np.ndarray, law: str) -> np.ndarray:
    layout = physvib.Layout(places.tolist(), (1.0, 1.0))
    hits = physvib.events(APART_S * np.arange(len(at)), frequency_hz=1000.0, decay_per_s=0.0, duration_s=TONE_S, amplitude=0.5, x_m=at[:, 0], y_m=at[:, 1], z_m=at[:, 2])
    warnings.simplefilter("ignore")  # most places lie outside the field, as they should
    samples = physvib.render(hits, APART_S * len(at), layout=layout, law=law, field_m=(1.0, 1.0), limiter=False)
    return np.abs(samples).reshape(len(places), len(at), -1).max(axis=2).T / 0.5


random = np.random.default_rng(53)
for name, places in layouts(random).items():
    span = places.max(axis=0) - places.min(axis=0)
    at = places.min(axis=0) + span * random.uniform(-0.3, 1.3, (PLACES, 3))  # within and around
    own = np.concatenate([places, [places.mean(axis=0)]])  # each actuator alone, and at the centre all alike
    by_law = {"triangles": by_triangles, "auto": by_triangles, "distance": by_distance}
    worst = {law: np.abs(rendered(places, at, law) - gains(places, at)).max() for law, gains in by_law.items()}
    alone = np.concatenate([np.eye(len(places)), np.full((1, len(places)), len(places) ** -0.5)])
    worst["own places"] = np.abs(rendered(places, own, "auto") - alone).max()
    print(f"{name}, {len(places)} actuators: gains differ by at most " + ", ".join(f"{value:.1e} ({law})" for law, value in worst.items()))
    if max(worst.values()) > 2e-5:
        sys.exit(f"expected the same gains on {name}")
