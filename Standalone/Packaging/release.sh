#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# release.sh FOLDER [COMMIT]: a release of that commit (HEAD) as files in FOLDER, which must not be there yet: source, packages of Debian,
# what has changed, checksums. The same commit gives the same bytes, wherever it is built. A commit with a tag v<version> is that version;
# any other one comes before it. The folder it works in is made in TMPDIR (/tmp), and goes.
set -eu
[ $# -ge 1 ] && [ $# -le 2 ] || { echo "usage: release.sh FOLDER [COMMIT]" >&2 && exit 2; }
out=$(realpath -m "$1")
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_release_packages
[ ! -e "$out" ] || { say "$out: expected nothing there" && exit 1; }
commit=$(git rev-parse --quiet --verify "${2:-HEAD}^{commit}") || { say "$2: expected a commit or a tag" && exit 1; }
maintainer='The PhysVib developers <physvib@example.org>'

# What is told of the version has its home in CMakeLists.txt.
version=$(git show "$commit:CMakeLists.txt" | sed -n 's/^project(PhysVib VERSION \([0-9.]*\) .*/\1/p')
minor=${version%.*}
next=${minor%.*}.$((${minor#*.} + 1))
SOURCE_DATE_EPOCH=$(git show -s --format=%ct "$commit")
export SOURCE_DATE_EPOCH LC_ALL=C.UTF-8 TZ=UTC
umask 022
release=$version
if git tag --points-at "$commit" | grep -qx "v$version"; then
    git show "$commit:CHANGELOG.md" | grep -qx "## $version" || { say "CHANGELOG.md: expected a section \"## $version\", as the tag says" && exit 1; }
else
    release=$version~git$(date -d "@$SOURCE_DATE_EPOCH" +%Y%m%d).$(printf %.8s "$commit")
fi

work=$(mktemp -d "${TMPDIR:-/tmp}/physvib-release-XXXXXX")
trap 'rm -rf -- "$work"' EXIT
trap 'exit 130' INT TERM
source=$work/physvib-$release
mkdir "$work/out"
git -c tar.umask=0022 archive --format=tar --prefix="physvib-$release/" "$commit" | gzip -n9 >"$work/out/physvib-$release.tar.gz"
tar -xzf "$work/out/physvib-$release.tar.gz" -C "$work"
awk -v head="## $version" 'index($0, "## ") == 1 { on = index($0, head) == 1 } on' "$source/CHANGELOG.md" >"$work/out/physvib-$release.changes.md"

cp -r "$source/Standalone/Packaging/debian" "$source/debian"
depends=$(. "$source/.ci/packages.sh" && echo $physvib_build_packages | sed 's/ /, /g')
for file in "$source"/debian/*.in; do
    sed "s/@MAINTAINER@/$maintainer/; s/@BUILD_DEPENDS@/$depends/; s/@MINOR@/$minor/g; s/@NEXT@/$next/g" "$file" >"${file%.in}"
    rm "$file"
done
# Not Debian's own packages: those would come after.
cat >"$source/debian/changelog" <<END
physvib ($release-0physvib1) unstable; urgency=medium

  * What has changed is told in changelog.gz.

 -- $maintainer  $(date -R -d "@$SOURCE_DATE_EPOCH")
END

say "building the packages of $release"
if command -v ccache >/dev/null; then # the build has a home of its own
    CCACHE_DIR=${CCACHE_DIR:-$(ccache -k cache_dir)}
    export CCACHE_DIR
fi
log=$work/build.log
(cd "$source" && DEB_BUILD_OPTIONS="parallel=$(nproc)" dpkg-buildpackage --build=binary --no-sign) >"$log" 2>&1 || { cat "$log" >&2 && exit 1; }
mv "$work"/*.deb "$work/out"
(cd "$work/out" && sha256sum -- * >SHA256SUMS)
mkdir -p "$(dirname "$out")"
mv "$work/out" "$out"
cat "$out/SHA256SUMS"
