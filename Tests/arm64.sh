#!/bin/sh
# SPDX-License-Identifier: MIT
# The rooms without JUCE on a 64-bit Arm processor, beside CI: cross-built, tested under qemu, and held against this machine's renders.
# Needs some packages and, the first time, half an hour.
# usage: Tests/arm64.sh [PATH/physvib-render]
set -eu
cd "$(dirname "$0")/.."
native=${1:-build/release/bin/physvib-render}
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_cross_packages
system=arm64
folder=build/arm64
suffix=""
mkdir -p "$folder"
. Tests/Cross/cross.sh

libraries
debs=$PWD/$folder/debs
if [ ! -e "$debs/whole" ]; then # what Session has of the system
    mkdir -p "$debs"
    PHYSVIB_ARCHITECTURE=arm64 from_debian "$debs" download libserialport0 libserialport-dev libsamplerate0 libsamplerate0-dev
    for deb in "$debs"/*.deb; do dpkg-deb -x "$deb" "$debs"; done
    : >"$debs/whole"
fi
roots=$debs
libs=$debs/usr/lib/aarch64-linux-gnu
export PKG_CONFIG_LIBDIR="$libs/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$debs"
run="qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=$libs"
house -DPHYSVIB_SESSION=ON -DCMAKE_BUILD_RPATH="$libs"
tests engine api session
compare "$native" marbles fruit-basket
