#!/bin/sh
# SPDX-License-Identifier: MIT
# Does what a page says: saves its programs, pastes its commands one after another, and looks at the sound that they end in.
# Usage: pages.sh ROOT BUILD PAGE PROGRAM... - the programs are those of this folder, and stand in the page as they are.
set -eu
root=$1 build=$2 page=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
PATH=/usr/bin:$PATH # what Debian installs
mkdir build
ln -s "$build" build/release
ln -s "$root/Source" "$root/Tests" .
# ```c drop.c ... ```: a file; ```sh ... ```: commands
awk '/^```/ { name = (name == "" && NF == 2) ? $2 : (name == "" && $1 == "```sh") ? "commands" : ""; next } name != "" { print > name }' "$root/Docs/$page"
for program in "$@"; do cmp "$program" "$root/Tests/Api/$program"; done
sh -eu commands
[ "$(head -c 4 drop.wav)" = RIFF ] && [ "$(wc -c <drop.wav)" -gt 100000 ]
