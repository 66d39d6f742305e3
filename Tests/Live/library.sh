#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The library's door to a device, from another language, on a JACK server of its own: what a JACK client records is to be, to the bit, what
# `render` makes of the same strikes, but for breaks that the server's own xruns explain. Of strikes 0.02 frame later it is not, if the program writes
# that as well, as EXPECTED.later.
# Usage: library.sh LIBPHYSVIB_LIVE BIN_FOLDER SECONDS PROGRAM... - which is called with the file to write, EXPECTED, and the seconds
set -eu
library=$1 bin=$2 seconds=$3
shift 3
. "$(dirname "$(realpath "$0")")/jack.sh"
serve 48000 256 8

"$bin/physvib-jack-recorder" "$folder/live.raw" 4 "$((seconds + 4))" >"$folder/ready" &
recording=$!
playing=$recording # ends with the script, also where the program has failed
for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
PHYSVIB_LIVE_LIBRARY="$library" PHYSVIB_LIBRARY="$(dirname "$library")/libphysvib.so.1" "$@" "$folder/expected.raw" "$seconds"
wait "$recording"
compare() { "$bin/physvib-compare-recording" "$folder/live.raw" "$1" 4 256 "$(sed -n 's/xruns //p' "$folder/ready")" >"$folder/report"; }
compare "$folder/expected.raw" || {
    cat "$folder/report"
    exit 1
}
cat "$folder/report"
set -- $(sed -n 's/recording: \([0-9]*\) of \([0-9]*\) blocks .*/\1 \2/p' "$folder/report")
[ $(($1 * 2)) -gt "$2" ] # a break is one that ends
if [ -e "$folder/expected.raw.later" ]; then
    if compare "$folder/expected.raw.later"; then
        echo "the recording would be that of strikes 0.02 frame later, too"
        exit 1
    fi
    echo "strikes 0.02 frame later: $(cat "$folder/report")"
fi
