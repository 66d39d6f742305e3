#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Instructions per block, per strike and per step of physics, counted by callgrind: the same number however busy the machine
# is. Callgrind's processor has AVX2 at best. Start-up does not count: only the function `counted` of each program does.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_library_packages valgrind
build library physvib-core physvib-contacts physvib-physics
program=build/instruction-run
g++ -std=c++20 -O2 -ffp-contract=off -ISource -ITests/Benchmarks Tests/Benchmarks/InstructionRun.cpp build/library/lib/libphysvib-core.a -lhwy -o $program
steps=build/step-run
g++ -std=c++20 -O2 -ffp-contract=off -ISource -ITests/Benchmarks Tests/Benchmarks/StepRun.cpp build/library/lib/libphysvib-physics.a \
    build/library/lib/libphysvib-contacts.a build/library/lib/libphysvib-core.a -lhwy -lbox2d -o $steps

counted() { # PROGRAM ARGUMENTS...: instructions
    count=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=counted "$@" 2>&1 | awk '/Collected/ { print $4 }')
    [ "${count:-0}" -gt 0 ] || { echo "instructions.sh: valgrind ended $*: expected a processor that it knows" >&2; kill $$; }
    echo "$count"
}
per_step() { # WORLD BODIES OPTION: from the 100th step to the 300th, which alone are counted: exact
    echo $(($(counted $steps "$@" 300) / 200))
}
more() { # BEFORE AFTER: in per cent
    awk "BEGIN { printf \"%+.1f %%\", 100 * ($2 / $1 - 1) }"
}
per_block() { # CHANNELS STRIKES MODES: in the third second
    echo $(($(counted $program "$1" "$2" "$3" 3) / 750))
}
echo "| AVX2, whole chain | instructions |"
echo "| --- | --- |"
echo "| one silent 64-frame block, 8 channels | $(per_block 8 0 1) |"
for channels in 4 8; do
    chain=$(per_block $channels 64 64)
    bank=$(per_block $channels -1 64)
    echo "| one 64-frame block, 64 modes x $channels channels, each struck once a second | $chain; $(awk "BEGIN { printf \"%.2f\", $chain / $bank }") times the bank alone |"
done
flat=$(per_block 8 16 16)
rained=$(per_block 8 100000 16)
echo "| one strike, 16 materials, 8 channels, of 100,000 a second | $(((rained - flat) * 750 / 99984)) |"

echo
echo "| a step of Box2D and its attachment | instructions |"
echo "| --- | --- |"
for bodies in 10 100 1000; do
    alone=$(per_step box $bodies -1)
    echo "| $bodies bodies in a shaken box, Box2D alone | $alone |"
    for cameras in 0 4 5000; do
        felt=$(per_step box $bodies $cameras)
        who="every body is a haptic source"
        [ $cameras -ne 0 ] || who="no haptic source"
        [ $cameras -ne 4 ] || who="four haptic sources"
        echo "| the same attached, $who | $felt ($(more "$alone" "$felt")) |"
    done
done
alone=$(per_step balls 100 -1)
echo "| 100 balls roll, Box2D alone | $alone |"
smooth=$(per_step balls 100 0)
echo "| the same attached, a smooth floor | $smooth ($(more "$alone" "$smooth")) |"
for mm in 10000 20 5 2; do
    rough=$(per_step balls 100 $mm)
    echo "| the same attached, grains of $mm mm | $rough ($(more "$alone" "$rough"); over the smooth floor $(more "$smooth" "$rough")) |"
done
