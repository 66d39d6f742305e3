#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing, builds as released and runs every test; then what parses, what hands memory over and what is concurrent again
# under the sanitizers, and every parser is fuzzed for a moment. What takes hours: Tests/nightly.sh.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_test_packages

build release all
ctest --preset release -j2 --progress -LE 'live|display'
# A display takes the focus from a window now and then, and what plays in real time shares the machine: both may be tried twice.
ctest --preset release -j2 -L display --repeat until-pass:2
ctest --preset release -L live --repeat until-pass:2
build asan physvib-checked physvib-fuzzers
Tests/Fuzz/run.sh 20000 1 >build/fuzz.log 2>&1 || { cat build/fuzz.log >&2; exit 1; }
ctest --preset asan -j2 --progress -L checked
build tsan physvib-checked
ctest --preset tsan -j2 --progress -L checked
