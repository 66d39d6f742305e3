#!/bin/sh
# SPDX-License-Identifier: MIT
# One hash of the samples of each render, the same on every machine: of a list on several layouts and of all scenes, in double precision (scalar) and by
# vectors (SSE4, AVX2, AVX-512, NEON). What differs from hashes.txt is printed, and is the exit code for lists; for scenes where the C
# library is Debian 12's, unless PHYSVIB_OTHER_SINE is set: Box2D turns bodies by its sinf and cosf.
# usage: hashes.sh PATH/physvib-render [WORD...]   (words before the program, as: wine)
#        hashes.sh --update PATH/physvib-render
set -eu
here=$(cd "$(dirname "$0")" && pwd)
update=no
[ "$1" != --update ] || { update=yes; shift; }
render=$(realpath "$1")
shift
run=$* # the words before the program
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# 300 hits of many materials, by whole numbers, so that every awk writes the same.
awk 'BEGIN {
    print "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m"
    n = 1
    for (i = 0; i < 300; ++i) {
        for (k = 0; k < 5; ++k) { n = (n * 1103 + 12345) % 65536; r[k] = n }
        printf "%d.%03d,%d,%d,0.%03d,%d.%02d,%d.%02d\n", i / 60, i % 60 * 16, 40 + r[0] % 40 * 11, 3 + r[1] % 12 * 7, 1 + r[2] % 300, r[3] % 6, r[3] % 100, r[4] % 3, r[4] % 100
    }
}' >list.csv

# row NAME SET COLUMN ARGUMENT...
row() {
    name=$1 set=$2 column=$3
    shift 3
    rm -f a.wav
    $run "$render" "$@" --instructions "$set" --seconds 6 --out a.wav </dev/null >/dev/null 2>error.txt || { grep -q "has no" error.txt || cat error.txt >&2; return 0; }
    begin=$(grep -abo data a.wav | head -n 1 | cut -d: -f1) # of the samples: what is before them names the version
    printf '%s,%s,%s\n' "$name" "$column" "$(tail -c "+$((begin + 9))" a.wav | sha256sum | cut -c1-16)"
}
for set in scalar sse4 avx2 avx512 neon; do
    [ $set = scalar ] && column=scalar || column=vectors
    for layout in phone1 phone4 ring3 pico8 vest16; do row "list $layout" $set $column list.csv --layout $layout --field 6.4,3.6; done
    for scene in "$here"/../../Source/Scene/Scenes/*.json; do
        scene=$(basename "$scene" .json)
        [ "$scene" = scene.schema ] || row "scene $scene" $set $column "$scene" --seed 3
    done
done | sort -u >got.txt
if [ $update = yes ]; then
    cp got.txt "$here/hashes.txt"
    exit 0
fi
# A column that this machine lacks has no rows; one that has must be whole, and there must be one hash of each render.
cut -d, -f1-2 got.txt | uniq -d >twice.txt
grep -vxF -f "$here/hashes.txt" got.txt >other.txt || true
echo "physvib: $(wc -l <got.txt) hashes, $(cut -d, -f2 got.txt | sort -u | tr '\n' ' ')columns: $(wc -l <other.txt) differ, $(wc -l <twice.txt) differ between sets of one column" >&2
cat other.txt twice.txt >&2
[ "$(grep -c ,scalar, got.txt)" -eq "$(grep -c ,scalar, "$here/hashes.txt")" ]
[ "$(getconf GNU_LIBC_VERSION)" = "glibc 2.36" ] || PHYSVIB_OTHER_SINE=1
[ -z "${PHYSVIB_OTHER_SINE:-}" ] || sed -i '/^scene /d' other.txt twice.txt
[ ! -s other.txt ] && [ ! -s twice.txt ]
