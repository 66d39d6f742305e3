#!/bin/sh
# SPDX-License-Identifier: MIT
# The Pico's images under rp2040js, an emulator written by others: pico.sh [SECONDS (10)]. Every frame of the scene shake-the-box at the I2S pins
# against this computer's compiler, packets that are late, missing or of wrong sizes, alternate settings, random requests, suspend, reset, the
# watchdog. Needs physvib-render, what Firmware/Pico/build.sh needs, and npm's registry, or the emulator's package unpacked where RP2040JS says.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
seconds=${1:-10}
images=$PWD/build/firmware/pico here=Tests/Firmware/pico
# shellcheck disable=SC2086 # a list of words
{ command -v node && command -v npm; } >/dev/null || ensure_packages $physvib_pico_test_packages
Firmware/Pico/build.sh pico >/dev/null
render=${RENDER:-$PWD/build/release/bin/physvib-render}
[ -x "$render" ] || { say "no $render: cmake --preset release, then its target physvib-render; or say where it is: RENDER=PATH"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if [ -z "${RP2040JS:-}" ]; then
    (cd "$folder" && npm pack --silent rp2040js@1.4.1 >/dev/null && tar xzf rp2040js-1.4.1.tgz)
    RP2040JS=$folder/package
fi
export RP2040JS
g++ -std=c++20 -O2 -ISource -IFirmware/Pico $here/expected.cpp -o "$folder/expected"
/usr/bin/python3 $here/signals.py "$folder" "$seconds" "$render"
for channels in 4 8; do
    image=$images/physvib-pico$channels.bin
    node $here/frames.mjs "$image" $channels "$folder/expected" full "$folder/scene$channels.raw" "shake the box"
    node $here/frames.mjs "$image" $channels "$folder/expected" full "$folder/slow$channels.raw" "slow and loud (the guard acts)"
    node $here/frames.mjs "$image" $channels "$folder/expected" low "$folder/slow$channels.raw" "slow and loud, low ceiling"
    node $here/faults.mjs "$image" $channels
done
echo "pico.sh: all of it held"
