#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Measures a simulated actuator through JACK: passes if f0 is within 0.5 %, Q within 5 %, and the profile equalises.
# Usage: calibrate.sh BIN_FOLDER
set -eu
bin=$1
physvib=$bin/physvib
. "$(dirname "$0")/jack.sh"
serve 48000 512 2
resonance=204.3 q=11.7 gain=0.37 delay=700
"$bin/physvib-jack-actuator" $resonance $q $gain $delay >"$folder/ready" &
playing=$!
for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done

"$physvib" calibrate --device JACK:actuator --channel 1 --input 1 --g-per-unit 2 --drive-volts 3 --out "$folder/mine.json"
cat "$folder/mine.json"
near() { # FIELD WANTED PERCENT
    found=$(sed -n "s/.*\"$1\": \([0-9.e-]*\).*/\1/p" "$folder/mine.json")
    awk -v f="$found" -v w="$2" -v p="$3" 'BEGIN { e = 100 * (f / w - 1); printf "%s %s, made as %s: %.3f %%\n", "'"$1"'", f, w, e; exit !(e <= p && -e <= p) }'
}
near resonance_hz $resonance 0.5
near q $q 5
near full_scale_g 0.74 5
printf 'time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.1,200,30,0.1,0,0\n' >"$folder/hit.csv"
"$physvib" render --from-events "$folder/hit.csv" --layout phone1 --seconds 1 --actuator "$folder/mine.json" --out "$folder/hit.wav"
if "$physvib" calibrate --device JACK:actuator --channel 9 --input 1 --out "$folder/none.json" 2>"$folder/said"; then exit 1; fi
grep -q "JACK:actuator: has 1 outputs" "$folder/said"
[ ! -e "$folder/none.json" ]

# Far above its resonance it is a cable of that many frames, and whatever JACK and the device add.
kill "$playing"
wait "$playing" || true # its name is free again only then
for _ in $(seq 100); do "$physvib" devices | grep -q JACK:actuator || break; sleep 0.1; done
"$bin/physvib-jack-actuator" 0.1 0.7 0.5 $delay >"$folder/ready2" &
playing=$!
for _ in $(seq 100); do grep -qs ready "$folder/ready2" && "$physvib" devices | grep -q JACK:actuator && break; sleep 0.1; done
"$physvib" calibrate --device JACK:actuator --channel 1 --input 1 --loopback >"$folder/loop"
cat "$folder/loop"
awk '{ for (i = 1; i < NF; ++i) if ($(i + 1) == "frames") frames = $i; exit !(frames >= '$delay' && frames < '$delay' + 4096) }' "$folder/loop"
