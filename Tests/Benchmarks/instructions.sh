#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Instructions per block and per strike, counted by callgrind: the same number however busy the machine is. Callgrind's
# processor has AVX2 at best. Each figure is the difference of two runs, so start-up does not count.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_library_packages valgrind
build library physvib-core
program=build/instruction-run
g++ -std=c++20 -O2 -ffp-contract=off -ISource -ITests/Benchmarks Tests/Benchmarks/InstructionRun.cpp build/library/lib/libphysvib-core.a -lhwy -o $program

count() { # CHANNELS STRIKES MODES SECONDS: instructions
    valgrind --tool=callgrind --callgrind-out-file=/dev/null $program "$@" 2>&1 | awk '/Collected/ { print $4 }'
}
per_block() { # CHANNELS STRIKES MODES: in the third second
    echo $((($(count "$1" "$2" "$3" 3) - $(count "$1" "$2" "$3" 2)) / 750))
}
echo "| AVX2, whole chain | instructions |"
echo "| --- | --- |"
echo "| one silent 64-frame block, 8 channels | $(per_block 8 0 1) |"
for channels in 4 8; do
    echo "| one 64-frame block, 64 modes x $channels channels, each struck once a second | $(per_block $channels 64 64) |"
done
flat=$(per_block 8 16 16)
rained=$(per_block 8 100000 16)
echo "| one strike, 16 materials, 8 channels, of 100,000 a second | $(((rained - flat) * 750 / 99984)) |"
