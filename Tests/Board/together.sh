#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# One world live on a JACK device and on the virtual board; passes if both played all of it in time.
# Usage: together.sh BIN_FOLDER IMAGE.elf SECONDS [SCENE]
set -eu
bin=$1 image=$2 seconds=$3 scene=${4:-shake-the-box}
. "$(dirname "$0")/../Live/jack.sh"
serve 48000 256 8
"$(dirname "$0")/../Support/away.py" >"$folder/away" &
watching=$!
"$bin/physvib-virtual-board" "$image" --link "$folder/port" >/dev/null 2>"$folder/board" &
playing=$!
for _ in 1 2 3 4 5 6 7 8 9 10; do [ -e "$folder/port" ] || sleep 0.2; done
"$bin/physvib" play "$scene" --device JACK:system --board "$folder/port" --driver thread --seconds "$seconds" >"$folder/report" || { cat "$folder/report"; exit 1; }
cat "$folder/report"
kill -INT "$playing"
wait "$playing"
playing=
kill "$watching"
wait "$watching" || :
cat "$folder/board" "$folder/away"
grep -q " events left, 0 late, 0 dropped, 0 refused" "$folder/report"
grep -q " late, 0 dropped, 0 lost" "$folder/report"
if ! grep -q " 0 late, 0 dropped, 0 lost" "$folder/report"; then # then the machine has to have been away for as long as strikes are early
    ! grep -q "^away 0 times" "$folder/away" || { echo "expected no strike late on a machine that was never away"; exit 1; }
fi
grep -q " 0 against their times, 0 samples missed, 0 restarts, 0 faults" "$folder/board"
played=$(sed -n 's/.* ms; \([0-9]*\) events left.*/\1/p' "$folder/report")
told=$(sed -n 's/.* \([0-9]*\) strikes sent, \([0-9]*\) thinned, \([0-9]*\) refused.*/\1 + \2 + \3/p' "$folder/report")
echo "$played collisions on the device, $told on the board"
[ "$played" -gt 10 ]
# What is on its way at the end was told to one and not yet played by the other.
[ $(($told)) -ge "$played" ] && [ $(($told)) -le $((played + 30)) ]
