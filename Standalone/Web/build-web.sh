#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the page into build/web/page: one folder of static files. What it needs comes from Debian: packages, and Box2D's own source.
# usage: Standalone/Web/build-web.sh
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_web_packages

folder=$PWD/build/web
box2d=$folder/box2d-2.4.1
mkdir -p "$folder"
if [ ! -d "$box2d" ]; then
    say "taking Box2D's source from Debian"
    from_debian "$folder" source box2d
fi

say "building the page (log: build/web/build.log)"
if ! { cmake -S Standalone/Web -B build/web/wasm -G Ninja --toolchain "$PWD/Standalone/Web/toolchain.cmake" -DCMAKE_BUILD_TYPE=None -DBOX2D="$box2d" &&
    cmake --build build/web/wasm ${PHYSVIB_WEB_JOBS:+-j "$PHYSVIB_WEB_JOBS"}; } >build/web/build.log 2>&1; then
    cat build/web/build.log >&2
    exit 1
fi
mkdir -p build/web/page
cp build/web/wasm/physvib.wasm Standalone/Web/Page/* build/web/page
bytes=$(tar -C build/web -cz page | wc -c)
say "build/web/page: $bytes bytes compressed"
[ "$bytes" -lt 300000 ] || { say "expected less than 300 KB"; exit 1; }
