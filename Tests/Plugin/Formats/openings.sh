#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Opens the editor in a real window, on an X server without a screen.
# Usage: openings.sh BIN_FOLDER [COUNT (1000)]; 77: Xvfb is not installed
set -eu
command -v Xvfb >/dev/null || { echo "skipped: Xvfb (Debian package xvfb) is not installed"; exit 77; }
folder=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 1920x1200x24 -nolisten tcp -noreset 3>"$folder/display" 2>"$folder/log" &
server=$!
trap 'kill "$server" 2>/dev/null; rm -rf "$folder"' EXIT
trap "exit 1" HUP INT TERM
for _ in $(seq 100); do [ -s "$folder/display" ] && break; sleep 0.1; done
[ -s "$folder/display" ] || { cat "$folder/log"; exit 1; }
DISPLAY=:$(cat "$folder/display") HOME=$folder "$1/physvib-editor-openings" "${2:-1000}"
