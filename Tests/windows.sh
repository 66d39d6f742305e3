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
# Rooms that are not built there have files for it too: they compile, each as CMake would.
for file in $(find Source Standalone Plugin -name '*Windows.cpp'); do
    quietly "$folder/syntax.log" x86_64-w64-mingw32-g++-posix -std=c++20 -Wall -Wextra -Werror -fsyntax-only -ISource -IStandalone -I"$folder/house/include" "$file"
done
say "files of Windows alone: $(find Source Standalone Plugin -name '*Windows.cpp' | wc -l) compile"
export WINEDEBUG=-all WINEPREFIX="$PWD/$folder/wine" WINEDLLOVERRIDES="mscoree=;mshtml="
unset DISPLAY
run=wine
[ -e "$WINEPREFIX/system.reg" ] || quietly "$folder/wine.log" timeout 300 wine wineboot --init
trap 'wineserver -k >/dev/null 2>&1 || true' EXIT
tests engine api system
export PHYSVIB_OTHER_SINE=1
compare "$native" drawing fruit-basket
