#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The LV2 plug-in of eight channels in jalv, live on a JACK server of its own, recorded by a JACK client: passes if the
# recording is what a bounce of the same state gives, to the bit, but for breaks that the server's xruns explain.
# Needs jackd2 and jalv. Usage: jalv.sh BUILD_FOLDER [SECONDS] [BLOCK_FRAMES]
set -eu
build=$1 seconds=${2:-10} block=${3:-512}
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER="physvib-$$" JACK_NO_AUDIO_RESERVATION=1 LV2_PATH="$build/plugins"
unset DISPLAY || true
jackd -n "$JACK_DEFAULT_SERVER" -r -S -d dummy -r 48000 -p "$block" -C 0 -P 8 >"$folder/jackd.log" 2>&1 &
server=$!
host=""
stop() {
    # shellcheck disable=SC2086 # none or one
    kill $host "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
    rm -rf "$folder"
}
trap stop EXIT
jack_wait -w -t 20 >/dev/null 2>&1
"$build/bin/physvib-plugin-bounce" 8 "$((seconds + 20))" "$block" "$folder/state.lv2" >"$folder/bounce.raw"
"$build/bin/physvib-jack-recorder" "$folder/live.raw" 8 "$seconds" physvib:audio_out_ >"$folder/ready" &
recording=$!
for _ in $(seq 100); do grep -q ready "$folder/ready" && break; sleep 0.1; done
sleep 1000 | jalv -x -n physvib -l "$folder/state.lv2" urn:physvib:plugin:8 >"$folder/jalv.log" 2>&1 &
host=$!
wait "$recording" || { cat "$folder/jalv.log"; exit 1; }
"$build/bin/physvib-compare-recording" "$folder/live.raw" "$folder/bounce.raw" 8 "$block" "$(sed -n 's/xruns //p' "$folder/ready")"
