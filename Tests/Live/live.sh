#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays shake-the-box live into a JACK server of its own and records it with a JACK client; passes if nothing was late
# or lost, the saved session, rendered again, gives the events that were played, the program's own recording is that
# render to the bit after an integer alignment, and so is the client's, but for breaks of which there are no more than the server reports xruns.
# Usage: live.sh BIN_FOLDER SECONDS message|thread BLOCK_FRAMES [jackd mode: -S, synchronous (default), or -s]
set -eu
bin=$1 seconds=$2 driver=$3 block=$4 mode=${5:--S}
physvib=$bin/physvib
. "$(dirname "$0")/jack.sh"
steps=100
[ "$driver" = thread ] && steps=1000

serve 48000 "$block" 8 "$mode"

"$bin/physvib-jack-recorder" "$folder/live.raw" 4 "$seconds" >"$folder/ready" &
recording=$!
for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
"$physvib" play shake-the-box --device JACK:system --driver "$driver" --steps-per-second "$steps" --level 0 \
    --seconds "$((seconds + 1))" --record "$folder/own.wav" --save "$folder/session.json" | tee "$folder/report"
wait "$recording"
"$physvib" render "$folder/session.json" --seconds "$seconds" --out "$folder/render.wav" --events "$folder/render.csv" >/dev/null

# Those played in the last L of the session are in the render only.
rows "$folder/session.events.csv" >"$folder/played"
rows "$folder/render.csv" >"$folder/rendered"
common=$(($(wc -l <"$folder/played") < $(wc -l <"$folder/rendered") ? $(wc -l <"$folder/played") : $(wc -l <"$folder/rendered")))
[ "$common" -gt "$seconds" ]
head -n "$common" "$folder/played" >"$folder/a"
head -n "$common" "$folder/rendered" | cmp - "$folder/a"
echo "events: $((common - 1)) played as rendered again"

own_is_render $((48000 * (seconds - 1)))
"$bin/physvib-compare-recording" "$folder/live.raw" "$folder/render.raw" 4 "$block" "$(sed -n 's/xruns //p' "$folder/ready")"
grep -q " 0 late, 0 dropped, 0 refused" "$folder/report"
ahead=$(sed -n 's|.*own.wav  begins at session time -\([0-9.]*\) s.*|\1|p' "$folder/report" | awk '{ printf "%d", 48000 * $1 + 0.5 }')
[ "$offset" = "$ahead" ] || { echo "own.wav begins $ahead frames before session time 0, by what is printed; it is the render's $offset frames later"; exit 1; }
begins=$(sed -n 's|.*own.wav  \(begins at session time -0\.\)|\1|p' "$folder/report") # felt the play-out delay after it happens
[ -n "$begins" ] && grep -qaF "$begins" "$folder/own.wav"
