#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# release.sh FOLDER [COMMIT [PART...]]: a release of that commit (HEAD) as files in FOLDER, which must not be there yet: source, what has changed, and
# the parts that part.sh makes (all). The same commit gives the same bytes, wherever it is built. A commit with a tag v<version> is that version;
# any other one comes before it. The folder it works in is made in TMPDIR (/tmp), and goes. Sources of others that build/ has are taken from there,
# the rest from Debian. GODOT: a program of Godot 4.4 or newer, or its header gdextension_interface.h; npm is yours too.
set -eu
[ $# -ge 1 ] || { echo "usage: release.sh FOLDER [COMMIT [PART...]]" >&2 && exit 2; }
OUT=$(realpath -m "$1")
cd "$(dirname "$0")/../.."
. .ci/packages.sh
commit=$(git rev-parse --quiet --verify "${2:-HEAD}^{commit}") || { say "$2: expected a commit or a tag" && exit 1; }
[ ! -e "$OUT" ] || { say "$OUT: expected nothing there" && exit 1; }
shift $(($# < 2 ? $# : 2))
[ $# -gt 0 ] || set -- dsc npm page site firmware windows arm64 packages wheel godot sbom # the shortest first: what fails is told soon

# shellcheck disable=SC2086 # lists of words
for part in "$@"; do # what is missing is said before hours of work
    case $part in
    dsc) ensure_packages dpkg-dev ;;
    packages) ensure_build_packages $physvib_release_packages ;;
    npm | page) ensure_packages $physvib_web_packages ;;
    site) ensure_packages $physvib_site_packages ;;
    firmware) ensure_packages $physvib_pico_packages ;;
    windows | arm64 | godot) ensure_packages $physvib_cross_packages libbox2d-dev libhwy-dev ;;
    esac
    [ "$part" != npm ] || command -v npm >/dev/null || { say "npm: expected npm, of Node 20 or newer (https://nodejs.org)" && exit 1; }
    [ "$part" != godot ] || [ -e "$(command -v "${GODOT:-}")" ] || [ -f "${GODOT:-}" ] || { say "godot: expected GODOT, a program of Godot 4.4 or newer, or its header" && exit 1; }
done

VERSION=$(git show "$commit:VERSION.txt")
SOURCE_DATE_EPOCH=$(git show -s --format=%ct "$commit")
RELEASE=$VERSION
export OUT VERSION RELEASE GODOT SOURCE_DATE_EPOCH LC_ALL=C.UTF-8 TZ=UTC
umask 022
if git tag --points-at "$commit" | grep -qx "v$VERSION"; then
    git show "$commit:CHANGELOG.md" | grep -qx "## $VERSION" || { say "CHANGELOG.md: expected a section \"## $VERSION\", as the tag says" && exit 1; }
else
    RELEASE=$VERSION~git$(date -d "@$SOURCE_DATE_EPOCH" +%Y%m%d).$(printf %.8s "$commit")
fi

work=${TMPDIR:-/tmp}/physvib-release # always the same, by which a compiler cache finds what it has
mkdir "$work" || { say "$work: expected nothing there: another release is being made, or was cut off" && exit 1; }
trap 'rm -rf -- "$work"' EXIT
trap 'exit 130' INT TERM
source=$work/source
made=$OUT
OUT=$work/out
mkdir "$OUT" "$source"
git -c tar.umask=0022 archive --format=tar --prefix="physvib-$RELEASE/" "$commit" | gzip -n9 >"$OUT/physvib-$RELEASE.tar.gz"
tar -xzf "$OUT/physvib-$RELEASE.tar.gz" -C "$source" --strip-components 1
awk -v head="## $VERSION" 'index($0, "## ") == 1 { on = index($0, head) == 1 } on' "$source/CHANGELOG.md" >"$OUT/physvib-$RELEASE.changes.md"
for sources in juce pico sources web/box2d-2.4.1 web/qr-code-generator; do
    [ ! -e "build/$sources" ] || { mkdir -p "$source/build/$sources" && cp -r "build/$sources/." "$source/build/$sources"; }
done
if command -v ccache >/dev/null; then # the packages' build has a home of its own
    CCACHE_DIR=${CCACHE_DIR:-$(ccache -k cache_dir)}
    export CCACHE_DIR
fi

for part in "$@"; do
    began=$(date +%s)
    "$source/Standalone/Packaging/part.sh" "$part" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        rm -rf "$made.unfinished" && mkdir -p "$(dirname "$made")" && mv "$OUT" "$made.unfinished"
        say "$part: failed; what was made before it is in $made.unfinished" && exit 1
    }
    say "$part: $(awk "BEGIN { printf \"%.1f\", ($(date +%s) - $began) / 60 }") minutes"
done
python3 "$source/Standalone/Packaging/check-version.py" "$source" "$OUT"
(cd "$OUT" && sha256sum -- * >SHA256SUMS)
mkdir -p "$(dirname "$made")"
mv "$OUT" "$made"
cat "$made/SHA256SUMS"
