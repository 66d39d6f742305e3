#!/bin/sh
# SPDX-License-Identifier: MIT
# Fuzzes every parser from its corpus: run.sh [INPUTS [SEED]], 100,000 for each unless told; 10,000,000 is a long afternoon.
# test.sh gives a seed, so that a change fails for what it changed; without one every run tries other inputs, as the nightly run does.
# Ends at the first fault, whose input it leaves in build/asan/findings: also one that takes 5 s, 1 GB with what the sanitizer takes, or asks for 300 MB at once.
set -eu
cd "$(dirname "$0")/../.."
inputs=${1:-100000}
seed=${2:-0} # 0: libFuzzer takes another each time
build=${PHYSVIB_FUZZ_BUILD:-build/asan}
mkdir -p "$build/findings"
for name in actuator ahap calls coupling events haptic hjif input layout materials message osc pad protocol scene session sound state study wire words; do
    mkdir -p "$build/corpus/$name" "Tests/Fuzz/corpus/$name" # what libFuzzer finds worth keeping; the first folder is the one it writes to
    echo "fuzz: $name, $inputs inputs"
    "$build/bin/physvib-fuzz-$name" -runs="$inputs" -seed="$seed" -max_len=8192 -timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=300 -verbosity=0 -dict=Tests/Fuzz/words.dict -print_final_stats=1 \
        -artifact_prefix="$build/findings/$name-" "$build/corpus/$name" "Tests/Fuzz/corpus/$name"
done
