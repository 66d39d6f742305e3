#!/bin/sh
# SPDX-License-Identifier: MIT
# Asks R about new random designs and compares every figure: installs R where it is missing, makes COUNT designs, runs the test on them.
# Usage: compare.sh STUDY_TESTS [COUNT [SEED]]      STUDY_TESTS: build/release/bin/physvib-study-tests; COUNT: 100 or more
set -eu
tests=$1
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=../../../.ci/packages.sh
. "$here/../../../.ci/packages.sh"
ensure_packages r-base-core r-cran-afex r-cran-car r-cran-rstatix
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
Rscript "$here/oracle.R" "${2:-1000}" "$folder" "${3:-1}"
PHYSVIB_DESIGNS=$folder "$tests" --gtest_filter=Statistics.AsInR
