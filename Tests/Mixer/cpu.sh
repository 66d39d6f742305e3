#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# cpu.sh [MIXER]: what the mixer costs on this machine, in shares of one core, and how fast it starts: on a display of its
# own, drawn in software. For Docs/mixer.md; no test, since other programs share the machine.
set -eu
mixer=${1:-build/release/bin/physvib-mixer}
command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || { echo "needs the packages xvfb, xauth and xdotool" >&2; exit 1; }
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$mixer"
fi
folder=$(mktemp -d)
export XDG_CONFIG_HOME="$folder"
started=$(date +%s%N)
"$mixer" --device "None:no device" &
pid=$!
trap 'kill "$pid" 2>/dev/null || :; rm -rf "$folder"' EXIT
until xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.01; done
shown=$(date +%s%N)
echo "window after $(((shown - started) / 1000000)) ms"

# share SECONDS WORDS: of one core, of the process and of each of its threads together
share() {
    before=$(awk '{print $14 + $15}' "/proc/$pid/stat")
    sleep "$1"
    after=$(awk '{print $14 + $15}' "/proc/$pid/stat")
    awk -v t=$((after - before)) -v hz="$(getconf CLK_TCK)" -v s="$1" -v what="$2" 'BEGIN { printf "%s: %.1f %% of one core\n", what, 100 * t / hz / s }'
}
sleep 3
share ${SECONDS_EACH:-20} "moving world, 60 pictures of it a second, 1440 x 900"
xdotool mousemove 720 450 key space
sleep 4
share ${SECONDS_EACH:-20} "at rest: the world stands still, nothing rings"
