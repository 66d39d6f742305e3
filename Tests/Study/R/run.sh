#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh SCRIPT.R [WORDS]: runs it where R is there; else says so and ends with 77, by which a test is skipped by name.
command -v Rscript >/dev/null 2>&1 || { echo "Rscript (Debian: r-base-core) is not here: $1 was not run"; exit 77; }
exec Rscript "$@"
