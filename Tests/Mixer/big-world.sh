#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# big-world.sh [BODIES] [BUILD]: what the mixer's window does with so many bodies (2,000) in one place, on a display of its own: when it shows
# them, when it says that they are too much, how it draws meanwhile, and how long it takes to end; in seconds, and in processor time. For
# Docs/mixer.md; no test, since other programs share the machine.
set -eu
bodies=${1:-2000} build=${2:-build/release}
program=$build/bin/physvib-mixer-big-world
[ -x "$program" ] || { echo "needs $program: cmake --build $build --target physvib-mixer-big-world" >&2; exit 1; }
echo "load average $(cut -d" " -f1-3 /proc/loadavg)"
exec "$(dirname "$0")/Window/with-display.sh" "$program" "$bodies"
