#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# kills.sh BIN_FOLDER KILLS render|study|play|mixer...: kills each of them (SIGKILL) at so many random moments. Every file is whole or
# absent, an old one stays as it was until then (a recording: until it has samples), a study goes on to the bytes of one that was never cut off, a session that is
# killed loses at most a second, and nothing that was left behind is in the way. `play` needs jackd, `mixer` a display (with-display.sh) and xdotool.
set -eu
bin=$1 kills=$2
shift 2
physvib=$bin/physvib
case " $* " in
*" play "*) . "$(dirname "$0")/../Live/jack.sh" ;;
*)
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    ;;
esac
cd "$folder"

# random BELOW: seconds with three decimals.
random() { od -An -N4 -tu4 /dev/urandom | awk -v below="$1" '{ printf "%.3f", $1 / 4294967296 * below }'; }
# kill_within SECONDS COMMAND...: at a random moment; what it said is in `said`.
kill_within() {
    moment=$(random "$1")
    shift
    "$@" >said 2>&1 &
    victim=$!
    sleep "$moment"
    kill -9 "$victim" 2>/dev/null || true
    wait "$victim" 2>/dev/null || true
}
fail() { echo "$*"; ls -la; cat said; exit 1; }
no_parts() { for part in ./*.part; do [ ! -e "$part" ] || fail "left behind: $part"; done; }

kill_renders() {
    "$physvib" render shake-the-box --seconds 4 --out ref.wav --events ref.csv --picture ref.png >said
    whole=0 n=0
    while [ $n -lt "$kills" ]; do
        n=$((n + 1))
        for kind in wav csv png; do echo old >"out.$kind"; done
        kill_within 0.4 "$physvib" render shake-the-box --seconds 4 --out out.wav --events out.csv --picture out.png
        for kind in wav csv png; do
            if cmp -s "ref.$kind" "out.$kind"; then whole=$((whole + 1)); else [ "$(cat "out.$kind")" = old ] || fail "out.$kind is neither the old nor the new one"; fi
        done
    done
    "$physvib" render shake-the-box --seconds 4 --out out.wav --events out.csv --picture out.png >said 2>&1 || fail "what was left is in the way"
    no_parts
    echo "render: killed $kills times; of $((3 * kills)) files $whole were whole, the others as before"
}

kill_studies() {
    mkdir -p whole cut
    "$physvib" study run magnitudes --observer simulated --out whole >said
    n=0 studies=0
    while [ $n -lt "$kills" ]; do
        n=$((n + 1))
        kill_within 0.4 "$physvib" study run magnitudes --observer simulated --out cut --pace 0.01
        if grep -q trials said; then # it was over before
            cmp whole/magnitudes-P01.csv cut/magnitudes-P01.csv || fail "study $studies differs"
            studies=$((studies + 1))
            rm cut/magnitudes-P01.csv
        fi
    done
    "$physvib" study run magnitudes --observer simulated --out cut >said
    cmp whole/magnitudes-P01.csv cut/magnitudes-P01.csv || fail "the last study differs"
    echo "study: killed $kills times; $((studies + 1)) studies, each the bytes of one that was never cut off"
}

# whole_wav FILE: it has all that its head tells of; what follows was being written.
whole_wav() { [ "$(head -c 4 "$1")" = RIFF ] && [ "$(($(od -An -tu4 -j4 -N4 "$1") + 8))" -le "$(wc -c <"$1")" ]; }

kill_plays() {
    serve 48000 512 8
    n=0
    while [ $n -lt "$kills" ]; do
        n=$((n + 1))
        echo old >take.wav
        rm -f session.json session.events.csv
        kill_within 4 "$physvib" play shake-the-box --device JACK:system --seconds 60 --save session.json --record take.wav
        [ "$(head -c 3 take.wav)" = old ] || whole_wav take.wav || fail "half a recording"
        [ -e session.json ] || continue
        "$physvib" render session.json --seconds 5 --out again.wav --events again.csv >said 2>&1 || fail "the session does not render"
        rows session.events.csv >played
        rows again.csv | head -n "$(wc -l <played)" | cmp - played || fail "the session renders other events than were played"
    done
    echo "play: killed $kills times; every session renders what was played"
}

kill_mixers() {
    export XDG_CONFIG_HOME="$folder"
    n=0 copies=0
    while [ $n -lt "$kills" ]; do
        n=$((n + 1))
        (sleep 2 && xdotool mousemove 720 300 key b click 1) 2>/dev/null & # a ball: something to keep a copy of
        kill_within 9 "$bin/physvib-mixer" --device "None:no device"
        for copy in physvib/recovery-*.json; do
            [ -e "$copy" ] || continue
            "$physvib" render "$copy" --seconds 0.1 --out again.wav >said 2>&1 || fail "$copy is no session"
            copies=$((copies + 1))
            rm "$copy"
        done
    done
    echo "mixer: killed $kills times; $copies copies of sessions, each whole"
}

for what in "$@"; do
    case $what in
    render) kill_renders ;;
    study) kill_studies ;;
    play) kill_plays ;;
    mixer) kill_mixers ;;
    *) echo "kills.sh: expected render, study, play or mixer, found $what"; exit 2 ;;
    esac
done
