#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the table of latencies in Docs/timings.md, measured through JACK servers without hardware; fails if L is not kept.
# Usage: latency.sh [BIN_FOLDER] [SECONDS] [BLOCKS]
set -eu
bin=${1:-$(dirname "$0")/../../build/release/bin} seconds=${2:-6} blocks=${3:-64 128 512}
. "$(dirname "$0")/jack.sh"
echo "| driver | block | L, by the law | contact to port, measured | the device's own | sum | late events | equal blocks |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- |"
failed=0
for driver in "message 100" "thread 100" "thread 1000" "thread 4000"; do
    for block in $blocks; do
        serve 48000 "$block" 8
        "$bin/physvib-latency-meter" $driver "$seconds" || failed=1
        close_server
    done
done
exit "$failed"
