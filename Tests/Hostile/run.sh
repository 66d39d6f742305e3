#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Mutated files of every kind through the program: run.sh [COUNT] [SEED], 3,000 unless told.
set -eu
build=${PHYSVIB_BUILD:-$(dirname "$0")/../../build/release}
exec "$build/bin/physvib-hostile" "$build/bin/physvib" "${1:-3000}" "${2:-1}" 5
