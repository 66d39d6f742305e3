#!/bin/sh
# SPDX-License-Identifier: MIT
# What the Pico's images are made of, beside this repository: its compiler, and the SDK and TinyUSB in build/pico. Firmware/Pico/build.sh does
# the rest, and calls this where it is needed.
set -eu
cd "$(dirname "$0")/.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_pico_packages
if ! unpack_pico; then
    say "could not fetch the Pico's SDK from deb.debian.org. Without a network: on a computer that has one, with Debian 13, type"
    say "  apt-get download pico-sdk-source tinyusb-source"
    say "bring both files here, and for each of them: dpkg-deb -x FILE $PWD/build/pico"
    exit 1
fi
say "the Pico's SDK is in build/pico"
