#!/bin/sh
# SPDX-License-Identifier: MIT
# What the Pico's images are made of, beside this repository: its compiler, and the SDK and TinyUSB in build/pico. Then: cmake --preset release
# && cmake --build --preset release --target physvib-pico
# Without a network: on one that has it, `apt-get download pico-sdk-source tinyusb-source` on Debian 13, bring both files here and unpack them
# with `dpkg-deb -x FILE build/pico`.
set -eu
cd "$(dirname "$0")/.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_pico_packages
unpack_pico
say "the Pico's SDK is in build/pico"
