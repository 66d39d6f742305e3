#!/bin/sh
# SPDX-License-Identifier: MIT
# Renders "shake the box" into out/: four channels, an event list, a picture. It installs and builds what that takes, which is
# little; with a display it then installs and builds the rest, and opens the mixer, which plays it.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_first_packages
build first physvib-render
mkdir -p out
name=out/shake-the-box
build/first/bin/physvib-render shake-the-box --out $name.wav --events $name.csv --picture $name.png >build/render.log
cat <<'END'
out/shake-the-box.wav  four channels of vibration, one per actuator: play it on a four-channel interface
out/shake-the-box.csv  every impact in it: when, where, how hard; out/shake-the-box.png is the picture to look at
Next: build/first/bin/physvib-render --help; your own list of impacts: build/first/bin/physvib-render HITS.csv --out FELT.wav
END
[ -n "${DISPLAY:-}" ] || exit 0
say "there is a display: now the mixer, with all that it needs (a quarter of an hour on two slow cores)"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_run_packages
build release physvib physvib-mixer
exec build/release/bin/physvib-mixer # the same scene, to see, to feel and to mix
