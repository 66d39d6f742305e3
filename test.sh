#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing, builds, and runs every test: as released, then under the sanitizers.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_test_packages
for preset in release asan tsan; do
    build "$preset" all
    ctest --preset "$preset" -j2 --progress
done
