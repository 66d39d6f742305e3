#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing, builds, and renders "shake the box" into out/: four channels, an event list, a picture. With a
# display it opens the mixer as well, which plays it.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_run_packages
targets=physvib
[ -z "${DISPLAY:-}" ] || targets="physvib physvib-mixer"
# shellcheck disable=SC2086 # a list of words
build release $targets
mkdir -p out
name=out/shake-the-box
build/release/bin/physvib render shake-the-box --out $name.wav --events $name.csv --picture $name.png >build/render.log
cat <<'END'
out/shake-the-box.wav  four channels of vibration, one per enchanter: play it on a four-channel interface, one actuator each
out/shake-the-box.csv  every collision that is in it: when, where, how hard; out/shake-the-box.png is the picture to look at
Next: build/release/bin/physvib scenes; physvib render --help; your own list of hits: physvib render --from-events HITS.csv
END
[ -z "${DISPLAY:-}" ] || exec build/release/bin/physvib-mixer # the same scene, to see, to feel and to mix
