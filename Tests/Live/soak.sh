#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# live.sh for ten minutes while every core is kept busy; a script beside the tests, since it takes as long as it plays.
# Usage: soak.sh [SECONDS] [message|thread] [BLOCK_FRAMES] [jackd mode: -S, or -s for asynchronous]
set -eu
cd "$(dirname "$0")/../.."
for _ in $(seq "$(nproc)"); do
    (while :; do :; done) &
    load="${load:-} $!"
done
trap 'kill $load 2>/dev/null' EXIT
Tests/Live/live.sh "$PWD/build/release/bin" "${1:-600}" "${2:-message}" "${3:-512}" "${4:--S}"
