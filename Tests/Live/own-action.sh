#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How long after one's own push the hit is heard, with the thread driver and blocks of 64 frames, through a JACK server
# without hardware; fails if a hit is not heard exactly L after its contact.
# Usage: own-action.sh BIN_FOLDER [PUSHES]
set -eu
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER="physvib-$$" JACK_NO_AUDIO_RESERVATION=1
unset DISPLAY || true
jackd -n "$JACK_DEFAULT_SERVER" -r -S -d dummy -r 48000 -p 64 -C 0 -P 8 >"$folder/jackd.log" 2>&1 &
server=$!
stop() {
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
    rm -rf "$folder"
}
trap stop EXIT
jack_wait -w -t 20 >/dev/null 2>&1
"$1/physvib-own-action-meter" "${2:-50}"
