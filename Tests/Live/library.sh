#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The library's door to a device, from Python, on a JACK server of its own: what a JACK client records is to be, to the bit, what
# `render` makes of the same strikes, but for breaks that the server's own xruns explain.
# Usage: library.sh ROOT LIBPHYSVIB_LIVE BIN_FOLDER SECONDS
set -eu
root=$1 library=$2 bin=$3 seconds=$4
here=$(dirname "$(realpath "$0")")
. "$here/jack.sh"
serve 48000 256 8

"$bin/physvib-jack-recorder" "$folder/live.raw" 4 "$((seconds + 4))" >"$folder/ready" &
recording=$!
for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
PYTHONPATH="$root/Source/Api/Python" PYTHONDONTWRITEBYTECODE=1 PHYSVIB_LIVE_LIBRARY="$library" \
    PHYSVIB_LIBRARY="$(dirname "$library")/libphysvib.so.0" /usr/bin/python3 "$here/library.py" "$folder/expected.raw" "$seconds"
wait "$recording"
"$bin/physvib-compare-recording" "$folder/live.raw" "$folder/expected.raw" 4 256 "$(sed -n 's/xruns //p' "$folder/ready")" >"$folder/report" || {
    cat "$folder/report"
    exit 1
}
cat "$folder/report"
set -- $(sed -n 's/recording: \([0-9]*\) of \([0-9]*\) blocks .*/\1 \2/p' "$folder/report")
[ $(($1 * 2)) -gt "$2" ] # a break is one that ends
