#!/bin/sh
# SPDX-License-Identifier: MIT
# Two releases of one commit (HEAD), built in two folders whose names differ in length, the second without a compiler's cache, in another zone, language and
# umask: passes if their checksums are the same. Needs the time of a build without a cache. --first FOLDER: a release of HEAD that is there already.
# usage: reproducible.sh [--first FOLDER] [PART...]; parts as release.sh has them
set -eu
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
trap 'exit 130' INT TERM
first=$work/first
if [ "${1:-}" = --first ]; then
    first=${2:?"--first needs a folder"}
    shift 2
else
    Standalone/Packaging/release.sh "$first" HEAD "$@" >"$work/log"
fi
mkdir -p "$work/another/and-a-longer-one"
umask 077
CCACHE_DISABLE=1 TZ=Asia/Seoul LC_ALL=C TMPDIR=$work/another/and-a-longer-one Standalone/Packaging/release.sh "$work/second" HEAD "$@" >"$work/log"
diff "$first/SHA256SUMS" "$work/second/SHA256SUMS"
echo "reproducible: $(wc -l <"$first/SHA256SUMS") files, the same bytes from two folders"
