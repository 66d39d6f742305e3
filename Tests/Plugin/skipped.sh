#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs what a landing leaves out because it takes minutes, measures time or wants a machine of its own (Tests/House/skips.txt), without excuses.
# Usage: skipped.sh BIN_FOLDER
set -eu
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run() {
    "$@" >"$log" 2>&1 || { cat "$log"; exit 1; }
    ! grep '^\[  SKIPPED \]' "$log" || exit 1
    tail -n 1 "$log"
}
run "$1/physvib-engine-tests" --gtest_also_run_disabled_tests --gtest_filter='*.DISABLED_*'
run "$1/physvib-plugin-tests" --gtest_also_run_disabled_tests --gtest_filter='*.DISABLED_*:*.LiveIsTheBounce*-*ForHours*'
run "$(dirname "$0")/../Mixer/Window/with-display.sh" sh -c 'openbox & sleep 1; "$0"; got=$?; kill $!; exit $got' "$1/physvib-editor-keys"
