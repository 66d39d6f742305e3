#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Ten seconds of each preset of the plug-in as FOLDER/NAME.wav, the list of what was felt as NAME.csv, and its picture as NAME.png, at the level of a new
# instance.
# usage: Tests/Plugin/Formats/presets.sh [BUILD (build/release)] [FOLDER (out/presets)]
set -eu
cd "$(dirname "$0")/../../.."
build=$(realpath "${1:-build/release}")
folder=${2:-out/presets}
mkdir -p "$folder"
"$build/bin/physvib-plugin-presets" "$folder" >"$folder/presets.txt"
while IFS='	' read -r name field events peak; do
    "$build/bin/physvib" render --from-events "$folder/$name.csv" --layout "$folder/$name.json" --field "$field" --seconds 10.5 --level-db -12 --picture "$folder/$name.png" >/dev/null
    printf '%s: %s events, peak %s of full scale\n' "$folder/$name" "$events" "$peak"
done <"$folder/presets.txt"
