#!/bin/sh
# SPDX-License-Identifier: MIT
# The addon and libphysvib under gcc's address and undefined-behaviour sanitizers, in Godot: what games do to nodes, hostile values, orders in
# which they are freed, characters, floors, textures. The first error ends a script. Makes FOLDER as Tests/godot.sh does, or uses it.
# Usage: Tests/godot-sanitized.sh FOLDER
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
tree=$(cd "$1" && pwd)
build=$root/build/godot-sanitized
# shellcheck source=Tests/Godot/tree.sh
. "$root/Tests/Godot/tree.sh"
make_tree
flags="-fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$flags" -DPHYSVIB_UNITY=ON -DPHYSVIB_HOST=OFF \
    -DPHYSVIB_RENDER=OFF -DPHYSVIB_PICTURES=OFF -DPHYSVIB_FIRMWARE=OFF -DPHYSVIB_TESTS=OFF -DPHYSVIB_INSTALL=OFF >/dev/null
# Godot opens addons with RTLD_DEEPBIND, which the sanitizers refuse.
printf '#define _GNU_SOURCE\n#include <dlfcn.h>\nvoid* dlopen(const char* path, int flags) {\n    return ((void* (*)(const char*, int))dlsym(RTLD_NEXT, "dlopen"))(path, flags & ~RTLD_DEEPBIND);\n}\n' |
    gcc -shared -fPIC -x c - -o "$tree/shallow.so"
preloaded=/shallow.so
for name in asan ubsan; do
    library=$(gcc -print-file-name=lib$name.so)
    soname=$(objdump -p "$library" | sed -n 's/ *SONAME *//p')
    cp -L "$library" "$tree/$soname"
    preloaded="$preloaded /$soname"
done
godot() { within physvib env LD_PRELOAD="$preloaded" ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0 UBSAN_OPTIONS=print_stacktrace=1 godot --headless "$@"; }
fill_project
mkdir "$project/.godot"
echo "res://addons/physvib/physvib.gdextension" >"$project/.godot/extension_list.cfg" # an import crashes Godot as slow as this (godot 111048)

failed=0
# check SCRIPT WORD...: it comes to its end, and the sanitizers say nothing.
check() {
    script=$1
    shift
    why=""
    godot -s "$script.gd" --fixed-fps 60 -- "$@" >"$project/out" 2>&1 || why="it failed"
    ! grep -qE "AddressSanitizer|runtime error:" "$project/out" || why="the sanitizers speak"
    echo "$script $*: ${why:-nothing found}"
    [ -z "$why" ] || { cat "$project/out" && failed=1; }
}
check nodes
check life
check outputs
check orders changes=100
check motors
check floors
for space in 2 3; do
    check character space=$space hz=60
    check textures space=$space hz=60 rolls
    check bounce space=$space hz=60 box
    check pair space=$space hz=60 alone
done
for demo in "$project"/addons/physvib/demos/*.tscn; do check demos "demo=res://addons/physvib/demos/${demo##*/}"; done
exit $failed
