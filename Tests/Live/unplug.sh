#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A JACK server dies under a live session and comes back with another rate, block and fewer outputs; passes if the
# session tells it, waits, goes on, and ends without a crash and without a lost collision.
# Usage: unplug.sh BIN_FOLDER
set -eu
physvib=$1/physvib
. "$(dirname "$0")/jack.sh"
expect() { # WORDS: within ten seconds
    for _ in $(seq 100); do grep -q "$1" "$folder/told" && return; sleep 0.1; done
    echo "never told: $1" >&2
    cat "$folder/told" >&2
    return 1
}

serve 48000 512 8
"$physvib" play shake-the-box --device JACK:system --seconds 6 --save "$folder/session.json" >"$folder/report" 2>"$folder/told" &
playing=$!
sleep 3
kill -9 "$server"
expect "JACK:system has stopped; it is looked for every second"
serve 44100 128 2
expect "2 of 4 actuators have no output there"
wait "$playing"
playing=
cat "$folder/report" "$folder/told"
grep -q "opened again: 1 times" "$folder/told"
grep -q " 0 dropped, 0 refused" "$folder/report"
"$physvib" render "$folder/session.json" --events "$folder/again.csv" >/dev/null
rows "$folder/session.events.csv" >"$folder/played"
played=$(wc -l <"$folder/played")
[ "$played" -gt 60 ]
rows "$folder/again.csv" | head -n "$played" | cmp - "$folder/played"
echo "events: $((played - 1)) played as rendered again, none missing"
