#!/bin/sh
# SPDX-License-Identifier: MIT
# Fuzzed worlds whose owners break the rules, under the address sanitizer, with Box2D compiled from Debian's source and an allocator that
# gives every block back at once (PlainMemoryTest.cpp): 200 of 1,500 steps, or as many as are told. Needs a network for the source.
# Usage: freed.sh [SEEDS [STEPS]]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
[ -n "${KEEP:-}" ] || trap 'rm -rf "$folder"' EXIT
cd "$folder"
. "$root/.ci/packages.sh"
from_debian "$folder" source box2d
mv box2d-*/ box2d
flags="-std=c++20 -O1 -g -fsanitize=address -I$folder/box2d/include"
# Box2D's own allocator is left out: the tests have another.
find box2d/src -name '*.cpp' ! -name b2_block_allocator.cpp | xargs -P2 -I{} sh -c "c++ $flags -I$folder/box2d/src -w -c {} -o \$(echo {} | tr / _).o"
find "$root/Source/Contacts" "$root/Source/Physics" -name '*.cpp' |
    xargs -P2 -I{} sh -c "c++ $flags -ffp-contract=off -I$root/Source -c {} -o $folder/\$(echo {} | tr / _).o"
c++ $flags -I"$root/Source" -I"$root/Tests" "$root/Tests/Physics/BrokenRulesTest.cpp" "$root/Tests/Physics/PlainMemoryTest.cpp" ./*.o \
    -lgtest -lgtest_main -o freed
PHYSVIB_SEEDS=${1:-200} PHYSVIB_STEPS=${2:-1500} ./freed
