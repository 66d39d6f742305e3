#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays shake-the-box live into a JACK server of its own and records it with a JACK client; passes if nothing was late
# or lost and both recordings, the client's and the program's own, are the rendered file to the bit, after an integer
# alignment. (The client's is left out if the server itself had xruns.)
# Usage: live.sh PHYSVIB RECORDER SECONDS message|thread BLOCK_FRAMES [jackd options, e.g. -S (default) or -s]
set -eu
physvib=$1 recorder=$2 seconds=$3 driver=$4 block=$5 mode=${6:--S}
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER="physvib-$$" JACK_NO_AUDIO_RESERVATION=1
unset DISPLAY || true
steps=100
[ "$driver" = thread ] && steps=1000

jackd -n "$JACK_DEFAULT_SERVER" -r "$mode" -d dummy -r 48000 -p "$block" -C 0 -P 8 >"$folder/jackd.log" 2>&1 &
server=$!
stop() {
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
    rm -rf "$folder"
}
trap stop EXIT
jack_wait -w -t 20 >/dev/null 2>&1

"$recorder" "$folder/live.raw" 4 "$seconds" >"$folder/ready" &
recording=$!
for _ in $(seq 100); do grep -q ready "$folder/ready" && break; sleep 0.1; done
"$physvib" play shake-the-box --device JACK:system --driver "$driver" --steps-per-second "$steps" --level 0 \
    --seconds "$((seconds + 1))" --record "$folder/own.wav" | tee "$folder/report"
wait "$recording"
"$physvib" render shake-the-box --steps-per-second "$steps" --seconds "$seconds" --out "$folder/render.wav" >/dev/null

# Both as raw interleaved samples: the data chunk is what follows the word "data" and its length.
raw() { tail -c +"$(($(grep -abo data "$1" | head -n 1 | cut -d: -f1) + 9))" "$1"; }
raw "$folder/render.wav" >"$folder/render.raw"
raw "$folder/own.wav" >"$folder/own.raw"

# First byte that is not zero, as a frame of four floats; the renders start with the same sound.
first() { echo $(($(cmp "$1" /dev/zero | sed 's/.*: [a-z]* \([0-9]*\),.*/\1/' ) / 16)); }
agree() {
    offset=$(($(first "$1") - $(first "$folder/render.raw")))
    frames=$(($(stat -c %s "$1") / 16 - offset))
    longest=$(($(stat -c %s "$folder/render.raw") / 16))
    [ "$frames" -gt "$longest" ] && frames=$longest
    [ "$frames" -gt $((48000 * (seconds - 1))) ] || { echo "only $frames frames recorded"; return 1; }
    tail -c +$((offset * 16 + 1)) "$1" | cmp -n $((frames * 16)) - "$folder/render.raw"
    echo "$2: $frames frames bit-equal to the render, $offset frames later"
}
agree "$folder/own.raw" "own recording"
xruns=$(sed -n 's/.*, \(-*[0-9]*\) xruns of the device/\1/p' "$folder/report")
if [ "$xruns" = 0 ]; then
    agree "$folder/live.raw" "JACK client"
else # blocks that the server itself skipped are in no recording of its clients
    echo "JACK client: not compared, the server had $xruns xruns"
fi
grep -q " 0 late, 0 dropped, 0 refused" "$folder/report"
