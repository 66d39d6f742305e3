#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# survives-kill.sh PARTICIPANT PHYSVIB: the mixer is killed twice while a participant sits at a study. Each answer that was given is kept as it
# was, the study goes on with the trial that was cut off, and it asks the same as one that was never killed.
set -eu
participant=$1 physvib=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/killed" "$folder/whole"
rows="$folder/killed/short-P01.csv"

# sits TRIALS: the participant, until the mixer is killed
sits() {
    status=0
    "$participant" "$folder/killed" "$1" || status=$?
    [ "$status" -eq 137 ] || { echo "expected a mixer that is killed, it ended with $status"; exit 1; }
}
# trials FILE: what was asked and answered, without how long it took
trials() { sed -E '/^#/d; s/"([^",]*),([^",]*)"/\1;\2/g' "$1" | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) name[$i] = i; next } { print $name["trial"], $name["stimulus"], $name["response"] }'; }

sits 5
[ "$(trials "$rows" | wc -l)" -eq 5 ] || { echo "expected the 5 answers that were given"; cat "$rows"; exit 1; }
cp "$rows" "$folder/first"
sits 4
[ "$(trials "$rows" | wc -l)" -eq 9 ] || { echo "expected 9 answers"; cat "$rows"; exit 1; }
"$participant" "$folder/killed" 100
cmp -n "$(wc -c <"$folder/first")" "$folder/first" "$rows"
"$participant" "$folder/whole" 100
trials "$rows" >"$folder/a"
trials "$folder/whole/short-P01.csv" >"$folder/b"
[ "$(wc -l <"$folder/a")" -eq 12 ] || { echo "expected 12 trials"; cat "$rows"; exit 1; }
cmp "$folder/a" "$folder/b"
"$physvib" analyse confusion "$rows" >/dev/null
echo "killed after 5 and 9 of 12 trials, nothing lost"
