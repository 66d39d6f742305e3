#!/bin/sh
# SPDX-License-Identifier: MIT
# Does what a page says: saves its programs, pastes its commands one after another, and looks at the sound that they end in. What the page
# installs and builds once is there; ten-minutes.sh does that as well.
# Usage: pages.sh ROOT BUILD PAGE PROGRAM... - the programs are those of this folder, and stand in the page as they are.
set -eu
root=$1 build=$2 page=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
PATH=/usr/bin:/usr/games:$PATH # what Debian installs
mkdir build
ln -s "$build" build/library
ln -s "$root/Source" "$root/Tests" "$root/VERSION.txt" .
awk -f "$root/Tests/Api/page.awk" "$root/Docs/$page"
for program in "$@"; do cmp "$program" "$root/Tests/Api/$program"; done
paste() { # on a display of its own if it wants one
    if [ "$page" = lua.md ]; then ALSOFT_DRIVERS=null xvfb-run -a sh -eu commands; else sh -eu commands; fi
}
paste
[ "$(head -c 4 drop.wav)" = RIFF ] && [ "$(wc -c <drop.wav)" -gt 100000 ]
[ "$page" = lua.md ] || python3 "$root/Tests/Api/ends.py" drop.wav # LÖVE's is a game, which goes on
