#!/bin/sh
# SPDX-License-Identifier: MIT
# Farseer 3.5, of which Debian has no package, by PhysVib.cs: its last commit of that name is fetched and compiled in a temporary folder. Needs a network,
# git, mcs and mono, and a build of the library.
# Usage: farseer.sh BUILD
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
git clone -q --bare "${FARSEER:-https://github.com/Genbox/VelcroPhysics}" "$folder/git"
git -C "$folder/git" archive 8245e21f SourceFiles | tar x -C "$folder"
cd "$folder/SourceFiles"
rm -r FP3.0 Content # older files, and readers of XNA's
mcs -warn:0 -target:library -out:../Farseer.dll -recurse:'*.cs'
cd ..
mcs -out:falls.exe "$root/Tests/Engines/farseer.cs" "$root/Source/Api/CSharp/PhysVib.cs" -r:Farseer.dll
LD_LIBRARY_PATH=$build/lib mono falls.exe
