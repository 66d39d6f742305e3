#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing, builds, and runs every test: as released, fuzzed for a moment, then under the sanitizers.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_test_packages
# A display takes the focus from a window now and then, so what clicks and types may be tried twice; nothing else under a sanitizer may.
run_tests() {
    ctest --preset "$1" -j2 --progress -LE 'live|display'
    ctest --preset "$1" -j2 -L display --repeat until-pass:2
}

build release all
run_tests release
# What plays in real time may be tried twice: the machine may be shared. Not under sanitizers, which are too slow for it.
ctest --preset release -L live --repeat until-pass:2
build asan all
Tests/Fuzz/run.sh 20000 >build/fuzz.log 2>&1 || { cat build/fuzz.log >&2; exit 1; }
run_tests asan
build tsan all
ctest --preset tsan -j2 --progress -LE live # none of its tests wants a display
