#!/bin/sh
# SPDX-License-Identifier: MIT
# The addon in Godot itself, headless: a bouncing ball in three engines at four tick rates, what games do to a
# world, and the demos. Debian 12 has no Godot 4: a tree of Debian's unstable is made in FOLDER, or used if it is
# there (1.4 GB). Needs root, debootstrap and a network.
# Usage: Tests/godot.sh BUILD FOLDER
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
tree=$(cd "$2" && pwd)
if [ ! -x "$tree/usr/bin/godot" ]; then
    debootstrap --variant=minbase sid "$tree" >"$tree.log"
    chroot "$tree" apt-get install -y --no-install-recommends godot >>"$tree.log"
fi
project=$tree/physvib
rm -rf "$project"
mkdir -p "$project/libraries"
godot() { chroot "$tree" env HOME=/physvib LD_LIBRARY_PATH=/physvib/libraries sh -c 'cd /physvib && exec timeout 120 godot --headless "$@"' sh "$@"; }

godot --dump-gdextension-interface >"$project/log"
cmake -DPHYSVIB_GODOT_HEADER="$project" "$build" >>"$project/log"
cmake --build "$build" --target physvib-godot >>"$project/log" || { cat "$project/log" && exit 1; }
cp -r "$build/godot/addons" "$root"/Tests/Godot/. "$project"
# What this Debian has in other versions than the tree: beside it, as a game would bring it.
ldd "$build"/godot/addons/physvib/bin/*.so* | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | sort -u | while read -r library; do
    [ -e "$tree/usr/lib/x86_64-linux-gnu/${library##*/}" ] || cp -L "$library" "$project/libraries"
done
rm -f "$project"/libraries/libphysvib* "$project"/libraries/libhwy.so*
godot --import --frame-delay 1000 >>"$project/log" 2>&1 # without a delay Godot crashes (godot 111048)

failed=0
echo "| engine | ticks/s | onset, ms | strength, % | hits | |"
echo "| --- | --- | --- | --- | --- | --- |"
for engine in GodotPhysics3D "Jolt Physics"; do
    cp "$root/Tests/Godot/project.godot" "$project"
    echo "3d/physics_engine=\"$engine\"" >>"$project/project.godot"
    for space in 2 3; do
        [ "$engine$space" != "Jolt Physics2" ] || continue # the plane has one engine
        for shape in ball box; do
            for rate in 30 60 120 240; do
                godot -s bounce.gd --fixed-fps "$rate" -- "space=$space" "hz=$rate" "$shape" >"$project/out" 2>&1 || failed=1
                sed -n "s/^| /| $shape, /p" "$project/out" | grep . || { cat "$project/out" && failed=1; }
            done
        done
        for rate in 60 240; do
            for act in "character.gd" "textures.gd rolls" "textures.gd slides"; do
                # shellcheck disable=SC2086 # a script and its word
                set -- $act
                godot -s "$1" --fixed-fps "$rate" -- "space=$space" "hz=$rate" ${2:-} >"$project/out" 2>&1 || failed=1
                grep -E '^(right|WRONG)' "$project/out" || { cat "$project/out" && failed=1; }
            done
        done
        for rate in 30 240; do
            for striker in alone observed; do
                godot -s pair.gd --fixed-fps "$rate" -- "space=$space" "hz=$rate" "$striker" >"$project/out" 2>&1 || failed=1
                grep "pair in" "$project/out" || { cat "$project/out" && failed=1; }
            done
        done
    done
done
godot -s outputs.gd --fixed-fps 60 >"$project/out" 2>&1 || failed=1
grep -E '^(WRONG|[0-9]+ wrong)' "$project/out" || failed=1
godot -s life.gd --fixed-fps 60 >"$project/out" 2>&1 || failed=1
grep -E '^(right|WRONG|[0-9]+ wrong)' "$project/out" || failed=1
grep -q '^0 wrong' "$project/out" || failed=1
for demo in "$project"/addons/physvib/demos/*.gd; do
    name=${demo##*/}
    godot -s "demos.gd" --fixed-fps 60 -- "demo=res://addons/physvib/demos/$name" >"$project/out" 2>&1 || failed=1
    grep "^$name: [1-9][0-9]* hits" "$project/out" || { cat "$project/out" && failed=1; }
    ! grep -q "SCRIPT ERROR" "$project/out" || { cat "$project/out" && failed=1; }
done
exit $failed
