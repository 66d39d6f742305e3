#!/bin/sh
# SPDX-License-Identifier: MIT
# The rooms without JUCE on 64-bit Windows, beside CI: cross-built, tested under Wine, and held against this machine's renders.
# Needs some packages and, the first time, half an hour.
# usage: Tests/windows.sh [PATH/physvib-render]
set -eu
cd "$(dirname "$0")/.."
native=${1:-build/release/bin/physvib-render}
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_cross_packages
system=windows
folder=build/windows
suffix=.exe
roots=""
mkdir -p "$folder"
. Tests/Cross/cross.sh

libraries
house
export WINEDEBUG=-all WINEPREFIX="$PWD/$folder/wine" WINEDLLOVERRIDES="mscoree=;mshtml="
unset DISPLAY
run=wine
[ -e "$WINEPREFIX/system.reg" ] || quietly "$folder/wine.log" timeout 300 wine wineboot --init
trap 'wineserver -k >/dev/null 2>&1 || true' EXIT
tests core wire io contacts physics scene study formats measure api system
compare "$native" drawing fruit-basket
