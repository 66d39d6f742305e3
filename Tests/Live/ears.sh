#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Each hit in loudspeakers beside the actuators, on a JACK server without hardware: how many frames lie between ear and hand, and what left and
# right get of hits to the left and right, by `play` and by the library. Usage: ears.sh LIBPHYSVIB_LIVE BIN_FOLDER PYTHON_FOLDER
set -eu
library=$1 bin=$2 python=$3 here=$(dirname "$(realpath "$0")")
. "$here/jack.sh"
export PHYSVIB_LIVE_LIBRARY="$library" PHYSVIB_LIBRARY="$(dirname "$library")/libphysvib.so.1" PYTHONPATH="$python"
serve 48000 256 8

# heard NAME PROGRAM...: while it plays for some seconds
heard() {
    name=$1
    shift
    "$bin/physvib-jack-recorder" "$folder/live.raw" 6 3 >"$folder/ready" &
    recording=$!
    playing=$recording
    for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
    "$@" >"$folder/said" 2>&1 || { cat "$folder/said"; exit 1; }
    wait "$recording"
    /usr/bin/python3 "$here/ears.py" judge "$folder/live.raw" "$name"
}
heard "play --contact-sound 5,6" "$bin/physvib" play shake-the-box --device JACK:system --level 0 --contact-sound 5,6 --contact-sound-db 0 --seconds 4
heard "Live(sound_output=4)" /usr/bin/python3 "$here/ears.py" play 4
