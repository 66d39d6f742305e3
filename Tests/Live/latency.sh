#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the table of latencies in Docs/live.md, measured through JACK servers without hardware; fails if L is not kept.
# Usage: latency.sh [BIN_FOLDER] [SECONDS]
set -eu
bin=${1:-$(dirname "$0")/../../build/release/bin} seconds=${2:-6}
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER="physvib-$$" JACK_NO_AUDIO_RESERVATION=1
unset DISPLAY || true
server=
stop() {
    [ -n "$server" ] && kill "$server" 2>/dev/null && wait "$server" 2>/dev/null
    rm -rf "$folder"
}
trap stop EXIT
echo "| driver | block | L, by the law | contact to port, measured | the device's own | sum | late events |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
failed=0
for driver in message thread; do
    for block in 64 128 512; do
        jackd -n "$JACK_DEFAULT_SERVER" -r -S -d dummy -r 48000 -p "$block" -C 0 -P 8 >"$folder/jackd.log" 2>&1 &
        server=$!
        jack_wait -w -t 20 >/dev/null 2>&1
        "$bin/physvib-latency-meter" "$driver" "$seconds" || failed=1
        kill "$server"
        wait "$server" 2>/dev/null || true
        server=
    done
done
exit "$failed"
