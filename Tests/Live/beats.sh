#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A song of known onsets played into the inputs of `physvib play --beats` on a JACK server without hardware, and what is felt of it
# recorded: passes if 95 % of the high beats are felt within 10 ms of L after them (and the cycle of JACK's loop) and half of them within
# 2 ms, none late, and if the saved session renders the same beats.
# Usage: beats.sh BIN_FOLDER [SECONDS (12) [message|thread]]
set -eu
bin=$1 seconds=${2:-12} driver=${3:-thread}
. "$(dirname "$0")/jack.sh"
serve 48000 256 2
"$bin/physvib-jack-song" 4 "$seconds" 7 >"$folder/beats" &
song=$!
playing=$song
for _ in $(seq 100); do grep -qs ready "$folder/beats" && break; sleep 0.1; done
"$bin/physvib" play "$(dirname "$0")/../../Standalone/Examples/quiet.json" --device JACK:song --beats 1 --driver "$driver" --steps-per-second 1000 \
    --level 0 --seconds $((seconds + 30)) --save "$folder/felt.json" --record "$folder/felt.wav" >"$folder/out" 2>"$folder/err" &
physvib=$!
playing="$song $physvib"
wait "$song" || true # when the song is over
kill -INT "$physvib"
wait "$physvib" || { cat "$folder/out" "$folder/err"; exit 1; }
cat "$folder/out"
python3 - "$folder/beats" "$folder/out" <<'PYTHON'
import re, sys
told = open(sys.argv[2]).read()
play_out = float(re.search(r"output latency ([0-9.]+) ms", told).group(1)) * 1e-3
late = int(re.search(r"left, ([0-9]+) late", told).group(1))
cycle = 256 / 48000
rows = [tuple(map(float, line.split())) for line in open(sys.argv[1]) if line[0].isdigit()]
errors = [felt - hit - play_out - cycle for hit, felt in rows]
near = sum(abs(e) <= 0.010 for e in errors)
errors.sort()
offset = sorted(abs(e) for e in errors)[len(errors) // 2] # of what is recorded a beat's own rise is a millisecond
print(f"{near} of {len(rows)} high beats felt within 10 ms of L, {1e3 * play_out:.1f} ms, after they sounded; median {1e3 * errors[len(errors) // 2]:+.2f} ms, "
      f"half of them within {1e3 * offset:.2f} ms; {late} late")
sys.exit(near < 0.95 * len(rows) or offset > 0.002 or late > 0 or len(rows) < 10)
PYTHON
"$bin/physvib" render "$folder/felt.json" --events "$folder/again.csv" --out "$folder/again.wav" >/dev/null 2>&1
[ "$(rows "$folder/felt.events.csv" | wc -l)" = "$(rows "$folder/again.csv" | wc -l)" ]
