#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays sums that would hold a coil at nearly direct current (guard_sums.py) into a JACK server without hardware at --level 0,
# renders what was saved, and prints the worst mean over 250 ms and the worst rms below 5 Hz at the port and in the render,
# and over 1,000 random hostile lists. Fails if one exceeds 0.05 of full scale.
# Usage: guard.sh BIN_FOLDER [NUMBER...]: all sums unless told; FIGURES: another build's physvib-guard-figures.
set -eu
bin=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
figures=${FIGURES:-$bin/physvib-guard-figures}
. "$here/../Live/jack.sh"
cd "$folder"
python3 "$here/guard_sums.py" . "$here/../../Source/Scene/Scenes/shake-the-box.json"
failed=0
# measured FILE.raw: "mean rms peak", and the verdict's letter.
measured() { "$figures" "$1" 4 48000 && return; failed=$((failed + 1)); }
serve 48000 256 8
printf '%-40s %-22s %-22s\n' 'mean, rms below 5 Hz, peak' 'at the port' 'in the render'
for number in ${*:-$(ls -- *.name | cut -d. -f1)}; do
    name=$(cat "$number.name") arguments=$(cat "$number.arguments")
    case $arguments in slow.json) scene=slow.json arguments= ;; *) scene=$here/../../Standalone/Examples/quiet.json ;; esac
    "$bin/physvib-jack-recorder" live.raw 4 7 >ready &
    recording=$!
    for _ in $(seq 100); do grep -qs ready ready && break; sleep 0.1; done
    # shellcheck disable=SC2086 # an option and its value
    { cat "$number.lines"; sleep 9; } | "$bin/physvib" play "$scene" --listen --clips . $arguments --device JACK:system --level 0 \
        --seconds 8 --save session.json >report 2>&1 || { cat report; exit 1; }
    wait "$recording"
    "$bin/physvib" render session.json --seconds 7 --out render.wav >/dev/null 2>&1
    raw render.wav >render.raw
    measured live.raw >port
    case $arguments in *off*) echo 'raw' >render ;; *) measured render.raw >render ;; esac
    grep -q 'turned down' report && told=told || told=
    printf '%-40s %-22s %-22s %s\n' "$name" "$(cat port)" "$(cat render)" "$told"
done
[ $# -gt 0 ] || "$figures" lists 1000 || failed=$((failed + 1))
[ "$failed" = 0 ] || { echo "$failed exceed 0.05"; exit 1; }
