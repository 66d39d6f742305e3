#!/bin/sh
# SPDX-License-Identifier: MIT
# What parses and what hands memory over under the address sanitizer, every parser fuzzed for a moment, what is concurrent under the thread sanitizer.
# test.sh tells whether these files passed (passed.sh); the night runs it. Other modules: Tests/nightly.sh asan tsan.
# Usage: sanitizers.sh [--keep] [SKIPPED_PY_OPTION...]; --keep writes down that these files passed.
set -eu
cd "$(dirname "$0")/.."
. .ci/packages.sh
keep=
[ "${1:-}" != --keep ] || { keep=--keep && shift; }
checked() { # PRESET [SKIPPED_PY_OPTION...]
    preset=$1
    shift
    ctest --preset "$preset" --output-junit "$PWD/build/tests-$preset.xml" --test-output-size-passed 1000000 -j2 --progress -L checked
    Tests/House/skipped.py --quiet "$@" build/release "build/tests-$preset.xml"
}
build asan physvib-checked physvib-fuzzers
Tests/Fuzz/run.sh 20000 1 >build/fuzz.log 2>&1 || { cat build/fuzz.log >&2; exit 1; }
checked asan "$@"
build tsan physvib-checked
checked tsan "$@"
[ -z "$keep" ] || Tests/passed.sh sanitizers --keep
