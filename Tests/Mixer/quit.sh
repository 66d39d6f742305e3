#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# quit.sh [MIXER] [BODIES]: how long the mixer takes to end after Ctrl+Q, with so many bodies (2,000) in one place, whose every step is
# late; on a display of its own. It tells the seconds; a script, since no test asserts a time.
set -eu
mixer=${1:-build/release/bin/physvib-mixer} bodies=${2:-2000}
command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || { echo "needs the packages xvfb, xauth and xdotool" >&2; exit 1; }
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$mixer" "$bodies"
fi
folder=$(mktemp -d)
pid=""
trap 'test -z "$pid" || kill -9 "$pid" 2>/dev/null || :; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder"
awk -v bodies="$bodies" 'BEGIN {
    printf "{\"physvib_scene\": 1, \"name\": \"heap\", \"field_m\": [4, 2], \"materials\": [{\"name\": \"wood\", \"density_kg_per_m2\": 850, "
    printf "\"friction\": 0.4, \"restitution\": 0.6, \"frequency_hz\": 80, \"decay_per_s\": 30}], \"bodies\": ["
    for (k = 0; k < bodies; ++k)
        printf "%s{\"name\": \"b%d\", \"position_m\": [2, 1], \"fixtures\": [{\"shape\": \"circle\", \"radius_m\": 0.2, \"material\": \"wood\", \"camera\": true}]}", k ? ",\n" : "", k
    print "]}"
}' >"$folder/heap.json"
now() { date +%s.%N; }
for wait_s in 0.5 2 5; do
    "$mixer" "$folder/heap.json" --device "None:no device" &
    pid=$!
    until xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.05; done
    sleep "$wait_s"
    began=$(now)
    xdotool mousemove 720 450 key ctrl+q
    status=0
    wait "$pid" || status=$?
    pid=""
    awk -v from="$began" -v to="$(now)" -v after="$wait_s" -v status="$status" 'BEGIN { printf "Ctrl+Q %s s after the window came: over in %.2f s, exit code %d\n", after, to - from, status }'
done
