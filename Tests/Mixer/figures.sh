#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# figures.sh [BUILD]: pictures a second, share of a core and time from a click to its picture, with 10 and 2,000 bodies in a box, on a display
# of its own. For Docs/mixer.md; no test, since other programs share the machine.
set -eu
build=${1:-build/release}
program=$build/bin/physvib-mixer-big-world
[ -x "$program" ] || { echo "needs $program: cmake --build $build --target physvib-mixer-big-world" >&2; exit 1; }
for bodies in 10 2000; do
    echo "load average $(cut -d" " -f1-3 /proc/loadavg)"
    "$(dirname "$0")/Window/with-display.sh" "$program" "$bodies" --spread
done
