#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the page into build/web/page: one folder of static files. What it needs comes from Debian: packages, and the source of Box2D and of a generator of
# QR codes. PHYSVIB_PAGE_URL: the address that the page will have, for pictures of links to it. PHYSVIB_HOMEPAGE: that of the documentation, which the page links.
# usage: Standalone/Web/build-web.sh
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_web_packages

folder=$PWD/build/web
box2d=$folder/box2d-2.4.1
qrcodegen=$folder/qr-code-generator
mkdir -p "$folder"
if [ ! -d "$box2d" ]; then
    say "taking Box2D's source from Debian"
    from_debian "$folder" source box2d
fi
if [ ! -d "$qrcodegen" ]; then
    say "taking the QR code generator's source from Debian"
    from_debian "$folder" source --tar-only qr-code-generator
    rm -rf "$qrcodegen.new"
    mkdir "$qrcodegen.new"
    tar -xzf "$folder"/qr-code-generator_*.orig.tar.gz -C "$qrcodegen.new" --strip-components=1
    mv "$qrcodegen.new" "$qrcodegen"
fi

say "building the page (log: build/web/build.log)"
if ! { cmake -S Standalone/Web -B build/web/wasm -G Ninja --toolchain "$PWD/Standalone/Web/toolchain.cmake" -DCMAKE_BUILD_TYPE=None -DBOX2D="$box2d" -DQRCODEGEN="$qrcodegen" &&
    cmake --build build/web/wasm ${PHYSVIB_WEB_JOBS:+-j "$PHYSVIB_WEB_JOBS"}; } >build/web/build.log 2>&1; then
    cat build/web/build.log >&2
    exit 1
fi
rm -rf build/web/page
mkdir build/web/page
Source/Api/JavaScript/shrink.sh build/web/wasm/physvib.wasm build/web/page/physvib.wasm "-Oz --flatten --rereloop -Oz -Oz" # 21 KB less, compressed
cp build/web/wasm/package/profiles.js Standalone/Web/Page/* build/web/page
for module in clock device files gamepad module names pad settings waves; do cp "Source/Api/JavaScript/package/$module.js" build/web/page; done
cd build/web/page
sed -i -e '2,$ { /^ *\/\/ /d; /^ *\/\/\/ /d; /^ *\/\*\* .*\*\/$/d; /^ *\/\*\* /,/\*\/$/d }' ./*.js # lines of comment, 4 KB
sed -i -e '2,$ s| // .*||; s/^ *//; /^$/d' ./*.js # no string of theirs goes over a line, or has " // " in it
sed -i -e '2,$ { /^ *\/\* .*\*\/$/d }; s/^ *//; /^$/d' style.css index.html manifest.webmanifest icon.svg
sed -i -e '2,$ { s/\([:;,{]\) /\1/g; s/ \([{}]\)/\1/g }' style.css
# The package reads files; the page has its own way.
sed -i -e '/^export const \(parseLayout\|parseEvents\|readClip\) /,/^})\{2,3\};$/d; /^const fieldSaid /,/^});$/d; /^const bytesOf /d' files.js
homepage=${PHYSVIB_HOMEPAGE:+<a href=\"${PHYSVIB_HOMEPAGE%/}/web.html\">Documentation</a>}
sed -i -e "s|@URL@|${PHYSVIB_PAGE_URL:-}|" -e "s|@HOMEPAGE@|$homepage|" index.html
# The service worker keeps these files, as they are now.
version=$(cat -- * | sha256sum | cut -c1-16)
files=$(printf "'%s', " ./ *.html *.css *.js *.svg *.png *.wasm *.webmanifest | sed "s/'service-worker.js', //; s/'card.png', //; s/, \$//")
sed -i -e "s|@VERSION@|$version|" -e "s|'@FILES@'|$files|" service-worker.js
cd ../../..
cp LICENSES/MIT.txt build/web/page/LICENSE
cp Standalone/Web/serve.py build/web/page # by which the mixer serves it
python3 Standalone/Packaging/sbom.py --licences page >build/web/page/THIRD-PARTY.txt
bytes=$(tar -C build/web --exclude=THIRD-PARTY.txt --exclude=serve.py -cz page | wc -c)
say "build/web/page: $bytes bytes compressed, without the licences"
