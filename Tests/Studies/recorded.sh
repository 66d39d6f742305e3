#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# recorded.sh BIN_FOLDER [STUDY...]: falls, boxes, frequency, decay and clip: all 27 conditions of model-or-sound, both alternatives, and the eight methods of eight-methods with three
# objects each, felt by a scripted participant of the mixer through JACK and recorded there. The rows are compared with the recorded samples: g
# within 1 %, root mean square within 2 %, differences between falls of 1, 2 and 3 m within 0.1 dB of Eq. 5.4, limiter at
# 0 dB, every log renders the samples that were recorded. Three studies of one's own are compared with numpy's samples too.
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
