#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs every benchmark (some four minutes) and writes table and plot of Docs/speed.md. On a quiet machine, if there is one.
set -eu
cd "$(dirname "$0")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target physvib-bench
out=build/speed.json
build/release/bin/physvib-bench --benchmark_out=$out --benchmark_out_format=json "$@"
python3 Tests/Benchmarks/report.py $out Docs/speed.md Docs/speed.svg
