#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A JACK server stalls for a second, and for three, under a session that is struck meanwhile, and dies at last; passes if
# nothing of the stalls is felt when it goes on, their strikes are refused, both are told, and the end is a failure.
# Usage: pause.sh BIN_FOLDER QUIET_SCENE
set -eu
bin=$1 scene=$2
. "$(dirname "$0")/jack.sh"
strike() { echo "{\"message\": \"strike\", \"frequency_hz\": 200, \"seconds\": 0.05, \"level\": 0.4, \"id\": $1}" >&3; }
peak() { # FIRST LAST: largest sample of those bytes of the port's recording
    tail -c +"$(($1 + 1))" "$folder/port.raw" | head -c "$(($2 - $1))" | od -An -v -t f4 -w4 | awk '{x = $1 < 0 ? -$1 : $1; if (x > most) most = x} END {print most + 0}'
}

serve 48000 512 4
"$bin/physvib-jack-recorder" "$folder/port.raw" 4 5 >"$folder/ready" &
recording=$!
playing=$recording
for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
mkfifo "$folder/lines"
"$bin/physvib" play "$scene" --device JACK:system --level 0 --listen --seconds 11 <"$folder/lines" >"$folder/report" 2>"$folder/told" &
player=$!
playing="$recording $player"
exec 3>"$folder/lines"
sleep 2
strike 1
sleep 1
stall() { # FIRST_ID SECONDS
    kill -STOP "$server"
    sleep 0.5
    for k in $(seq "$1" $(($1 + 19))); do strike "$k"; done
    sleep "$2"
    kill -CONT "$server"
}
accepted() { # ID: it is, within ten seconds; each try has a number of its own
    for k in $(seq "$1" $(($1 + 40))); do
        strike "$k"
        sleep 0.25
        grep -q "{ \"answer\": \"done\", \"id\": $k }" "$folder/report" && return
    done
    echo "no strike was accepted again" >&2
    return 1
}
stall 100 0.7
accepted 200
wait "$recording"
stall 300 2.5
accepted 400
sleep 0.5
kill -9 "$server"
server=
code=0
wait "$player" || code=$?
cat "$folder/report" "$folder/told"
grep -q '{ "answer": "done", "id": 1 }' "$folder/report"
for k in $(seq 100 119) $(seq 300 319); do
    grep -q "{ \"answer\": \"error\", \"id\": $k, \"reason\": \"strike: no device runs: dropped\" }" "$folder/report"
done
grep -q "JACK:system does not ask for samples: nothing is felt, and time stands still" "$folder/told"
grep -q "20 events were lost, as no device ran" "$folder/told"
grep -q "; 3 events left, 0 late, [4-9][0-9] dropped, 0 refused" "$folder/report"
grep -q "at the outputs: peaks 0.100 0.100 0.100 0.100 of full scale" "$folder/report"
grep -q "JACK:system has stopped; it is looked for every second" "$folder/told"
[ "$code" = 1 ]
size=$(stat -c %s "$folder/port.raw") one=$(peak 0 $((48000 * 16 * 3)))
all=$(peak 0 "$size")
echo "peak at the port: one strike $one, all of it $all"
awk "BEGIN {exit !($one > 0.02 && $all < 1.1 * $one)}"
