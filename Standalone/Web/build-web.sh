#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the page into build/web/page: one folder of static files. What it needs comes from Debian: packages, and Box2D's own source.
# usage: Standalone/Web/build-web.sh
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_web_packages

# Box2D's source package, checked by apt against Debian's signatures. Its lists are kept here: the machine's own stay as they are.
folder=$PWD/build/web
box2d=$folder/box2d
if [ ! -d "$box2d" ]; then
    say "taking Box2D's source from Debian"
    fetched=$(mktemp -d)
    trap 'rm -rf "$fetched"' EXIT
    mkdir -p "$folder" "$fetched/lists/partial"
    echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" >"$fetched/sources.list"
    from="-q -q -o Dir::Etc::sourcelist=$fetched/sources.list -o Dir::Etc::sourceparts=/dev/null -o Dir::State::lists=$fetched/lists
        -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User="
    # shellcheck disable=SC2086 # a list of words
    (cd "$fetched" && apt-get $from update && apt-get $from source box2d) >"$folder/box2d.log" 2>&1 || { cat "$folder/box2d.log" >&2; exit 1; }
    mv "$fetched"/box2d-2.4.1 "$box2d"
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
