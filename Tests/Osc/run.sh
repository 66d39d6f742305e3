#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Open Sound Control as a sender meets it, beside CI: floods from liblo and Pd, random bytes, eight programs at once, tags against a JACK
# recording to the bit, a phone for minutes. On JACK servers without hardware.
# Usage: run.sh BIN_FOLDER [PACKETS (1000000)] [PER_SECOND (10000)] [PHONE_SECONDS (600)] [STEP...]: flood silence pd random eight tags phone
set -eu
bin=$(realpath "$1") packets=${2:-1000000} rate=${3:-10000} held=${4:-600}
[ $# -gt 4 ] && shift 4 && steps="$*" || steps="flood silence pd random eight tags phone"
here=$(dirname "$(realpath "$0")")
. "$here/../../.ci/packages.sh"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_osc_packages
. "$here/../Live/jack.sh"
quiet=$here/../../Standalone/Examples/quiet.json
sender=$bin/physvib-osc-sender

# listen SECONDS OPTIONS...: plays, and waits for the port, which is then in $port.
listen() {
    seconds=$1
    shift
    "$bin/physvib" play "$@" --device JACK:system --level 0 --osc 0 --seconds "$seconds" >"$folder/report" 2>"$folder/told" &
    player=$!
    playing=$player
    for _ in $(seq 100); do grep -qs "listening at" "$folder/told" && break; sleep 0.1; done
    port=$(sed -n 's/.*listening at 127.0.0.1:\([0-9]*\).*/\1/p' "$folder/told")
    sleep 2 # its clock settles
}
# finish: the end of what plays; its words.
finish() {
    kill -INT "$player"
    wait "$player" || { cat "$folder/told"; exit 1; }
    cat "$folder/told" "$folder/report"
}
count() { sed -n "s/^OSC at .*[:;,] \([0-9]*\) $1.*/\1/p" "$folder/report"; }
is() { [ "$(count "$1")" = "$2" ] || { echo "$3: $1: expected $2, found $(count "$1")"; exit 1; }; }
long=$((packets / rate + packets / rate / 2 + 60))
block=2048 # a server without hardware that is called later than a block loses it, and with it its clock
serve 48000 $block 4

for step in $steps; do
    echo "== $step"
    case $step in
    flood) # none is lost, and tagged L ahead none is late
        listen "$long" "$quiet"
        ahead=$("$sender" "$port" ask latency | cut -d' ' -f2)
        "$sender" "$port" flood "$packets" "$rate" "$ahead"
        for _ in $(seq 100); do oscsend localhost "$port" /physvib/strike sfsfsf frequency_hz 205 decay_per_s 200 level 0.0001; done
        sleep 2
        finish
        for none in bad lost refused late; do is $none 0 flood; done
        is packets $((packets + 101)) flood # the question as well
        ;;
    silence) # asked for in the middle of a flood, it acts within 20 ms
        listen "$long" "$quiet"
        "$sender" "$port" silence "$packets" "$rate"
        finish
        is refused 0 silence
        ;;
    pd)
        listen "$long" "$quiet"
        pd -nogui -noaudio -nomidi -open "$here/burst.pd" -send "port $port" -send "count $packets"
        sleep 2
        finish
        for none in bad lost refused; do is $none 0 pd; done
        is packets "$packets" pd
        ;;
    random) # nothing ends, nothing is struck
        listen "$long" "$quiet" --save "$folder/random.json"
        "$sender" "$port" random "$packets" "$rate"
        sleep 2
        finish
        is lost 0 random
        is packets "$packets" random
        grep -q '"strikes"' "$folder/random.json" && { echo "random: something was struck"; exit 1; }
        grep -q "; 0 events left" "$folder/report"
        ;;
    eight) # each has a port of its own, and hears what is for it
        ports= all=
        for k in 1 2 3 4 5 6 7 8; do
            "$bin/physvib" play "$quiet" --device JACK:system --osc 9000 --seconds 30 >"$folder/report.$k" 2>"$folder/told.$k" &
            all="$all $!"
            playing="$playing $!"
            for _ in $(seq 100); do grep -qs "listening at" "$folder/told.$k" && break; sleep 0.1; done
            ports="$ports $(sed -n 's/.*listening at 127.0.0.1:\([0-9]*\).*/\1/p' "$folder/told.$k")"
        done
        for one in $ports; do "$sender" "$one" flood 1000 10000 0.1; done
        sleep 1
        kill -INT $all
        for one in $all; do wait "$one"; done
        cat "$folder"/told.? && grep -h "^OSC at" "$folder"/report.?
        [ "$(grep -h "^OSC at" "$folder"/report.? | grep -c ": 1000 packets, 0 bad, 0 lost; 1000 messages, 0 refused, 0 late")" -eq 8 ]
        [ "$(printf '%s\n' $ports | sort -u | wc -l)" -eq 8 ]
        ;;
    tags) # what is heard is what tags alone say, to the bit, from the first strike on; with tags 0.02 frame later it is not
        "$bin/physvib-jack-recorder" "$folder/live.raw" 4 22 >"$folder/ready" &
        recording=$!
        for _ in $(seq 100); do grep -qs ready "$folder/ready" && break; sleep 0.1; done
        listen 30 "$quiet" --save "$folder/tags.json"
        "$sender" "$port" tags 150 >"$folder/tags"
        wait "$recording"
        finish
        python3 "$here/tags.py" "$folder/tags.json" "$folder/tags" "$folder/by-tags.json" "$folder/later.json"
        for name in by-tags later; do
            "$bin/physvib" render "$folder/$name.json" --seconds 26 --out "$folder/$name.wav" >/dev/null
            tail -c +"$(($(grep -abo data "$folder/$name.wav" | head -n 1 | cut -d: -f1) + 9))" "$folder/$name.wav" >"$folder/$name.raw"
        done
        xruns=$(sed -n 's/xruns //p' "$folder/ready")
        "$bin/physvib-compare-recording" "$folder/live.raw" "$folder/by-tags.raw" 4 $block "$xruns"
        if "$bin/physvib-compare-recording" "$folder/live.raw" "$folder/later.raw" 4 $block "$xruns"; then
            echo "tags: the recording would be that of tags 0.02 frame later, too"
            exit 1
        fi
        ;;
    phone) # the last reading is the gravity that stays
        listen $((held + 30)) shake-the-box --hands --save "$folder/phone.json"
        "$sender" "$port" phone "$held" 100
        sleep 1
        finish
        for none in bad lost refused; do is $none 0 phone; done
        is packets $((held * 100)) phone
        python3 - "$folder/phone.json" <<'PYTHON'
import json, sys
inputs = [i for take in json.load(open(sys.argv[1]))["takes"] for i in take["inputs"]]
last = inputs[-1]["gravity_m_per_s2"]
assert abs(last[0]) < 0.05 and abs(last[1] + 9.81) < 0.05, last
print(f"phone: {len(inputs)} readings used, upright in the end: {last}")
PYTHON
        ;;
    esac
done
