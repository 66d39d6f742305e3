#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# cpu.sh [MIXER]: what the mixer costs on this machine, in shares of one core and in wakings of its threads a second, and how fast it starts:
# on a display of its own, drawn in software, moving, paused, and minimised; beside it a window that shows nothing. For Docs/mixer.md; no test, since other programs share the machine.
set -eu
mixer=${1:-build/release/bin/physvib-mixer}
for program in xvfb-run xdotool openbox; do
    command -v "$program" >/dev/null || { echo "needs the packages xvfb, xauth, xdotool and openbox" >&2; exit 1; }
done
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$mixer"
fi
openbox >/dev/null 2>&1 & # without one, nothing is minimised
manager=$!
folder=$(mktemp -d)
export XDG_CONFIG_HOME="$folder"
started=$(date +%s%N)
"$mixer" --device "None:no device" &
pid=$!
trap 'kill "$pid" "$manager" 2>/dev/null || :; rm -rf "$folder"' EXIT
until xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.01; done
shown=$(date +%s%N)
echo "window after $(((shown - started) / 1000000)) ms"

# spent: processor time of the process, and wakings of its threads that are alive
spent() { awk '{print $14 + $15}' "/proc/$pid/stat"; }
wakings() { cat /proc/"$pid"/task/*/status 2>/dev/null | awk '/^voluntary_ctxt/ { n += $2 } END { print n }'; }

# share SECONDS WORDS: of one core, of the process and of each of its threads together
share() {
    before=$(spent) woken=$(wakings)
    sleep "$1"
    after=$(spent) now=$(wakings)
    awk -v t=$((after - before)) -v w=$((now - woken)) -v hz="$(getconf CLK_TCK)" -v s="$1" -v what="$2" \
        'BEGIN { printf "%s: %.1f %% of one core, %.0f wakings a second\n", what, 100 * t / hz / s, w / s }'
}
sleep 3
window=$(xdotool search --name "PhysVib mixer" | head -n 1)
share ${SECONDS_EACH:-20} "moving world, 60 pictures of it a second, 1440 x 900"
xdotool windowminimize "$window"
sleep 4
share ${SECONDS_EACH:-20} "moving world, minimised"
xdotool windowactivate "$window"
sleep 2
xdotool mousemove 720 450 key space
sleep 4
share ${SECONDS_EACH:-20} "at rest: the world stands still, nothing rings"
xdotool windowminimize "$window"
sleep 4
share ${SECONDS_EACH:-20} "at rest and minimised"
kill "$pid"
"$(dirname "$mixer")/physvib-mixer-big-world" 0 --empty &
pid=$!
sleep 4
share ${SECONDS_EACH:-20} "a window of JUCE that shows nothing"
