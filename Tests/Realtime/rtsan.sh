#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the tests that render under RealtimeSanitizer, which stops at the first thing a render role must not do, in
# everything marked PHYSVIB_NONBLOCKING. Needs clang 20 or later with its runtime (Debian: clang-22 libclang-rt-22-dev).
# Usage: rtsan.sh [host]: the renderer and its queues; with `host` sessions and outputs too, which compiles JUCE
set -eu
cd "$(dirname "$0")/../.."
compiler=
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/planted.cpp" <<'END'
#include <cstdlib>
void* volatile kept;
void render() noexcept [[clang::nonblocking]] { kept = std::malloc(4); }
int main() { render(); }
END
for candidate in clang++ clang++-20 clang++-21 clang++-22 clang++-23; do
    if "$candidate" -fsanitize=realtime "$folder/planted.cpp" -o "$folder/planted" 2>/dev/null; then compiler=$candidate; fi
done
if [ -z "$compiler" ]; then
    echo "rtsan: no clang with -fsanitize=realtime here (Debian: clang-22 libclang-rt-22-dev); nothing was checked"
    exit 0
fi
if "$folder/planted" 2>"$folder/said"; then
    echo "rtsan: $compiler does not find a planted malloc" >&2
    exit 1
fi
grep -q "unsafe-library-call" "$folder/said"
build=build/rtsan
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER="$compiler" -DPHYSVIB_SANITIZE=realtime >"$folder/log" 2>&1 &&
    cmake --build "$build" -j2 --target physvib-core-tests ${1:+physvib-session-tests physvib-host-tests} >>"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
"$build/bin/physvib-core-tests" --gtest_brief=1 --gtest_filter='HapticRenderer*:ModeBank*:LinkedLimiter*:EventQueue*:LatestValue*:*Renderer*'
if [ -n "${1:-}" ]; then
    "$build/bin/physvib-session-tests" --gtest_brief=1 --gtest_filter='Session*:OfflineRender*:Onsets*'
    "$build/bin/physvib-host-tests" --gtest_brief=1 --gtest_filter='Session*:AudioOutput*'
fi
echo "rtsan: $compiler found nothing in what is marked nonblocking (a planted malloc it did)"
