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
