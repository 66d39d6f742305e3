#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What recorded.sh asks: `plan PHYSVIB falls|boxes PROTOCOL.json` writes a protocol that has each condition once and prints the seconds to record;
`compare PHYSVIB falls|boxes FOLDER RECORDING.raw` compares the rows in FOLDER with the samples. Exit code 1 if anything is wrong."""
import array
import csv
import json
import math
import struct
import subprocess
import sys
from pathlib import Path

RATE, FULL_SCALE_G = 48000, 2.0  # of the layout study1
FALL_SECONDS = 2
bad = []


def expect(holds: bool, words: str) -> None:
    if not holds:
        bad.append(words)


def plan(physvib: str, what: str, path: str) -> int:
    name = {"falls": "model-or-sound", "boxes": "eight-methods"}[what]
    protocol = json.loads(subprocess.run([physvib, "study", "show", name], capture_output=True, text=True, check=True).stdout)
    protocol["name"] = "short"
    session = protocol["sessions"][-1]
    for field in ("levels_from", "both_orders", "break_every", "break_s", "break_before_s"):
        session.pop(field, None)
    session |= {"order": "given", "repetitions": 1}
    protocol["sessions"] = [session]
    protocol.pop("closing_question", None)
    if what == "falls":
        for alternative in session["alternatives"]:
            alternative["level_db"] = -8  # where the adjustment starts
        condition = protocol["conditions"][0]
        condition["call"] = condition["call"].replace("--seconds 4", f"--seconds {FALL_SECONDS}")
    else:
        session["least_s"] = 3
    Path(path).write_text(json.dumps(protocol))
    print(27 * 2 * 4 if what == "falls" else 8 * (3 * 5 + 6))
    return 0


def samples_of(wav: bytes) -> array.array:
    at = 12
    while wav[at:at + 4] != b"data":
        at += 8 + struct.unpack("<I", wav[at + 4:at + 8])[0]
    size = struct.unpack("<I", wav[at + 4:at + 8])[0]
    return array.array("f", wav[at + 8:at + 8 + size])


def seconds_of(folder: str, call: str) -> float:
    """How long a world moved, as its saved session says; the session itself ends when the last of it was felt."""
    log = next(word for word in call.split() if word.endswith(".json"))
    return sum(take["world_end_s"] - take["start_s"] for take in json.loads((Path(folder) / log).read_text())["takes"])


def decibels(ratio: float) -> float:
    return 20.0 * math.log10(max(ratio, 1e-12))


def compare(physvib: str, what: str, folder: str, raw: str) -> int:
    recording = Path(raw).read_bytes()
    rows = list(csv.DictReader(line for line in (Path(folder) / "short-P01.csv").read_text().splitlines() if not line.startswith("#")))
    expect(len(rows) == (27 if what == "falls" else 8), f"expected all conditions, found {len(rows)} rows")
    at, peaks, worst_peak, worst_rms, parts = 0, {}, 0.0, 0.0, 0
    for row in rows:
        words = f"{row['stimulus']}"
        expect(float(row["limiter_db"]) == 0.0, f"{words}: the limiter lowered it by {row['limiter_db']} dB")
        calls = row["render"].split(" ; ")
        names, told, told_rms = row["parts"].split("|"), row["peak_g"].split("|"), row["rms_g"].split("|")
        for name, call, peak_g, rms_g in zip(names, calls, told, told_rms, strict=True):
            subprocess.run([physvib, *call.split(), "--out", "again.wav"], cwd=folder, check=True, capture_output=True)
            again = samples_of((Path(folder) / "again.wav").read_bytes())
            first = next((n for n, s in enumerate(again) if s != 0.0), None)
            if first is None:
                expect(False, f"{words} {name}: nothing was to be felt")
                continue
            last = max(n for n, s in enumerate(again) if s != 0.0) + 1
            wanted = again[first:last].tobytes()
            found = recording.find(wanted, at)
            while found >= 0 and found % 4:
                found = recording.find(wanted, found + 1)
            if found < 0:
                expect(False, f"{words} {name}: its log does not render the samples that were recorded")
                continue
            at = found + len(wanted)
            played = array.array("f", recording[found:at])
            peak = max(abs(s) for s in played) * FULL_SCALE_G
            seconds = FALL_SECONDS if what == "falls" else seconds_of(folder, call)
            rms = math.sqrt(sum(s * s for s in played) / (seconds * RATE)) * FULL_SCALE_G
            parts += 1
            worst_peak = max(worst_peak, abs(float(peak_g) / peak - 1.0))
            expect(abs(float(peak_g) / peak - 1.0) <= 0.01, f"{words} {name}: the row says {peak_g} g, {peak:.5f} g were recorded")
            worst_rms = max(worst_rms, abs(float(rms_g) / rms - 1.0))
            expect(abs(float(rms_g) / rms - 1.0) <= 0.02,  # the row's time ends with a picture, up to 33 ms later
                   f"{words} {name}: the row says {rms_g} g (root mean square), {rms:.5f} g were recorded")
            if what == "falls":
                expect(peak < FULL_SCALE_G, f"{words} {name}: full scale")
                peaks[(name, *words.rsplit(" height=", 1))] = peak
    worst_distance = 0.0
    for (name, kind, height), peak in peaks.items():
        error = abs(decibels(peak / peaks[(name, kind, "1")]) - 10.0 * math.log10(float(height)))
        worst_distance = max(worst_distance, error)
        expect(error <= 0.1, f"{kind} {name}: {height} m against 1 m is {error:.3f} dB off Eq. 5.4")
    print(f"{what}: {parts} parts of {len(rows)} conditions recorded to the bit of their logs; rows against samples: peak within {100 * worst_peak:.3f} %, "
          f"root mean square within {100 * worst_rms:.2f} %" + (f"; falls of 1, 2, 3 m within {worst_distance:.3f} dB of Eq. 5.4" if peaks else "") + "; limiter at 0 dB" * (not bad))
    for words in bad:
        print(words)
    return 1 if bad else 0


sys.exit(plan(*sys.argv[2:]) if sys.argv[1] == "plan" else compare(*sys.argv[2:]))
