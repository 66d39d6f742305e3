#!/bin/sh
# SPDX-License-Identifier: MIT
# The Pico's images under rp2040js, an emulator written by others: pico.sh [SECONDS (10)]. Every frame of the scene shake-the-box at the I2S pins
# against this computer's compiler, packets that are late, missing or of wrong sizes, alternate settings, random requests, suspend, reset, the
# watchdog. Needs physvib-render, what Firmware/Pico/build.sh needs, and npm's registry, or the emulator's package unpacked where RP2040JS says. IMAGES: a folder of images to try instead of new ones.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
. Tests/Firmware/pico/prepare.sh
for channels in 4 8; do
    image=$images/physvib-pico$channels.bin
    node $here/frames.mjs "$image" $channels "$folder/expected" full "$folder/scene$channels.raw" "shake the box"
    node $here/frames.mjs "$image" $channels "$folder/expected" full "$folder/slow$channels.raw" "slow and loud (the guard acts)"
    node $here/frames.mjs "$image" $channels "$folder/expected" low "$folder/slow$channels.raw" "slow and loud, low ceiling"
    node $here/faults.mjs "$image" $channels
done
echo "pico.sh: all of it held"
