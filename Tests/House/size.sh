#!/bin/sh
# SPDX-License-Identifier: MIT
# How big the house is, one figure a line, each with its limit: C++ of the products and of the tests, and, where the programs
# are, what they take. A limit is what the tree has reached: lower it with the tree. Fails when one is exceeded.
# Usage: Tests/House/size.sh [ROOT [FOLDER_OF_PROGRAMS]], e.g. Tests/House/size.sh . build/release/bin
set -eu
cd "${1:-.}"
bin=${2:-}
products="Source Plugin Standalone Firmware"
failed=0

# say WHAT FIGURE LIMIT
say() {
    printf '%-44s %9s of %9s\n' "$1" "$2" "$3"
    [ "$2" -le "$3" ] || { echo "too much: $1" >&2; failed=1; }
}
cpp() { find "$@" -type f \( -name '*.h' -o -name '*.cpp' \); }
lines() { cpp "$@" | xargs cat | wc -l; }
bytes() { cpp "$@" | xargs cat | tr -d ' \t\n\r\f\v' | wc -c; }

say "products: lines of C++" "$(lines $products)" 117138
say "products: files of C++" "$(cpp $products | wc -l)" 643
say "products: bytes without white space" "$(bytes $products)" 4326702
say "tests: lines of C++" "$(lines Tests)" 83147
say "tests: files of C++" "$(cpp Tests | wc -l)" 433
if [ -n "$bin" ]; then
    say "tests: programs" "$(find "$bin" -maxdepth 1 -name 'physvib-*-tests' | wc -l)" 12
    if [ -x "$bin/physvib-session-tests" ]; then
        told=$("$bin/physvib-session-tests" --gtest_filter='SessionMemory.*' | sed -n 's/^sizeof RenderControl \([0-9]*\), PartPanners \([0-9]*\).* session \([0-9]*\) bytes$/\1 \2 \3/p')
        set -- $told
        say "sizeof RenderControl" "${1:-999999999}" 64
        say "sizeof PartPanners" "${2:-999999999}" 3200
        say "a prepared session: bytes" "${3:-999999999}" 2000000
    fi
    if [ -x "$bin/physvib-plugin-tests" ]; then
        told=$("$bin/physvib-plugin-tests" --gtest_filter='PluginMemory.*' | sed -n 's/^an instance of the plug-in, prepared: \([0-9]*\) bytes, .*/\1/p' | sort -n | tail -n 1)
        say "the largest prepared instance of the plug-in: bytes" "${told:-999999999}" 2000000
    fi
    if [ -x "$bin/physvib" ] && command -v valgrind >/dev/null; then
        counts=$(mktemp)
        valgrind --tool=callgrind --callgrind-out-file="$counts" "$bin/physvib" --version >/dev/null 2>&1
        say "physvib --version: instructions" "$(sed -n 's/^summary: //p' "$counts")" 12000000
        rm -f "$counts"
    fi
fi
exit $failed
