#!/bin/sh
# SPDX-License-Identifier: MIT
# Configures this tree with each part of it left out (the table of Docs/maintaining.md), with tests and without: nothing is compiled.
# Usage: options.sh FOLDER   (a new one, for its builds)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
failed=0
for option in $(sed -n 's/^| `PHYSVIB_\([A-Z]*\)` |.*/\1/p' "$root/Docs/maintaining.md"); do
    for tests in ON OFF; do
        build=$1/$option-$tests
        # what links JUCE takes half a minute to configure: HOST's own row is the one that has none of it
        if cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPHYSVIB_HOST=OFF -DPHYSVIB_TESTS=$tests "-DPHYSVIB_$option=OFF" >"$build.log" 2>&1; then
            echo "PHYSVIB_$option=OFF, tests $tests: configured"
        else
            echo "PHYSVIB_$option=OFF, tests $tests: $(grep -m 1 -A 2 'CMake Error' "$build.log" | tr -s '\n ' ' ')"
            failed=1
        fi
    done
done
exit $failed
