#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# part.sh PART: one part of a release, made in the folder of its source. release.sh calls it, and says OUT, RELEASE, VERSION, SOURCE_DATE_EPOCH.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
pack() { python3 Standalone/Packaging/pack.py "$@"; }
licences() { cp LICENSES/MIT.txt $into/LICENSE && python3 Standalone/Packaging/sbom.py --licences "$1" >$into/THIRD-PARTY.txt; }
built=$PWD/obj-$(dpkg-architecture -qDEB_HOST_GNU_TYPE) # by packages: what wheel and addon are made of as well

# Where it is published is said once, by CITATION.cff; until then nothing names an address.
said() { sed -n "s/^$1: \"\(.*\)\"/\1/p" CITATION.cff; }
PHYSVIB_REPOSITORY=${PHYSVIB_REPOSITORY:-$(said repository-code)}
PHYSVIB_HOMEPAGE=${PHYSVIB_HOMEPAGE:-$(said url)}
PHYSVIB_BUGS=${PHYSVIB_BUGS:-${PHYSVIB_REPOSITORY:+$PHYSVIB_REPOSITORY/issues}}
export PHYSVIB_REPOSITORY PHYSVIB_HOMEPAGE PHYSVIB_BUGS

# debianised: debian/ as Debian's tools read it.
debianised() {
    maintainer='The PhysVib developers <physvib@example.org>'
    rm -rf debian
    cp -r Standalone/Packaging/debian debian
    version=$(echo "$RELEASE" | tr - '~') # a candidate comes before what it is one for
    next=$((${VERSION%%.*} + 1)).0
    # shellcheck disable=SC2086 # a list of words
    depends=$(echo $physvib_build_packages | sed 's/ /, /g')
    addresses="/@ADDRESSES@/d"
    [ -z "$PHYSVIB_REPOSITORY" ] ||
        addresses="s|@ADDRESSES@|Homepage: ${PHYSVIB_HOMEPAGE:-$PHYSVIB_REPOSITORY}\nVcs-Browser: $PHYSVIB_REPOSITORY\nVcs-Git: $PHYSVIB_REPOSITORY.git|; s|@REPOSITORY@|$PHYSVIB_REPOSITORY|"
    for file in debian/*.in; do
        sed "s/@MAINTAINER@/$maintainer/; s/@BUILD_DEPENDS@/$depends/; s/@NEXT@/$next/g; $addresses" "$file" >"${file%.in}"
        rm "$file"
    done
    [ -n "$PHYSVIB_REPOSITORY" ] || rm debian/watch # nothing to watch
    # Not Debian's own packages: those would come after.
    cat >debian/changelog <<TEXT
physvib ($version-0physvib1) unstable; urgency=medium

  * What has changed is told in changelog.gz.

 -- $maintainer  $(date -R -d "@$SOURCE_DATE_EPOCH")
TEXT
}

# The source package: the release's tarball, and debian/.
dsc() {
    debianised
    cp "$OUT/physvib-$RELEASE.tar.gz" "../physvib_$version.orig.tar.gz"
    mkdir ../clean
    tar -xzf "../physvib_$version.orig.tar.gz" -C ../clean --strip-components 1
    cp -r debian ../clean
    (cd .. && dpkg-source -b clean)
    rm -r ../clean
    mv ../*.orig.tar.gz ../*.debian.tar.xz ../*.dsc "$OUT"
}

packages() {
    debianised
    unchecked=""
    [ ! -e build/juce ] || unchecked=--no-check-builddeps # JUCE is there unpacked
    DEB_BUILD_OPTIONS="parallel=$(nproc)" dpkg-buildpackage --build=binary --no-sign $unchecked
    mv ../*.deb "$OUT"
}

wheel() { python3 Source/Api/Python/wheel.py "$(readlink -f debian/libphysvib[0-9]/usr/lib/*/libphysvib.so.[0-9])" "$OUT"; }

npm() {
    Source/Api/JavaScript/build-package.sh
    cp build/web/*.tgz "$OUT"
}

page() {
    Standalone/Web/build-web.sh
    mv build/web/page "physvib-page"
    pack physvib-page "$OUT/physvib-$RELEASE-page.zip"
}

site() {
    Docs/Site/build-site.sh physvib-documentation $([ ! -d physvib-page ] || echo physvib-page) # the live page on its first screen
    pack physvib-documentation "$OUT/physvib-$RELEASE-documentation.tar.gz"
}

firmware() {
    Firmware/Pico/build.sh pico pico2
    into=physvib-firmware
    mkdir $into
    for board in pico pico2; do for kind in uf2 bin; do for channels in 4 8; do
        cp build/firmware/$board/physvib-pico$channels.$kind $into/physvib-$board-${channels}-channels.$kind
    done; done; done
    for line in vcp bluetooth; do
        cmake -S Firmware/Image -B build/f334/$line -G Ninja --toolchain "$PWD/Firmware/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release -DPHYSVIB_LINE=$line
        cmake --build build/f334/$line
        cp build/f334/$line/physvib-f334.bin $into/physvib-f334-$line.bin
    done
    licences firmware
    pack $into "$OUT/physvib-$RELEASE-firmware.zip"
}

# foreign SYSTEM STRIP LIBRARY FILE...: the library, with the files that go with it, and the renderer for another system, as a folder.
foreign() {
    system=$1 strip=$2
    shift 2
    folder=build/$system
    roots="" targets="physvib-c physvib-render"
    mkdir -p "$folder"
    . Tests/Cross/cross.sh
    libraries
    house -DPHYSVIB_TESTS=OFF -DPHYSVIB_SESSION=OFF
    into=physvib-$system
    mkdir -p "$into/include/physvib"
    (cd "$folder/house" && "$strip" --strip-unneeded "$1" bin/physvib-render*)
    cp -P "$folder"/house/bin/physvib-render* "$into"
    for file in "$@"; do cp -P "$folder/house/$file" "$into"; done
    cp "$folder/house/include/physvib/physvib.h" "$into/include/physvib"
    licences "$system"
}

windows() {
    foreign windows x86_64-w64-mingw32-strip bin/libphysvib.dll lib/libphysvib.dll.a
    pack physvib-windows "$OUT/physvib-$RELEASE-windows-x86_64.zip"
}

arm64() {
    foreign arm64 aarch64-linux-gnu-strip "lib/libphysvib.so.${VERSION%%-*}" "lib/libphysvib.so.${VERSION%%.*}" lib/libphysvib.so
    pack physvib-arm64 "$OUT/physvib-$RELEASE-linux-arm64.tar.gz"
}

godot() {
    PHYSVIB_BUILD=$built Source/Api/Godot/build-addon.sh "$GODOT" arm64 windows
    cp build/godot/physvib-*.zip "$OUT/physvib-$RELEASE-godot.zip"
}

sbom() {
    python3 Standalone/Packaging/sbom.py "$RELEASE" "$OUT" >physvib.spdx.json
    mv physvib.spdx.json "$OUT/physvib-$RELEASE.spdx.json"
}

"$1"
