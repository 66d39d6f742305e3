#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# monkeys.sh [BIN_FOLDER] [SEEDS] [ACTIONS] [FIRST_SEED]: pointer and keys at random, so many actions of each seed, on a display and a JACK server of
# their own; BIN_FOLDER may be of the preset asan. Then: Esc, and the ports carry nothing for two seconds; killed, and what was kept renders; begun
# again, it lives and ends by a signal. Nothing may have been said by a sanitizer. For Docs/mixer.md; no test, as 20 seeds take half an hour.
set -eu
bin=$(cd "${1:-$(dirname "$0")/../../build/release/bin}" && pwd) seeds=${2:-20} actions=${3:-1000} first=${4:-1}
here=$(cd "$(dirname "$0")" && pwd)
for program in xvfb-run xdotool jackd python3; do command -v $program >/dev/null || { echo "skipped: needs $program"; exit 77; }; done
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1280x800x24" "$0" "$bin" "$seeds" "$actions" "$first"
fi
display=$DISPLAY
. "$here/../Live/jack.sh"
# JUCE 7.0.5 copies one number too many beside itself where it clips an odd shape (juce_EdgeTable.cpp, memcpy (temp, src1, ...)): the last, which is never read.
echo "interceptor_via_fun:juce::EdgeTable::intersectWithEdgeTableLine" >"$folder/not-ours"
export DISPLAY="$display" ASAN_OPTIONS="detect_leaks=0:abort_on_error=1:suppressions=$folder/not-ours:log_path=$folder/address" UBSAN_OPTIONS="halt_on_error=1"

monkey() { # SEED FIRST COUNT: these actions of a seed, as words of xdotool
    python3 - "$1" "$2" "$3" <<'END'
import random, sys
seed, first, count = map(int, sys.argv[1:])
keys = "Escape Return Tab space Delete BackSpace Up Down Left Right Home End Prior Next F1 F2 F3 F4 F6 ctrl+z ctrl+shift+z ctrl+a ctrl+c ctrl+v ctrl+s ctrl+o ctrl+n a b d e m n p r s t w 0 1 5 9 minus period".split()
for k in range(first, first + count):
    r = random.Random(seed * 1000003 + k)
    place = lambda: "%d %d" % (r.randrange(1280), r.randrange(800))
    kind = r.random()
    if kind < 0.5: print("mousemove", place(), "click 1")
    elif kind < 0.6: print("mousemove", place(), "click 3")
    elif kind < 0.75: print("mousemove", place(), "mousedown 1 mousemove", place(), "mousemove", place(), "mouseup 1")
    elif kind < 0.8: print("mousemove", place(), "click", r.choice("45"))
    else: print("key", r.choice(keys))
    print("sleep", round(r.uniform(0.005, 0.05), 3))
END
}
fail() { echo "seed $seed: $*"; cat "$folder"/address* "$folder/mixer.log" 2>/dev/null | head -n 60; exit 1; }
start() {
    while xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.1; done # of the one before
    "$bin/physvib-mixer" --device "JACK:system" >>"$folder/mixer.log" 2>&1 &
    mixer=$!
    playing=$mixer
    for _ in $(seq 600); do
        xdotool search --name "PhysVib mixer" >/dev/null 2>&1 && break
        kill -0 "$mixer" 2>/dev/null || fail "it does not start"
        sleep 0.1
    done
    sleep 1
}
ended() { # it has ended: by its own menu, with 0
    status=0
    wait "$mixer" || status=$?
    [ "$status" -eq 0 ] || fail "it ended with $status before action $1"
    quits=$((quits + 1))
    start
}
listen() { # what the ports carry at most in two seconds
    : >"$folder/felt.raw"
    [ -z "$ports" ] || "$bin/physvib-jack-recorder" "$folder/felt.raw" 2 2 "$ports" >"$folder/recorder.log" 2>&1 || { cat "$folder/recorder.log"; fail "not recorded"; }
    loud=$(od -An -v -t f4 -w4 "$folder/felt.raw" 2>/dev/null | awk '{ x = $1 < 0 ? -$1 : $1; if (x > peak) peak = x } END { printf "%.6f", peak }')
}
serve 48000 512 8
seed=$first
while [ "$seed" -lt $((first + seeds)) ]; do
    export XDG_CONFIG_HOME="$folder/config-$seed" HOME="$folder/home-$seed" quits=0
    mkdir -p "$HOME"
    : >"$folder/mixer.log"
    start
    for at in $(seq 0 50 $((actions - 1))); do
        kill -0 "$mixer" 2>/dev/null || ended "$at"
        monkey "$seed" "$at" 50 | xdotool - >/dev/null 2>&1 || :
    done
    kill -0 "$mixer" 2>/dev/null || ended "$actions"
    for _ in 1 2 3 4 5 6; do xdotool key Escape sleep 0.2; done
    ports=$(jack_lsp 2>/dev/null | sed -n 's/out_1$/out_/p' | head -n 1)
    listen
    early=$loud
    awk "BEGIN { exit !($loud == 0) }" || listen # a busy mixer has not heard the key yet: another time it has
    kill -9 "$mixer" 2>/dev/null || fail "it ended by itself"
    wait "$mixer" 2>/dev/null || :
    kept=0
    for copy in "$XDG_CONFIG_HOME"/physvib/recovery-*.json; do
        [ ! -e "$copy" ] || { "$bin/physvib" render "$copy" --seconds 1 --out "$folder/again.wav" >"$folder/render.log" 2>&1 || { cat "$folder/render.log"; fail "what was kept does not render"; }; kept=$((kept + 1)); }
    done
    start
    sleep 2
    kill -TERM "$mixer" 2>/dev/null || fail "it ended by itself when it began again"
    status=0
    wait "$mixer" || status=$?
    case $status in 0 | 143) ;; *) fail "it ended with $status when it began again" ;; esac # 143: where it has been busy for 0.8 s
    ! ls "$folder"/address* >/dev/null 2>&1 || fail "an error of memory"
    echo "seed $seed: $actions actions, $quits times quit by them, after Esc ${ports:-no device} carries at most $loud ($early at first), $kept copies kept and rendered"
    awk "BEGIN { exit !($loud == 0) }" || fail "it sounds after Esc"
    pkill -f "$folder/home-$seed" 2>/dev/null || : # what a page was opened in
    seed=$((seed + 1))
done
