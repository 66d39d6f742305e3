#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The core's figures of two commits beside each other, with this tree's benchmarks: ns a strike from 10 to 1,000,000 strikes a
# second, the whole chain over the bank alone, a silent block, memory, cold blocks, on AVX2 and, where the processor has it,
# AVX-512; five runs of each by turns, medians. Then instruction counts by callgrind, whose processor has AVX2 at best.
# Usage: compare.sh COMMIT COMMIT (five minutes; the commits are unpacked and built below build/compare)
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_library_packages git valgrind python3
[ $# -eq 2 ] || { sed -n '3,7s/^# //p' "$0" >&2; exit 2; }
folder=$PWD/build/compare
mkdir -p "$folder"

# made COMMIT: the folder of its programs.
made() {
    name=$(git rev-parse --short --verify "$1^{commit}")
    tree=$folder/$name
    if [ ! -d "$tree" ]; then
        mkdir "$tree"
        git archive "$name" | tar -x -C "$tree"
    fi
    (cd "$tree" && build library physvib-core >&2)
    for program in ComparedRun InstructionRun; do
        g++ -std=c++20 -O2 -ffp-contract=off -I"$tree/Source" -ITests/Benchmarks Tests/Benchmarks/$program.cpp "$tree/build/library/lib/libphysvib-core.a" -lhwy -o "$tree/build/$program"
    done
    echo "$tree/build"
}
before=$(made "$1")
after=$(made "$2")

for set in avx2 avx512; do
    rm -f "$folder/before.tsv" "$folder/after.tsv"
    for _ in 1 2 3 4 5; do
        "$before/ComparedRun" $set >>"$folder/before.tsv" || break # the processor lacks it
        "$after/ComparedRun" $set >>"$folder/after.tsv"
    done
    [ ! -s "$folder/after.tsv" ] || python3 Tests/Benchmarks/compare.py $set "$folder/before.tsv" "$folder/after.tsv"
    echo "load meanwhile (1, 5, 15 minutes): $(cut -d' ' -f1-3 /proc/loadavg)"
done

count() { # PROGRAMS CHANNELS STRIKES MODES SECONDS: instructions
    programs=$1
    shift
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$programs/InstructionRun" "$@" 2>&1 | awk '/Collected/ { print $4 }'
}
per_block() { # PROGRAMS CHANNELS STRIKES MODES: in the third second
    echo $((($(count "$@" 3) - $(count "$@" 2)) / 750))
}
row() { # NAME CHANNELS STRIKES MODES
    name=$1
    shift
    echo "| $name | $(per_block "$before" "$@") | $(per_block "$after" "$@") |"
}
per_strike() { echo $((($(per_block "$1" 8 "$2" 16) - $(per_block "$1" 8 16 16)) * 750 / ($2 - 16))); }
echo "| AVX2, instructions | before | after |"
echo "| --- | --- | --- |"
row "one silent 64-frame block, 8 channels" 8 0 1
row "one 64-frame block, 64 modes x 4 channels, each struck once a second" 4 64 64
row "one 64-frame block, 64 modes x 8 channels, each struck once a second" 8 64 64
for rate in 1000 10000 100000; do
    echo "| one strike, 16 materials, 8 channels, of $rate a second | $(per_strike "$before" $rate) | $(per_strike "$after" $rate) |"
done
