#!/bin/sh
# SPDX-License-Identifier: MIT
# Types what the page of games says, word for word, without a display of one's own, and looks at what the games say at their end: each of them was
# felt. What the page installs and builds once is there. Usage: games.sh ROOT BUILD PAGE
set -eu
root=$1 build=$2 page=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
PATH=/usr/bin:/usr/games:$PATH # what Debian installs
mkdir build
ln -s "$build" build/library
ln -s "$build" build/release
ln -s "$root/Source" "$root/Docs" .
awk -f "$root/Tests/Api/page.awk" "$root/Docs/tutorials/$page"
SDL_VIDEODRIVER=x11 SDL_AUDIODRIVER=dummy ALSOFT_DRIVERS=null xvfb-run -a sh -eu commands | tee said
[ "$(grep -c '^[1-9][0-9]* .*\(hits\|impacts\)' said)" = 4 ] || { echo "$page: expected four games that were felt" && exit 1; }
