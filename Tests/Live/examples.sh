#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The worked applications under Standalone/Examples do what their pages say, on a JACK server without hardware: the saved
# session is read for what was struck.
# Usage: examples.sh BIN_FOLDER EXAMPLES_FOLDER
set -eu
bin=$1 examples=$2
. "$(dirname "$0")/jack.sh"
export PHYSVIB="$bin/physvib"
serve 48000 512 4

printf 'left 200\nright 15\nnorth\narrived\n' |
    "$examples/turn-by-turn.py" --device JACK:system --seconds 4 --save "$folder/turns.json" >"$folder/out" 2>"$folder/refused" || { cat "$folder/out" "$folder/refused"; exit 1; }
grep -q "line 3: expected left METRES, right METRES or arrived" "$folder/refused"
python3 - "$folder/turns.json" <<'PYTHON'
import json, sys
strikes = json.load(open(sys.argv[1]))["strikes"]
strikes.sort(key=lambda s: s["time_s"])
paths = [s for s in strikes if "travel_s" in s]
pulses = [s for s in strikes if s.get("spread") == "alone"]
assert [(p["x_m"], p["to_x_m"]) for p in paths[-2:]] == [(0, 2), (0, 2)], paths
assert abs(paths[-1]["time_s"] - paths[-2]["time_s"] - 0.5) < 0.3 and paths[-1]["travel_s"] == 0.4, paths
assert [(s["x_m"], s["y_m"]) for s in pulses] == [(0, 1), (2, 1), (2, 0), (0, 0)], pulses
print(f"turn-by-turn: {len(paths)} paths, {len(pulses)} pulses")
PYTHON

# Three seconds: a pulse when 1.8 are left, two at 1.2, a long one at the end.
printf 'status\nnow\n' | "$examples/presentation-timer.py" 0.05 0.03,0.02 --device JACK:system --save "$folder/timer.json" >"$folder/out" 2>"$folder/refused" || { cat "$folder/out" "$folder/refused"; exit 1; }
grep -q "4 vibrations to come" "$folder/out"
grep -q "line 2: expected again, stop or status" "$folder/refused"
python3 - "$folder/timer.json" <<'PYTHON'
import json, sys
strikes = sorted(json.load(open(sys.argv[1]))["strikes"], key=lambda s: s["time_s"])
first = strikes[0]["time_s"]
found = [(round(s["time_s"] - first, 1), s["duration_s"]) for s in strikes]
quarter = 0.25 / 205  # what is cut ends at the nearest zero crossing of its 205 Hz
assert all(abs(length - wanted) < quarter + 1e-6 for (_, length), wanted in zip(found, (0.15, 0.15, 0.15, 1.5))), found
assert all(abs(at - wanted) < 0.35 for (at, _), wanted in zip(found, (0.0, 0.6, 0.9, 1.8))), found  # each is counted from when it was said
print("presentation-timer: one, two, and a long one")
PYTHON
if "$examples/presentation-timer.py" 1 2 2>"$folder/refused"; then exit 1; fi
grep -q "expected MINUTES LEFT,LEFT" "$folder/refused"

# Four low beats and four high ones between them, half a second apart.
python3 - "$folder/song.wav" <<'PYTHON'
import math, random, struct, sys, wave
rate, noise = 48000, random.Random(1)
samples = [0.0] * (5 * rate)
for beat in range(8):
    first = int((0.5 + 0.5 * beat) * rate)
    for i in range(rate // 4):
        t = i / rate
        samples[first + i] += 0.6 * math.sin(2 * math.pi * 60 * t) * math.exp(-8 * t) if beat % 2 == 0 else 0.3 * noise.uniform(-1, 1) * math.exp(-40 * t)
with wave.open(sys.argv[1], "wb") as song:
    song.setparams((1, 2, rate, 0, "NONE", ""))
    song.writeframes(b"".join(struct.pack("<h", int(32000 * s)) for s in samples))
PYTHON
"$examples/music-rings.py" "$folder/song.wav" --device JACK:system --save "$folder/rings.json" >"$folder/out" 2>"$folder/refused" || { cat "$folder/out" "$folder/refused"; exit 1; }
[ ! -s "$folder/refused" ] || { cat "$folder/refused"; exit 1; }
python3 - "$folder/rings.json" <<'PYTHON'
import json, sys
strikes = json.load(open(sys.argv[1]))["strikes"]
low = [s for s in strikes if s["decay_per_s"] == 15]
others = sorted((s for s in strikes if s["decay_per_s"] != 15), key=lambda s: s["time_s"])
times = sorted({s["time_s"] for s in low})
corners = {(0, 0), (0, 1), (2, 0), (2, 1)}
for time in times:
    assert {(s["x_m"], s["y_m"]) for s in low if s["time_s"] == time} == corners, low
first = times[0]
for wanted in (0, 1, 2, 3):
    assert any(abs(time - first - wanted) < 0.01 for time in times), times
    assert any(abs(s["time_s"] - first - wanted - 0.5) < 0.01 for s in others), others
rounds = [(s["x_m"], s["y_m"]) for s in others]
assert set(rounds[:4]) == corners and rounds[4:8] == rounds[: len(rounds[4:8])], rounds
print(f"music-rings: {len(times)} beats for all, {len(others)} round the table")
PYTHON

# Hits at the left and at the right, as oscdump (liblo) reads what a strap would get.
if command -v oscdump >/dev/null; then
    oscdump -L 9871 >"$folder/strap" &
    strap=$!
    "$examples/vest.py" pat_left=0,0.5 pat_right=2,0.5 --from 9872 --to 127.0.0.1:9871 &
    vest=$!
    playing="$strap $vest"
    { sleep 3; for place in A B A A B A; do echo "{\"message\": \"strike\", \"material\": \"wood\", \"place\": \"$place\", \"level\": 0.8}"; sleep 0.5; done; } |
        "$bin/physvib" play "$examples/quiet.json" --device JACK:system --listen --osc-to 127.0.0.1:9872 --seconds 8 >"$folder/out" 2>&1 || { cat "$folder/out"; exit 1; }
    sleep 0.5
    kill "$vest"
    wait "$vest"
    kill "$strap"
    playing=
    python3 - "$folder/strap" <<'PYTHON'
import sys
rows = [(line.split()[-3], float(line.split()[-1])) for line in open(sys.argv[1])]
assert all(name in ("/avatar/parameters/pat_left", "/avatar/parameters/pat_right") and 0.0 <= level <= 1.0 for name, level in rows), rows
for side, most in (("left", 4), ("right", 2)):  # a busy machine drops some
    levels = [level for name, level in rows if name.endswith(side)]
    assert levels[-1] == 0.0 and 0 < sum(b > 0.0 and a == 0.0 for a, b in zip([0.0] + levels, levels)) <= most and max(levels) > 0.1, (side, levels)
print("vest: the hits at the left motor and at the right, then 0")
PYTHON
fi
