#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# recorded.sh BIN_FOLDER [STUDY...]: falls, all 27 conditions of model-or-sound, both alternatives; boxes, the eight methods of eight-methods with
# three objects each; and three studies of one's own, of frequency, decay and clip. A scripted participant of the mixer feels them through JACK, where
# they are recorded. The rows are compared with the recorded samples: g within 1 %, root mean square within 2 % (of half a second 5 %), falls from other heights within
# 0.1 dB of Eq. 5.4, limiter at 0 dB, every log renders the samples that were recorded; those of one's own are numpy's too, to 1e-5 of the peak.
# About three minutes each of the first two, less than one of the others. Needs jackd, Xvfb, python3 and numpy.
set -eu
bin=$1
shift
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../Live/jack.sh"

for what in ${*:-falls boxes frequency decay clip}; do
    serve 48000 256 8
    rows="$folder/$what"
    mkdir "$rows"
    seconds=$("$here/recorded.py" plan "$bin/physvib" "$what" "$rows/short.json")
    "$bin/physvib-jack-recorder" "$folder/$what.raw" 1 "$seconds" >"$folder/ready" &
    recording=$!
    playing=$recording
    "$here/../Mixer/Window/with-display.sh" "$bin/physvib-studies-recorded" "$rows" "$rows/short.json" JACK:system
    wait "$recording"
    playing=
    echo "$what: $(grep xruns "$folder/ready") of the server"
    "$here/recorded.py" compare "$bin/physvib" "$what" "$rows" "$folder/$what.raw"
    close_server
done
