#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# soak.sh [SECONDS] [MIXER]: the mixer with two hundred bodies for ten minutes, on a display of its own, drawn in software: share of one core and memory
# ten times meanwhile, what was played, late and dropped, and the exit code. For Docs/mixer.md; no test, since it takes as long as it plays.
set -eu
seconds=${1:-600} mixer=${2:-build/release/bin/physvib-mixer}
command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || { echo "needs the packages xvfb, xauth and xdotool" >&2; exit 1; }
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$seconds" "$mixer"
fi
folder=$(mktemp -d)
pid=""
trap 'test -z "$pid" || kill "$pid" 2>/dev/null || :; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder"
awk '{ print }
     /^  "bodies": \[/ {
         for (k = 0; k < 200; ++k)
             printf "    { \"name\": \"ball %d\", \"position_m\": [%.2f, %.2f], \"fixtures\": [{ \"shape\": \"circle\", \"radius_m\": 0.1, \"material\": \"%s\" }] },\n",
                 k, 0.3 + 0.29 * (k % 20), 0.2 + 0.3 * int(k / 20), k % 3 == 0 ? "rubber" : k % 3 == 1 ? "wood" : "steel can"
     }' "$(dirname "$0")/../../Source/Scene/Scenes/shake-the-box.json" >"$folder/crowd.json"
"$mixer" "$folder/crowd.json" --device "None:no device" --summary &
pid=$!
until xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.1; done
ticks() { awk '{ print $14 + $15 }' "/proc/$pid/stat"; }
for part in $(seq 10); do
    before=$(ticks)
    sleep "$(awk "BEGIN { print $seconds / 10 }")"
    awk -v t=$(($(ticks) - before)) -v hz="$(getconf CLK_TCK)" -v s="$seconds" -v part="$part" -v kb="$(awk '/^VmRSS/ { print $2 }' "/proc/$pid/status")" \
        'BEGIN { printf "after %.0f s: %.1f %% of one core, %.1f MB\n", part * s / 10, 1000 * t / hz / s, kb / 1024 }'
done
echo "load average $(cut -d" " -f1-3 /proc/loadavg)"
xdotool mousemove 720 450 key ctrl+q
status=0
wait "$pid" || status=$?
pid=""
echo "exit code $status"
exit "$status"
