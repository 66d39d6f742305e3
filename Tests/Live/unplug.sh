#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A JACK server dies under a live session and comes back with another rate, block and fewer outputs; passes if the
# session tells it, waits, goes on, and ends without a crash and without a lost collision.
# Usage: unplug.sh BIN_FOLDER
set -eu
physvib=$1/physvib
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER="physvib-$$" JACK_NO_AUDIO_RESERVATION=1
unset DISPLAY || true
server= playing=
stop() {
    for process in $playing $server; do kill "$process" 2>/dev/null || true; done
    wait 2>/dev/null || true
    rm -rf "$folder"
}
trap stop EXIT
serve() {
    jackd -n "$JACK_DEFAULT_SERVER" -r -S -d dummy -r "$1" -p "$2" -C 0 -P "$3" >>"$folder/jackd.log" 2>&1 &
    server=$!
    jack_wait -w -t 20 >/dev/null 2>&1
}
expect() { # WORDS: within ten seconds
    for _ in $(seq 100); do grep -q "$1" "$folder/told" && return; sleep 0.1; done
    echo "never told: $1" >&2
    cat "$folder/told" >&2
    return 1
}

serve 48000 512 8
"$physvib" play shake-the-box --device JACK:system --seconds 6 >"$folder/report" 2>"$folder/told" &
playing=$!
sleep 3
kill -9 "$server"
expect "no such device (see physvib devices); nothing else is played on"
serve 44100 128 2
expect "2 of 4 enchanters have no output there"
wait "$playing"
playing=
cat "$folder/report" "$folder/told"
grep -q "opened again: 1 times" "$folder/told"
grep -q " 0 dropped, 0 refused" "$folder/report"
"$physvib" render shake-the-box --seconds 5.9 --events "$folder/all.csv" >/dev/null
made=$(grep -c '^[0-9]' "$folder/all.csv")
played=$(sed -n 's/.*; \([0-9]*\) collisions played.*/\1/p' "$folder/report")
[ "$played" -ge "$made" ] || { echo "only $played of $made collisions were played"; exit 1; }
