#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What recorded.sh asks: `plan PHYSVIB STUDY PROTOCOL.json` writes a protocol that has each condition once and prints the seconds to record;
`compare PHYSVIB STUDY FOLDER RECORDING.raw` compares the rows in FOLDER with the samples, and those of a study of one's own with what numpy makes
of its protocol. Exit code 1 if anything is wrong."""
import array
import csv
import json
import math
import re
import struct
import subprocess
import sys
import wave
from pathlib import Path

import numpy as np

RATE, FULL_SCALE_G = 48000, 2.0  # of the layout study1
FALL_SECONDS = 2
bad = []

# Studies of one's own, of one factor, of whose two alternatives the second is varied.
PHANTOM = "stimulus phantom --at 0.5,0.5 --layout study1"
OWN = {
    "frequency": {"values": ["150", "180.5", "215", "260", "330"], "otherwise": "200", "call": PHANTOM + " --frequency {value} --level-g 0.3 --seconds 0.5"},
    "decay": {"values": ["0", "14", "20", "40", "80"], "otherwise": "10",
              "call": PHANTOM + " --frequency 200 --decay {value} --level-of energy --level-g 0.06 --seconds 0.6"},
    "clip": {"values": ["1", "2", "3"], "otherwise": "1",
             "call": "render drop --set pair=wood-wood --set height={value} --set falls=once --seconds 1.5 --layout study1 --method SV --level-db -8"},
}


def clip() -> np.ndarray:
    """A recording of a contact: two modes of unlike decay and a click."""
    t = np.arange(RATE // 10) / RATE
    x = np.exp(-60 * t) * np.sin(2 * np.pi * 349 * t) + 0.4 * np.exp(-200 * t) * np.sin(2 * np.pi * 900 * t)
    x[:8] += 0.2
    return np.round(x / np.abs(x).max() * 30000)


def by_numpy(what: str, value: str) -> np.ndarray:
    """In g, from the study's words and not from the row's call; of the clip its shape alone."""
    if what == "clip":
        return clip()
    seconds = {"frequency": 0.5, "decay": 0.6}[what]
    t = np.arange(round(seconds * RATE)) / RATE
    if what == "frequency":
        return 0.3 * np.sin(2 * np.pi * float(value) * t)
    d = float(value)
    envelope_s = -np.expm1(-2 * d * seconds) / (2 * d) if d else seconds
    return 0.06 / np.sqrt(envelope_s) * np.exp(-d * t) * np.sin(2 * np.pi * 200 * t)


def off_numpy(what: str, value: str, played: np.ndarray) -> tuple:
    """How far the samples are from numpy's, as a share of the peak; and the peak in g."""
    wanted = by_numpy(what, value)
    wanted = wanted[np.argmax(wanted != 0):]
    if what == "clip": # the first contact, as loud as it is
        found = played[:min(len(wanted), len(played))]
        wanted = wanted[:len(found)]
        wanted = wanted * (found @ wanted) / (wanted @ wanted)
    length = max(len(played), len(wanted))
    found, wanted = (np.pad(x, (0, length - len(x))) for x in (played if what != "clip" else found, wanted))
    return np.abs(found - wanted).max() / np.abs(wanted).max(), np.abs(wanted).max()


def expect(holds: bool, words: str) -> None:
    if not holds:
        bad.append(words)


def found_near(recording: np.ndarray, at: int, wanted: np.ndarray) -> tuple:
    """Where what is felt from there on begins, and how far it is from the render, as a share of the peak: a call that is felt begins within a nanosecond
    of a frame, so samples differ by what a wave moves in that time."""
    sounds = np.flatnonzero(recording)
    begins = sounds[np.diff(sounds, prepend=-RATE) > RATE // 100]  # after silence: a clip may outlast its call
    first = int(begins[np.searchsorted(begins, at)]) if len(begins) and begins[-1] >= at else len(recording)
    padded = [(np.abs(recording[start:start + len(wanted)] - wanted).max() / np.abs(wanted).max(), start) for start in (first - 1, first, first + 1)
              if start >= 0 and start + len(wanted) <= len(recording)]
    off, start = min(padded, default=(1.0, first))
    return start, off


def plan_own(what: str, path: str) -> int:
    own = OWN[what]
    factor = {"name": "value", "values": own["values"], "alternative": "varied", "otherwise": own["otherwise"]}
    session = {"name": "main", "task": "choose", "order": "given", "alternatives": [{"name": "standard"}, {"name": "varied"}], "correct": "varied"}
    condition = {"name": "c", "layout": "study1", "stimuli": "calls", "factors": [factor], "call": own["call"]}
    protocol = {"physvib_protocol": 1, "name": "short", "conditions": [condition], "sessions": [session]}
    if what == "clip":
        protocol["sounds"] = [{"frequency_hz": 349, "file": "clip.wav"}]
        with wave.open(str(Path(path).parent / "clip.wav"), "wb") as file:
            file.setparams((1, 2, RATE, 0, "NONE", ""))
            file.writeframes(clip().astype("<i2").tobytes())
    Path(path).write_text(json.dumps(protocol))
    print(len(own["values"]) * 2 * 5)
    return 0


def plan(physvib: str, what: str, path: str) -> int:
    if what in OWN:
        return plan_own(what, path)
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
    """What the call says; of a world with hands how long it moved, as its saved session says, which ends when the last of it was felt."""
    if told := re.search(r"--seconds ([0-9.]+)", call):
        return float(told[1])
    log = next(word for word in call.split() if word.endswith(".json"))
    return sum(take["world_end_s"] - take["start_s"] for take in json.loads((Path(folder) / log).read_text())["takes"])


def decibels(ratio: float) -> float:
    return 20.0 * math.log10(max(ratio, 1e-12))


def compare(physvib: str, what: str, folder: str, raw: str) -> int:
    recording = Path(raw).read_bytes()
    samples, off_render = np.frombuffer(recording, dtype=np.float32), 0.0
    rows = list(csv.DictReader(line for line in (Path(folder) / "short-P01.csv").read_text().splitlines() if not line.startswith("#")))
    count = len(OWN[what]["values"]) if what in OWN else 27 if what == "falls" else 8
    expect(len(rows) == count, f"expected {count} conditions, found {len(rows)} rows")
    at, peaks, worst_peak, worst_rms, parts, off, contacts = 0, {}, 0.0, 0.0, 0, 0.0, {}
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
            if what in OWN:
                found, share = found_near(samples, at // 4, np.frombuffer(wanted, dtype=np.float32))
                found, off_render = 4 * found if share <= 1e-5 else -1, max(off_render, share)
            else:
                found = recording.find(wanted, at)
            while found >= 0 and found % 4:
                found = recording.find(wanted, found + 1)
            if found < 0:
                expect(False, f"{words} {name}: its log does not render the samples that were recorded")
                continue
            at = found + len(wanted)
            played = array.array("f", recording[found:at])
            peak = max(abs(s) for s in played) * FULL_SCALE_G
            seconds = seconds_of(folder, call)
            rms = math.sqrt(sum(s * s for s in played) / (seconds * RATE)) * FULL_SCALE_G
            parts += 1
            worst_peak = max(worst_peak, abs(float(peak_g) / peak - 1.0))
            expect(abs(float(peak_g) / peak - 1.0) <= 0.01, f"{words} {name}: the row says {peak_g} g, {peak:.5f} g were recorded")
            worst_rms = max(worst_rms, abs(float(rms_g) / rms - 1.0))
            # The row's time begins and ends with pictures, up to 50 ms off where the machine is busy: that is much of a short vibration.
            expect(abs(float(rms_g) / rms - 1.0) <= max(0.02, 0.025 / seconds),
                   f"{words} {name}: the row says {rms_g} g (root mean square), {rms:.5f} g were recorded")
            if what in OWN:
                value = words if name == "varied" else OWN[what]["otherwise"]
                share, own_peak = off_numpy(what, value, np.frombuffer(played, dtype=np.float32).astype(float) * FULL_SCALE_G)
                off = max(off, share)
                expect(share <= 1e-5, f"{words} {name}: the samples are {share:.2g} of the peak off numpy's")
                expect(abs(float(peak_g) / own_peak - 1.0) <= 0.01, f"{words} {name}: the row says {peak_g} g, numpy {own_peak:.5f} g")
                contacts[value] = own_peak
            if what == "falls":
                expect(peak < FULL_SCALE_G, f"{words} {name}: full scale")
                peaks[(name, *words.rsplit(" height=", 1))] = peak
    worst_distance = 0.0
    if what == "clip":
        for height, peak in contacts.items():
            error = abs(decibels(peak / contacts["1"]) - 10.0 * math.log10(float(height)))
            worst_distance = max(worst_distance, error)
            expect(error <= 0.1, f"{height} m against 1 m is {error:.3f} dB off Eq. 5.4")
    for (name, kind, height), peak in peaks.items():
        error = abs(decibels(peak / peaks[(name, kind, "1")]) - 10.0 * math.log10(float(height)))
        worst_distance = max(worst_distance, error)
        expect(error <= 0.1, f"{kind} {name}: {height} m against 1 m is {error:.3f} dB off Eq. 5.4")
    exact = f"within {off_render:.2g} of the peak of their calls and {off:.2g} of numpy's samples" if what in OWN else "to the bit of their logs"
    print(f"{what}: {parts} parts of {len(rows)} conditions recorded {exact}; rows against samples: peak within {100 * worst_peak:.3f} %, "
          f"root mean square within {100 * worst_rms:.2f} %" + (f"; falls within {worst_distance:.3f} dB of Eq. 5.4" if peaks or what == "clip" else "")
          + "; limiter at 0 dB" * (not bad))
    for words in bad:
        print(words)
    return 1 if bad else 0


sys.exit(plan(*sys.argv[2:]) if sys.argv[1] == "plan" else compare(*sys.argv[2:]))
