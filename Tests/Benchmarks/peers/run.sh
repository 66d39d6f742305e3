#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds what is compiled, installs what Debian has, and compares (a few minutes). Not part of the tests: it wants the machine.
# usage: run.sh [VOICES]
set -eu
cd "$(dirname "$0")/../../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_library_packages python3 faust libstk-dev csound supercollider-server puredata-core
voices=${1:-64}
here=Tests/Benchmarks/peers
out=$PWD/build/peers
mkdir -p "$out"
build library physvib-core
PYTHONPATH=$here python3 - "$voices" >"$out/voices.dsp" <<'END'
import sys
import compare, formats
print(formats.as_faust(compare.make_voices(int(sys.argv[1]))))
END
compile() { # NAME SOURCE FLAGS...: everybody else gets the flags that suit it best
    name=$1
    source=$2
    shift 2
    g++ -std=c++20 -I$here "$@" -o "$out/$name" $here/"$source" $libraries
}
libraries="build/library/lib/libphysvib-core.a -lhwy"
compile ours ours.cpp -O3 -ISource
compile chain ours.cpp -O3 -ISource -DCHAIN=128
compile chain-across ours.cpp -O3 -ISource -DCHAIN=47
libraries=
compile naive-O3 naive.cpp -O3 -DREAL=double
compile simd simd.cpp -Ofast -march=native
compile naive-Ofast naive.cpp -Ofast -march=native -DREAL=float
for precision in single double; do
    name=faust-$([ $precision = single ] && echo float || echo double)
    faust -lang cpp -$precision -cn Generated "$out/voices.dsp" -o "$out/$name.h"
    compile "$name" faust.cpp -Ofast -march=native "-DGENERATED=\"$out/$name.h\"" "-DFAUSTFLOAT=float"
done
libraries=-lstk
compile stk stk.cpp -Ofast -march=native
PYTHONDONTWRITEBYTECODE=1 python3 $here/compare.py "$out" "$voices"
