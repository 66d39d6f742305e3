#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# full-disk.sh BIN_FOLDER [STEP]: a disk that is full after N bytes of a file, for N from 0 to below the file's size in steps of STEP (1; 64
# times as wide where a file is large). It is told in one line, exit 1, the old file stays, nothing is left behind; a study goes on to
# the bytes of one that was never cut off. A script beside Outputs.AFullDisk..., which takes some N: all of them take about ten minutes.
set -eu
physvib=$(cd "$1" && pwd)/physvib step=${2:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
printf 'stimulus,response\na,a\nb,b\na,b\n' >trials.csv
fail() { echo "$*"; ls -la; exit 1; }

# fills STEP OUTPUT WORDS...: the call that writes this output.
fills() {
    each=$1 output=$2
    shift 2
    "$physvib" "$@" >/dev/null 2>&1 || fail "does not work at all: $*"
    size=$(wc -c <"$output") n=0 times=0
    echo old >"$output"
    while [ $n -lt "$size" ]; do
        code=0
        said=$(prlimit --fsize=$n "$physvib" "$@" 2>&1 >/dev/null) || code=$?
        said=$(echo "$said" | grep -v '^physvib: warning: ' || true)
        [ $code = 1 ] && [ "$said" = "physvib: $output: cannot be written: File too large" ] || fail "$* with room for $n bytes: exit $code, said: $said"
        [ "$(cat "$output")" = old ] || fail "$* with room for $n bytes: the old file is gone"
        [ "$(ls)" = "$(printf '%s\n' "$output" trials.csv | sort)" ] || fail "$* with room for $n bytes leaves something behind"
        n=$((n + each)) times=$((times + 1))
    done
    rm "$output"
    echo "$*: $size bytes, full at $times places"
}

study() {
    run="study run magnitudes --observer simulated"
    mkdir whole
    "$physvib" $run --out whole >/dev/null
    size=$(wc -c <whole/magnitudes-P01.csv) n=0 times=0
    while [ $n -lt "$size" ]; do
        code=0
        said=$(prlimit --fsize=$n "$physvib" $run 2>&1 >/dev/null) || code=$?
        [ $code = 1 ] && [ "$said" = "physvib: ./magnitudes-P01.csv: cannot be written: File too large" ] || fail "study with room for $n bytes: exit $code, said: $said"
        "$physvib" $run >/dev/null
        cmp whole/magnitudes-P01.csv magnitudes-P01.csv || fail "study with room for $n bytes goes on to another file"
        rm magnitudes-P01.csv
        n=$((n + $1)) times=$((times + 1))
    done
    echo "$run: $size bytes, full at $times places; each goes on to the same bytes"
}

fills "$step" o.wav render drop --seconds 0.05 --rate 8000 --layout phone1 --out o.wav
fills "$step" o.csv render drop --seconds 2 --events o.csv
fills "$step" o.wav stimulus phantom --at 0.5,0.5 --layout phone1 --seconds 0.01 --rate 8000 --out o.wav
fills "$step" o.csv analyse confusion trials.csv --export o.csv
fills $((64 * step)) o.svg analyse confusion trials.csv --picture o.svg
fills $((64 * step)) o.png render drop --seconds 0.5 --picture o.png
fills $((64 * step)) o.wav calibrate --sweep o.wav --seconds 1 --rate 8000
study "$step"
