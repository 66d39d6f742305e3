#!/bin/sh
# SPDX-License-Identifier: MIT
# Box2D 3 through its adapter, of which Debian has no package: its versions are fetched and compiled in a temporary folder, and judged as the other
# engines are (Scenes.h). Needs a network, git, node, and a build of the library.
# Usage: box2d3.sh BUILD [VERSION...]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- v3.0.0 v3.1.1 main
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
git clone -q "${BOX2D:-https://github.com/erincatto/box2d}" "$folder/box2d"
failed=0
for version in "$@"; do
    git -C "$folder/box2d" checkout -q "$version"
    rm -rf "$folder/objects"
    mkdir "$folder/objects"
    (cd "$folder/objects" && ls "$folder"/box2d/src/*.c |
        xargs -P2 -I{} sh -c "gcc -std=gnu17 -O2 -mavx2 -mfma -w -DNDEBUG -I$folder/box2d/include -I$folder/box2d/src -I$folder/box2d/extern/simde -c {} -o \$(basename {}).o")
    "$root/Tests/Engines/strict.sh" c++ "$build/include" physvib_box2d3.h "$folder/box2d/include" || failed=1
    g++ -std=c++20 -O1 -Wall -Wextra -isystem "$folder/box2d/include" -I"$build/include" "$root/Tests/Engines/box2d3.cpp" "$folder"/objects/*.o \
        -L"$build/lib" -lphysvib "-Wl,-rpath,$build/lib" -lm -o "$folder/run"
    { "$folder/run" && "$folder/run" falls; } | sed "s/^/$version: /" | tee "$folder/log"
    if [ "$version" != v3.0.0 ]; then # where restitution has another place, as its comment says
        gcc -Wall -Wextra -isystem "$folder/box2d/include" -I"$build/include" "$root/Tests/Engines/drop3.c" "$folder"/objects/*.o \
            -L"$build/lib" -lphysvib "-Wl,-rpath,$build/lib" -lm -o "$folder/drop3"
        (cd "$folder" && ./drop3) | sed "s/^/$version: drop3.c: /"
        gcc -Wall -Wextra -isystem "$folder/box2d/include" -I"$build/include" "$root/Tests/Engines/changes3.c" "$folder"/objects/*.o \
            -L"$build/lib" -lphysvib "-Wl,-rpath,$build/lib" -lm -o "$folder/changes3"
        "$folder/changes3" || failed=1
    fi
    ! grep -q FAILED "$folder/log" || failed=1
    python3 "$root/Tests/Engines/worlds.py" "$version=$folder/run" || failed=1
    python3 "$root/Tests/Engines/acts.py" "Box2D 3, $version=$folder/run" || failed=1
    node "$root/Tests/JavaScript/kit.mjs" - "box2d3@$version=$folder/run --kit" || failed=1
done
exit $failed
