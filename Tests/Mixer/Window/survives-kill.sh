#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# survives-kill.sh MIXER PHYSVIB: the mixer is driven by a real pointer and killed; the copy it kept renders, and is
# offered when it starts again.
set -eu
mixer=$1 physvib=$2
folder=$(mktemp -d)
pid=""
trap 'test -z "$pid" || kill -9 "$pid" 2>/dev/null || :; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder"
if ! command -v xdotool >/dev/null 2>&1; then
    echo "skipped: no xdotool"
    exit 77
fi

# wait_for SECONDS COMMAND...: until the command succeeds
wait_for() {
    tries=$(($1 * 10))
    shift
    while ! "$@" >/dev/null 2>&1; do
        tries=$((tries - 1))
        [ "$tries" -gt 0 ] || return 1
        sleep 0.1
    done
}
has_copy() { ls "$folder"/physvib/recovery-*.json; }

"$mixer" --device "None:no device" &
pid=$!
wait_for 30 xdotool search --name "PhysVib mixer"
sleep 1
# 70 is the code of F4, which xdotool presses with modifiers where every level of the key has the same symbol (sid)
xdotool mousemove 720 450 key 70 sleep 1 mousemove 1200 132 click 1 # a new enchanter, by a click on the module of the drawer
wait_for 30 has_copy
sleep 3
kill -9 "$pid"
wait "$pid" 2>/dev/null || :
copy=$(ls "$folder"/physvib/recovery-*.json)
"$physvib" render "$copy" --out "$folder/again.wav"
grep -q '"E"' "$copy" || { echo "the fifth enchanter is not in the copy"; exit 1; }

"$mixer" --device "None:no device" &
pid=$!
wait_for 30 xdotool search --name "new session - PhysVib mixer"
sleep 1
xdotool mousemove 720 20 key Return # the question has the keyboard
has_gone() { [ ! -e "$copy" ]; }
wait_for 30 has_gone # answered: else it would still be there
sleep 3
kill -TERM "$pid" # its copy stays: what was taken up has not been saved
wait "$pid" 2>/dev/null || :
pid=""
grep -q '"E"' "$folder"/physvib/recovery-*.json || { echo "the fifth enchanter was not taken up"; exit 1; }
echo "recovered"
