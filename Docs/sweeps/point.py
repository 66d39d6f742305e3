# SPDX-License-Identifier: MIT
"""A render in numbers, as a table of one row: point.py ROW.csv SAMPLES.wav EVENTS.csv PROGRAM render WORD... Change it to what you want to know."""
import csv
import os
import struct
import subprocess
import sys

import numpy

BANDS_HZ = (0, 50, 100, 200, 400, 800, 4000)


def read_wav(path: str) -> tuple[int, numpy.ndarray]:
    """The rate in Hz and the samples, shape (frames, channels), of physvib's 32-bit floats."""
    with open(path, "rb") as file:
        data, at = file.read(), 12
    while data[at:at + 4] != b"data":
        size = struct.unpack_from("<I", data, at + 4)[0]
        if data[at:at + 4] == b"fmt ":
            channels, rate = struct.unpack_from("<HI", data, at + 10)
        at += 8 + size + size % 2
    return rate, numpy.frombuffer(data, "<f4", offset=at + 8).reshape(-1, channels)


def of_events(path: str) -> dict[str, float]:
    with open(path, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    hits = [row for row in rows if row.get("kind", "hit") == "hit"]
    time, amplitude, impulse, x, y = (numpy.array([float(row.get(name) or 0) for row in hits]) for name in ("time_s", "amplitude", "impulse_ns", "x_m", "y_m"))
    found = {"hits": len(hits), "grains": len(rows) - len(hits), "impulse_sum_ns": impulse.sum()}
    if hits:
        found |= {"first_s": time[0], "last_s": time[-1], "impulse_max_ns": impulse.max(), "amplitude_max": abs(amplitude).max()}
    if len(hits) > 1:
        found |= {"gap_mean_s": numpy.diff(time).mean(), "gap_deviation_s": numpy.diff(time).std()}
    if amplitude.any():
        found |= {f"hit_{name}_m": numpy.average(of, weights=abs(amplitude)) for name, of in (("x", x), ("y", y))}
    return found


def of_samples(path: str) -> dict[str, float]:
    rate, samples = read_wav(path)
    power, hz = (abs(numpy.fft.rfft(samples, axis=0)) ** 2).sum(axis=1), numpy.fft.rfftfreq(len(samples), 1 / rate)
    found = {}
    if power.any():
        found["centroid_hz"] = numpy.average(hz, weights=power)
        found |= {f"band_{low}_{high}": power[(hz >= low) & (hz < high)].sum() / power.sum() for low, high in zip(BANDS_HZ, BANDS_HZ[1:])}
    for name, of in (("peak", abs(samples).max(axis=0)), ("rms", (samples.astype(float) ** 2).mean(axis=0) ** 0.5)):
        found |= {f"{name}_{n}": value for n, value in enumerate(of, 1)}
    return found


row, samples, events, *call = sys.argv[1:]
ran = subprocess.run([*call, f"--out={samples}", f"--events={events}"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
if ran.returncode:
    sys.exit(f"{' '.join(call[1:])}: {ran.stderr}")
found = {name: f"{value:.9g}" for name, value in (of_events(events) | of_samples(samples)).items()}
found |= {"warnings": "; ".join(ran.stderr.splitlines()), "call": " ".join(["physvib", *call[1:]])}
with open(row + ".part", "w", newline="") as file:
    csv.writer(file, lineterminator="\n").writerows([found.keys(), found.values()])
os.replace(row + ".part", row)
