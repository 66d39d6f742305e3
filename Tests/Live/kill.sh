#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Kills a live session with inputs after some seconds; passes if what it had saved renders again, with every input and
# event up to the last second before.
# Usage: kill.sh BIN_FOLDER
set -eu
physvib=$1/physvib
. "$(dirname "$0")/jack.sh"
serve 48000 512 8

mkfifo "$folder/inputs"
"$physvib" play shake-the-box --device JACK:system --seconds 60 --save "$folder/session.json" --listen <"$folder/inputs" &
playing=$!
exec 3>"$folder/inputs"
for i in 1 2 3 4 5 6; do
    sleep 1
    printf '{"input": "tilt", "angle_rad": 0.%s}\n' "$i" >&3
    printf '{"control": "gain", "channel": 1, "value": 0.%s}\n' "$i" >&3
done
kill -9 "$playing"
wait "$playing" 2>/dev/null || true
playing=
exec 3>&-

"$physvib" render "$folder/session.json" --out "$folder/again.wav" --events "$folder/again.csv" >/dev/null
seconds=$(sed -n 's/^{ "seconds": \([0-9]*\).*/\1/p' "$folder/session.json" | tail -n 1)
inputs=$(grep -c '"tilt", "angle_rad": 0.[1-9] }' "$folder/session.json")
gains=$(grep -c '"gain"' "$folder/session.json")
rows "$folder/session.events.csv" >"$folder/played"
played=$(wc -l <"$folder/played")
rows "$folder/again.csv" | head -n "$played" | cmp - "$folder/played"
echo "killed: $seconds s, $inputs inputs, $gains controls, $((played - 1)) events on disk; rendered again as played"
[ "$seconds" -ge 4 ] && [ "$inputs" -ge 4 ] && [ "$gains" -ge 4 ] && [ "$played" -gt 20 ]
