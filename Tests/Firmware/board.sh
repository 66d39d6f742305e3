#!/bin/sh
# SPDX-License-Identifier: MIT
# The command line with the virtual board over a pseudo-terminal, in real time: board.sh PHYSVIB VIRTUAL_BOARD IMAGE.elf
set -eu
physvib=$1 virtual_board=$2 image=$3
folder=$(mktemp -d)
board=
finish() {
    if [ -n "$board" ]; then kill "$board" 2>/dev/null && wait "$board" 2>/dev/null; fi
    rm -rf "$folder"
}
trap finish EXIT
fail() {
    echo "board.sh: $1" >&2
    cat "$folder"/*.txt >&2
    exit 1
}
start() {
    : >"$folder/port.txt" # it may be asked for before the program runs
    "$virtual_board" "$image" --seconds 120 --wav "$folder/codes.wav" >"$folder/port.txt" 2>"$folder/board.txt" &
    board=$!
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        port=$(cat "$folder/port.txt")
        [ -n "$port" ] && return 0
        sleep 0.2
    done
    fail "the virtual board does not start"
}
stop() {
    kill -INT "$board"
    wait "$board" || fail "the virtual board failed"
    board=
}

# 200 hits, then a crowd of 200 within a tenth of a second: more than the line carries.
{
    echo time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m
    i=0
    while [ $i -lt 200 ]; do
        echo "$((i / 100)).$(printf %03d $((i % 100 * 10)))000000,$((100 + i % 30)),20,0.$((100 + i)),0.05,0.02"
        i=$((i + 1))
    done
    i=0
    while [ $i -lt 200 ]; do
        echo "2.$(printf %03d $((i / 2)))000000,$((100 + i % 30)),40,0.$((100 + i)),0.05,0.02"
        i=$((i + 1))
    done
} >"$folder/hits.csv"

start
"$physvib" board "$port" info >"$folder/info.txt" 2>&1 || fail "info"
grep -q "4 channels at 8000 Hz, 128 modes, protocol 2, clock 72 MHz" "$folder/info.txt" || fail "info says something else"
"$physvib" board "$port" test >"$folder/test.txt" 2>&1 || fail "test"
grep -q "the bits are those of this computer" "$folder/test.txt" || fail "the self-test differs"
"$physvib" board "$port" play "$folder/hits.csv" >"$folder/play.txt" 2>&1 || fail "play"
cat "$folder/info.txt" "$folder/test.txt" "$folder/play.txt"
sent=$(sed -n 's/.* \([0-9]*\) strikes sent, \([0-9]*\) thinned, \([0-9]*\) refused.*/\1 \2 \3/p' "$folder/play.txt")
set -- $sent
[ $(($1 + $2 + $3)) -eq 400 ] || fail "sent, thinned and refused do not make 400"
[ "$2" -gt 0 ] || fail "nothing was thinned"
[ "$1" -ge 200 ] || fail "too few were sent"
grep -q "the board played $1, .* 0 dropped, 0 lost" "$folder/play.txt" || fail "not all that was sent was played"
"$physvib" play shake-the-box --board "$port" --seconds 3 >"$folder/scene.txt" 2>&1 || fail "play a scene"
grep -q " strikes sent, .* 0 dropped, 0 lost" "$folder/scene.txt" || fail "the scene was not played"
cat "$folder/scene.txt"
stop
grep -q " 0 against their times, 0 samples missed, 0 restarts, 0 faults" "$folder/board.txt" || fail "the board was not well"
cat "$folder/board.txt"

# A list of a scene says its field, so the board plays what the scene's render holds; where nothing can be felt, success is not told.
nothing() {
    why=$1
    shift
    if "$physvib" board "$port" play "$@" >"$folder/none.txt" 2>&1; then fail "success is told, and nothing is felt: $*"; fi
    [ "$(wc -l <"$folder/none.txt")" -eq 1 ] || fail "more than one line"
    grep -q ": nothing can be felt at --level $why\$" "$folder/none.txt" || fail "expected: $why"
}
start
"$physvib" render shake-the-box --seconds 3 --events "$folder/box.csv" --out "$folder/box.wav" >"$folder/box.txt"
"$physvib" board "$port" play "$folder/box.csv" --level 0 >"$folder/box.txt" 2>&1 || fail "play a scene's list"
[ "$(wc -l <"$folder/box.txt")" -eq 1 ] || fail "a warning of hits in their field"
nothing "-12: [0-9]* of [0-9]* hits lie outside the field of 0.01 x 0.01 m (see --field)" "$folder/box.csv" --field 0.01,0.01
sed 's/ field_m=.*//; s/^\([0-9.]*,[0-9.]*,[0-9.]*,[0-9.]*\),[^,]*,/\1,3,/' "$folder/box.csv" >"$folder/old.csv"
nothing "-12: [0-9]* of [0-9]* hits lie outside the field of 0.12 x 0.06 m, the layout's, as the list says none (see --field)" "$folder/old.csv"
nothing "-90: the strongest hit is 0.[0-9]* of full scale" "$folder/box.csv" --level -90
stop
/usr/bin/python3 - "$folder/box.wav" "$folder/codes.wav" <<'END' || fail "the board did not play what the scene's render holds"
import array, sys
render, codes = (open(path, "rb").read() for path in sys.argv[1:])
samples, felt = array.array("f", render[render.find(b"data") + 8:]), codes[codes.find(b"data") + 8:]
for channel in range(4):
    wanted = 127 * max(map(abs, samples[channel::4]))
    found = max(abs(code - 128) for code in felt[channel::4])
    print(f"channel {channel + 1}: {found} steps of the converter, the render has {wanted:.1f}")
    if abs(found - wanted) > 2 + 0.1 * wanted:
        sys.exit(1)
END
if "$physvib" board "$port" info >"$folder/gone.txt" 2>&1; then fail "a board that is not there answers"; fi
[ "$(wc -l <"$folder/gone.txt")" -eq 1 ] || fail "more than one line on a board that is not there"
