#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# every-fault.sh BIN_FOLDER: a device fails, or is silenced, at 20 moments of a trial, in each of six ways, in each of four kinds of tasks (480 trials); prints a table, and fails
# unless rows, samples that the device got and the report agree in all. Minutes, by hand and every night.
set -eu
bin=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
said=$(mktemp)
trap 'rm -f "$said"' EXIT
failed=0
echo "| task | fault | rows that left | felt again | loudest, g | row from recording, g, at most, of parts | agree |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for fault in 0 1 2 3 4 5; do
    PHYSVIB_FAULT=$fault "$here/../Mixer/Window/with-display.sh" "$bin/physvib-studies-tests" --gtest_filter='Tasks/DeviceFaults.*' >"$said" 2>&1 || failed=1
    grep '^| ' "$said" || failed=1
    [ $failed = 0 ] || grep -A 6 'Failure' "$said" | head -40
done
exit $failed
