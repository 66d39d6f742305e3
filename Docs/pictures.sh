#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the pictures of README and Docs anew, with the programs of a release build and of its target physvib-by-hand; needs no display.
# Docs/pictures.txt keeps for each render which call it shows and the checksum of its event list: Tests/Docs/pictures.py finds those that are older than what they show.
# usage: Docs/pictures.sh [BIN_FOLDER (build/release/bin)] [renders]   (renders: those alone, in a minute)
set -eu
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/release/bin}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
list=Docs/pictures.txt
printf '# picture, checksum of the event list that it shows, call. Written by Docs/pictures.sh.\n' >"$folder/list"
draw() { # FILE OPTION CALL: FILE is made by CALL with OPTION
    file=$1 option=$2
    shift 2
    "$bin/physvib" "$@" "$option" "$file" --events "$folder/events.csv" >/dev/null
    printf '%s %s %s\n' "$file" "$(grep -v '^#' "$folder/events.csv" | sha256sum | cut -c1-16)" "$*" >>"$folder/list"
}
draw Docs/shake-the-box.png --picture render shake-the-box --seconds 10
draw Docs/shake-the-box.webp --movie render shake-the-box --seconds 6
draw Docs/drop.png --picture render drop --seconds 6
draw Docs/marbles.png --picture render marbles --seconds 10
glove="--from-events Docs/glove.csv --layout glove5 --seconds 1.5" # written by physvib-glove-mujoco (Tests/Engines)
draw Docs/glove.png --picture render $glove
draw Docs/glove.webp --movie render $glove
mv "$folder/list" $list
[ "${2:-}" != renders ] || exit 0
Tests/figures/mixer.sh "$bin/physvib-mixer-shots"
"$bin/physvib" study run phantom-places --observer simulated --participants 16 --out "$folder" >/dev/null
"$bin/physvib" analyse resolution "$folder"/phantom-places-P*.csv --picture "$folder/resolution.svg" >/dev/null
rsvg-convert -w 1100 -o Docs/studies-resolution.png "$folder/resolution.svg" # of the package librsvg2-bin
