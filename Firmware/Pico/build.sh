#!/bin/sh
# SPDX-License-Identifier: MIT
# The files that are dropped onto a Pico, by one command: build.sh [pico] [pico2], left out: pico. They are left in build/firmware/pico and
# build/firmware/pico2. The compiler and the SDK are fetched where they are missing; without a network it says what to bring.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
[ $# -gt 0 ] || set -- pico
for board in "$@"; do
    case $board in pico | pico2) ;; *) say "expected: build.sh [pico] [pico2]"; exit 2 ;; esac
done
sdk=/usr/src/pico-sdk # Debian 13's package
if [ ! -e $sdk/pico_sdk_init.cmake ]; then
    sdk=$PWD/build/pico/usr/src/pico-sdk
    [ -e "$sdk/pico_sdk_init.cmake" ] || .ci/pico-sources.sh
fi
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_pico_packages
for board in "$@"; do
    into=build/firmware/$board
    mkdir -p "$into"
    for channels in 4 8; do
        work=$into/work$channels log=$into/build$channels.log image=physvib-pico$channels
        { cmake -S Firmware/Pico -B "$work" -G Ninja -DPICO_SDK_PATH="$sdk" -DPICO_BOARD="$board" -DPHYSVIB_PICO_CHANNELS=$channels &&
            cmake --build "$work"; } >"$log" 2>&1 || { tail -n 20 "$log" >&2; say "the build failed: $log"; exit 1; }
        cp "$work/$image.uf2" "$work/$image.bin" "$into"
        echo "$into/$image.uf2"
    done
done
