#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the addon for Godot: build/godot/addons/physvib, which one copies into a project, and the same as build/godot/physvib-VERSION.zip, as the asset library takes it.
# GODOT is a program of Godot 4.4 or newer, which writes the header that the addon is compiled with; what compiles it comes from Debian.
# usage: Source/Api/Godot/build-addon.sh GODOT
set -eu
[ $# -eq 1 ] || { echo "usage: Source/Api/Godot/build-addon.sh GODOT" >&2; exit 1; }
godot=$(command -v "$1") || { echo "physvib: expected a program of Godot 4, found $1" >&2; exit 1; }
godot=$(cd "$(dirname "$godot")" && pwd)/$(basename "$godot")
cd "$(dirname "$0")/../../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_build_packages $physvib_run_packages

work=$PWD/build/godot
mkdir -p "$work"
say "building the addon (log: build/godot/build.log)"
if ! { (cd "$work" && HOME=$work "$godot" --headless --dump-gdextension-interface) && [ -f "$work/gdextension_interface.h" ] &&
    cmake --preset release -DPHYSVIB_GODOT_HEADER="$work" && cmake --build --preset release --target physvib-godot; } >"$work/build.log" 2>&1; then
    cat "$work/build.log" >&2
    exit 1
fi
rm -rf "$work/addons" "$work"/*.zip
cp -r build/release/godot/addons "$work"
cp /usr/share/doc/libhwy1/copyright "$work/addons/physvib/bin/libhwy-LICENSE"
strip --strip-unneeded "$work"/addons/physvib/bin/*.so* # a licence lies there, too
version=$(sed -n 's/^version="\(.*\)"/\1/p' "$work/addons/physvib/plugin.cfg")
(cd "$work" && cmake -E tar cf "physvib-$version.zip" --format=zip addons)
say "build/godot/physvib-$version.zip: $(wc -c <"$work/physvib-$version.zip") bytes"
say "build/godot/addons is ready: copy it into your project"
