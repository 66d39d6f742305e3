#!/bin/sh
# SPDX-License-Identifier: MIT
# Simulates hours of a plug-in with automation and notes, and of `play --listen --save`: fails if memory grows by 1 MB after
# the first hour, and tells how long a step takes, hour by hour. A script beside the tests: ten hours take half of one.
# Usage: ten-hours.sh [HOURS (10)] [BIN_FOLDER]
set -eu
bin=${2:-$(cd "$(dirname "$0")/.." && pwd)/build/release/bin}
export PHYSVIB_HOURS="${1:-10}"
for tests in physvib-session-tests physvib-plugin-tests; do
    "$bin/$tests" --gtest_also_run_disabled_tests --gtest_brief=1 --gtest_filter='*ForHours.DISABLED*'
done
