#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds both C libraries and compares what they show with the baseline in abi/: see abi.py. --renew: they become the baseline, for a release.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_abi_packages
build release physvib-c physvib-live
python3 Tests/Release/abi.py . build/release/lib "$@"
