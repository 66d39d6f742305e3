#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays shake-the-box live through ALSA: a null device with a clock (PacedAlsa.cpp) that writes to a file what a sound
# card would get; passes if nothing was late or lost and the file is the rendered one to the bit.
# Usage: alsa.sh BIN_FOLDER PACED_ALSA_LIBRARY SECONDS
set -eu
bin=$1 paced=$2 seconds=$3
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER=none
unset DISPLAY || true
trap 'rm -rf "$folder"' EXIT
cat >"$folder/.asoundrc" <<END
pcm.hands {
    type file
    slave.pcm { type null }
    file "$folder/live.raw"
    format raw
    hint { show on description "Hands" }
}
END
"$bin/physvib" devices | tee "$folder/devices"
grep -q "^ALSA:Hands " "$folder/devices"
LD_PRELOAD="$paced" "$bin/physvib" play shake-the-box --device ALSA:Hands --driver message --level 0 --seconds "$seconds" | tee "$folder/report"
"$bin/physvib" render shake-the-box --rate 44100 --seconds "$seconds" --out "$folder/render.wav" >/dev/null
tail -c +"$(($(grep -abo data "$folder/render.wav" | head -n 1 | cut -d: -f1) + 9))" "$folder/render.wav" >"$folder/render.raw"
# The device is faded out before it is closed: its last two blocks are not the render's.
head -c -$((2048 * 4 * 4)) "$folder/live.raw" >"$folder/felt.raw"
"$bin/physvib-compare-recording" "$folder/felt.raw" "$folder/render.raw" 4 64 0
grep -q " 0 late, 0 dropped, 0 refused" "$folder/report"
