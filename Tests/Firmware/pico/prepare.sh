# SPDX-License-Identifier: MIT
# Sourced by pico.sh and pico-linux.sh, in the root: the images, the emulator, what is expected at the pins, and what is played, in a folder that goes.
seconds=${1:-10}
images=${IMAGES:-} here=Tests/Firmware/pico
# shellcheck disable=SC2086 # a list of words
{ command -v node && command -v npm; } >/dev/null || ensure_packages $physvib_pico_test_packages
[ -n "$images" ] || { Firmware/Pico/build.sh pico >/dev/null && images=$PWD/build/firmware/pico; }
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
