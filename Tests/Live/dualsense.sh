#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A sound device that is called as a DualSense's: found by its name, played on channels 3 and 4 alone, refused where its profile hides them.
# Usage: dualsense.sh BIN_FOLDER
set -eu
bin=$1
physvib=$bin/physvib
. "$(dirname "$0")/jack.sh"
serve 48000 256 2

# coils INPUTS: the device, until close_coils, after which four peaks are the last line of "ready".
coils() {
    rm -f "$folder/hold" "$folder/ready"
    mkfifo "$folder/hold"
    "$bin/physvib-jack-coils" "DualSense Wireless Controller Analog" "$1" <"$folder/hold" >"$folder/ready" &
    playing=$!
    exec 9>"$folder/hold"
    for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
}
close_coils() {
    exec 9>&-
    wait "$playing"
    playing=
}

coils 4
"$physvib" play shake-the-box --device dualsense --layout dualsense --level 0 --seconds 3 >"$folder/out" 2>"$folder/err" || { cat "$folder/err"; exit 1; }
close_coils
peaks=$(tail -n 1 "$folder/ready")
echo "peaks of the four channels: $peaks"
echo "$peaks" | awk '{ exit !($1 == 0 && $2 == 0 && $3 > 0.02 && $4 > 0.02) }'
grep -q "DualSense" "$folder/err" # no controls of one are here: said, and no reason not to play

sleep 1
coils 2
if "$physvib" play shake-the-box --device dualsense --layout dualsense --seconds 1 2>"$folder/err"; then exit 1; fi
cat "$folder/err"
grep -q "expected four outputs, found 2" "$folder/err"
close_coils
