#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# screens.sh [BIN_FOLDER] [FOLDER] [STUDY...]: what a participant sees of the built-in studies in a window with a
# title bar, on displays of 1280 x 720 and 1440 x 900, as pictures in FOLDER to be looked at. The window manager is
# openbox, hands are xdotool's. The study `whole` is taken from its begin to its end, by pointer and keys, with a break,
# a kill, a resume and a closed window, and its rows and times are checked. A script, since only eyes can judge it; about ten minutes for all.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "${1:-build/release/bin}" && pwd) out=${2:-$(mktemp -d)}
[ $# -lt 2 ] || shift 2
. "$here/../../.ci/packages.sh"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_screens_packages
mkdir -p "$out"
for size in 1280x720 1440x900; do
    PHYSVIB_DISPLAY=$size "$here/../Mixer/Window/with-display.sh" "$here/screens.py" "$bin" "$out" "$@"
done
echo "pictures in $out"
