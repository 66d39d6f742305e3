#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Milliseconds from Esc, or a press on SILENCE, to zero at a JACK port, in every menu, list and dialog that the
# walk of StopWalkTest.cpp finds in the mixer, while a tone sounds. On a display, as with-display.sh makes one of
# 1600x960. Fails if one of them is later than 150 ms and what the mixer's threads have waited for a processor meanwhile;
# the walk fails where something does not silence.
# Usage: stop-walk.sh BIN_FOLDER
set -eu
bin=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
display=${DISPLAY:?needs a display}
. "$here/../Live/jack.sh"
cd "$folder"
serve 48000 256 8
"$bin/physvib-jack-silence" 4 >heard & playing=$!
while :; do
    python3 "$here/osc.py" 9000 say /physvib/strike sfsfsfsfss \
        frequency_hz 205 decay_per_s 0 seconds 1.5 level 0.3 law equal
done >/dev/null 2>&1 & playing="$playing $!"
failed=0
DISPLAY="$display" PHYSVIB_STOP_DEVICE=JACK:system "$bin/physvib-mixer-stop-walk" >walked || failed=1
grep -Ev '^(stop|over) ' walked || true
sleep 0.3
python3 - heard walked <<'LATE' || failed=1
import re, statistics, sys
heard = [(int(ms), what) for what, ms in (line.split() for line in open(sys.argv[1]))]
ms, mute, waited = [], 0, 0
for line in open(sys.argv[2]):
    if over := re.match(r"over (\d+)", line):
        if ms and len(ms[-1]) == 2: ms[-1] += (int(over[1]) - waited,)
        waited = int(over[1])
    if not (asked := re.match(r"stop (\d+) (.*)", line)): continue
    at = int(asked[1])
    if [what for when, what in heard if when < at - 5][-1:] != ["sound"]:
        mute += 1 # no device, a strip that is muted, a scene that has just begun
        continue
    zeros = [when for when, what in heard if what == "silent" and when >= at - 5]
    ms.append(((zeros or [10**13])[0] - at, asked[2]))
if not ms: sys.exit("nothing sounded")
late = [row for row in ms if row[0] > 150 + (row[2:] or (0,))[0]]
print(f"{len(ms)} stops while a tone sounded ({mute} without): to zero at the port",
      f"{statistics.median(row[0] for row in ms):.0f} ms (median), {max(ms)[0]} ms at most; {sum(sum(row[2:]) for row in ms)} ms waited for a processor")
for row in late: print("late:", *row)
sys.exit(1 if late else 0)
LATE
exit "$failed"
