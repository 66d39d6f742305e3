#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing, builds as released and runs every test; then what parses, what hands memory over and what is concurrent again
# under the sanitizers, and every parser is fuzzed for a moment. What takes hours: Tests/nightly.sh.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_test_packages

# tests PRESET NAME OPTION...: those of CTest; what they say of themselves, in full, is kept for skipped.py.
tests() {
    preset=$1 report=$PWD/build/tests-$2.xml
    shift 2
    ctest --preset "$preset" --output-junit "$report" --test-output-size-passed 1000000 "$@"
}

build release all
tests release quiet -j2 --progress -LE 'live|display'
# A display takes the focus from a window now and then, and what plays in real time shares the machine: both may be tried twice.
tests release display -j2 -L display --repeat until-pass:2
tests release live -L live --repeat until-pass:2
build asan physvib-checked physvib-fuzzers
Tests/Fuzz/run.sh 20000 1 >build/fuzz.log 2>&1 || { cat build/fuzz.log >&2; exit 1; }
tests asan asan -j2 --progress -L checked
# Nothing is left out in silence.
Tests/House/skipped.py build/release build/tests-quiet.xml build/tests-display.xml build/tests-live.xml build/tests-asan.xml
build tsan physvib-checked
tests tsan tsan -j2 --progress -L checked
Tests/House/skipped.py --quiet build/release build/tests-tsan.xml
