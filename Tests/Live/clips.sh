#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Clips as messages into a live session on a JACK server without hardware: what the program recorded of itself is the saved session, rendered
# again, to the bit; files elsewhere are refused; and so is the session, in one line, when a clip has changed since.
# Usage: clips.sh BIN_FOLDER SCENE.json
set -eu
physvib=$1/physvib scene=$2
. "$(dirname "$0")/jack.sh"
serve 48000 512 4

mkdir -p "$folder/clips/more"
python3 - "$folder" <<'PYTHON'
import json, math, struct, sys, wave
folder = sys.argv[1]
for name in ("clips/knock.wav", "outside.wav"):
    with wave.open(f"{folder}/{name}", "wb") as knock:
        knock.setparams((1, 2, 44100, 0, "NONE", ""))
        knock.writeframes(b"".join(struct.pack("<h", int(16000 * math.sin(0.03 * n) * math.exp(-n / 4000))) for n in range(13230)))
frames = [{"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 150}, {"relative_position": 300, "amplitude_modulation": 0}]
band = {"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "keyframes": frames}]}
json.dump({"perceptions": [{"perception_modality": "Vibrotactile", "channels": [{"bands": [band]}]}]}, open(f"{folder}/clips/more/pulse.hjif", "w"))
PYTHON
cat >"$folder/lines" <<'LINES'
{"message": "clip", "file": "knock.wav", "place": "A"}
{"message": "clip", "file": "more/pulse.hjif", "level": 0.5, "in": 0.1}
{"message": "strike", "frequency_hz": 205, "decay_per_s": 20, "place": "D", "in": 0.2}
{"message": "clip", "file": "knock.wav", "law": "energy", "in": 0.8}
{"message": "clip", "file": "../outside.wav"}
LINES
"$physvib" play "$scene" --device JACK:system --level 0 --seconds 3 --clips "$folder/clips" --listen --keep-playing --record "$folder/own.wav" --save "$folder/session.json" \
    <"$folder/lines" >"$folder/report" 2>"$folder/refused" || { cat "$folder/report" "$folder/refused"; exit 1; }
[ "$(wc -l <"$folder/refused")" -eq 1 ]
grep -q 'standard input:5: clip: file: "../outside.wav": expected a file in .* or below' "$folder/refused"
[ "$(grep -c '"hash"' "$folder/session.json")" -eq 2 ]
"$physvib" render "$folder/session.json" --seconds 3 --out "$folder/render.wav" >/dev/null
own_is_render 48000

printf ' ' >>"$folder/clips/more/pulse.hjif"
if "$physvib" render "$folder/session.json" --out "$folder/render.wav" >/dev/null 2>"$folder/refused"; then exit 1; fi
[ "$(wc -l <"$folder/refused")" -eq 1 ]
grep -q 'pulse.hjif: .*it has changed since' "$folder/refused"
