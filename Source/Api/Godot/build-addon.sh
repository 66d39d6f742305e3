#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the addon for Godot: build/godot/addons/physvib, which one copies into a project, and the same as build/godot/physvib-VERSION.zip, as the asset library takes it.
# GODOT is a program of Godot 4.4 or newer, which writes the header that the addon is compiled with, or that header; what compiles it comes from Debian.
# With arm64 or windows it holds that system's library as well, cross-built as Tests/arm64.sh and Tests/windows.sh do; the first time that takes half an hour.
# PHYSVIB_BUILD: a build folder of this tree that compiles it, instead of build/release.
# usage: Source/Api/Godot/build-addon.sh GODOT [arm64] [windows]
set -eu
[ $# -ge 1 ] || { echo "usage: Source/Api/Godot/build-addon.sh GODOT [arm64] [windows]" >&2; exit 1; }
godot=$1
[ -f "$godot" ] || godot=$(command -v "$godot") || { echo "physvib: expected a program of Godot 4 or its header, found $1" >&2; exit 1; }
godot=$(realpath "$godot")
shift
cd "$(dirname "$0")/../../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
[ -n "${PHYSVIB_BUILD:-}" ] || ensure_build_packages $physvib_run_packages

work=$PWD/build/godot
mkdir -p "$work"
say "building the addon (log: build/godot/build.log)"
build=${PHYSVIB_BUILD:-build/release}
header() { case $godot in *.h) cp "$godot" "$work/gdextension_interface.h" ;; *) cd "$work" && HOME=$work "$godot" --headless --dump-gdextension-interface ;; esac; }
configure() { if [ -n "${PHYSVIB_BUILD:-}" ]; then cmake "$build" "$@"; else cmake --preset release "$@"; fi; }
if ! { (header) && [ -f "$work/gdextension_interface.h" ] &&
    configure -DPHYSVIB_GODOT_HEADER="$work" && cmake --build "$build" --target physvib-godot; } >"$work/build.log" 2>&1; then
    cat "$work/build.log" >&2
    exit 1
fi
rm -rf "$work/addons" "$work"/*.zip
cp -r "$build/godot/addons" "$work"
bin=$work/addons/physvib/bin
own=$bin/linux.$(uname -m | sed 's/aarch64/arm64/')
strip --strip-unneeded "$own"/*
# What physvib-live needs, and only this Debian has in these versions, with its licences. Sound servers and the C library are the player's.
ldd "$own"/libphysvib-live.so.* | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | sort -u | while read -r library; do
    case ${library##*/} in
    libphysvib* | libc.so* | libm.so* | libdl.so* | librt.so* | libpthread.so* | libgcc_s.so* | libstdc++.so* | libasound.so* | libjack.so* | libhwy.so*) continue ;;
    esac
    cp -L "$library" "$own"
    package=$(dpkg -S "$(realpath "$library")" | head -n 1 | cut -d: -f1)
    cp "/usr/share/doc/$package/copyright" "$bin/$package-LICENSE"
done
# shellcheck disable=SC2034 # roots and targets: for cross.sh
roots="" targets=physvib-godot
for system in "$@"; do
    case $system in
    arm64) strip=aarch64-linux-gnu-strip ;;
    windows) strip=x86_64-w64-mingw32-strip ;;
    *) echo "physvib: expected arm64 or windows, found $system" >&2 && exit 1 ;;
    esac
    # shellcheck disable=SC2086 # a list of words
    ensure_packages $physvib_cross_packages
    folder=build/$system
    mkdir -p "$folder"
    . Tests/Cross/cross.sh
    libraries
    house -DPHYSVIB_TESTS=OFF -DPHYSVIB_SESSION=OFF -DPHYSVIB_GODOT_HEADER="$work"
    made=$folder/house/godot/addons/physvib/bin
    "$strip" --strip-unneeded "$made"/*/*
    cp -r "$made"/. "$bin"
done
case " $* " in *" windows "*) without= ;; *) without=MinGW-w64 ;; esac # who builds for this system alone has none
python3 Standalone/Packaging/sbom.py --licences godot $without >"$bin/THIRD-PARTY.txt"
version=$(sed -n 's/^version="\(.*\)"/\1/p' "$work/addons/physvib/plugin.cfg")
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git show -s --format=%ct)} python3 Standalone/Packaging/pack.py "$work/addons" "$work/physvib-$version.zip"
python3 Tests/Godot/rules.py "$work/physvib-$version.zip"
say "build/godot/physvib-$version.zip: $(wc -c <"$work/physvib-$version.zip") bytes"
say "build/godot/addons is ready: copy it into your project"
