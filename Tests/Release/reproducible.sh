#!/bin/sh
# SPDX-License-Identifier: MIT
# Two releases of one commit (HEAD): one here, the other in a bare Debian 12 without a compiler's cache, by a user who is not root, in a folder of another
# length, another zone, language and umask. Passes if their checksums are the same. Needs root, a network, npm, and the time of a build without a cache.
# usage: reproducible.sh [--first FOLDER (a release of HEAD that is there already)] [--mirror URL] [PART...]; parts, and GODOT, as release.sh has them
# shellcheck disable=SC2016 # the machine's own shell expands what it is told
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
. Tests/bare-machine.sh
first="" mirror=""
while [ $# -gt 0 ]; do
    case $1 in
        --first) first=$(realpath "${2:?"--first needs a folder"}") && shift ;;
        --mirror) mirror=${2:?"--mirror needs a URL"} && shift ;;
        *) break ;;
    esac
    shift
done
ensure_packages debootstrap
tried="the second release"
make_machine "$mirror"
[ -n "$first" ] || { first=$machine/root/first && Standalone/Packaging/release.sh "$first" HEAD "$@" >"$machine.log"; }

folder=$machine/home/builder/another-folder/and-a-longer-one
# shellcheck disable=SC2046,SC2086 # lists of words
in_machine sh -euc 'apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" && useradd -m builder' sh \
    $(with_juce_unpacked $physvib_release_packages $physvib_web_packages $physvib_site_packages $physvib_pico_packages $physvib_cross_packages) \
    >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
mkdir -p "$folder"
git -c advice.detachedHead=false clone -q "$PWD" "$folder/physvib"
for sources in juce pico sources web/box2d-2.4.1 web/qr-code-generator; do # the rest it takes from Debian
    [ ! -e "build/$sources" ] || { mkdir -p "$folder/physvib/build/$sources" && cp -r "build/$sources/." "$folder/physvib/build/$sources"; }
done
[ ! -e "${GODOT:-}" ] || cp "$GODOT" "$folder/godot"
cp "$(readlink -f "$(command -v node)")" "$machine/usr/local/bin/node" # of this machine: Debian 12's is older than it has to be
mkdir -p "$machine/usr/local/lib/node_modules"
cp -r "$(dirname "$(readlink -f "$(command -v npm)")")/.." "$machine/usr/local/lib/node_modules/npm"
ln -s ../lib/node_modules/npm/bin/npm-cli.js "$machine/usr/local/bin/npm"
in_machine chown -R builder: /home/builder
began=$(date +%s)
in_machine runuser -u builder -- env HOME=/home/builder TZ=Asia/Seoul LC_ALL=C sh -euc 'cd "$HOME/another-folder/and-a-longer-one/physvib" && umask 077
    export CCACHE_DISABLE=1 GODOT="$HOME/another-folder/and-a-longer-one/godot" TMPDIR="$HOME/another-folder/and-a-longer-one"
    exec Standalone/Packaging/release.sh "$HOME/second" HEAD "$@"' sh "$@" >"$machine.log"
echo "release: $((($(date +%s) - began + 30) / 60)) minutes without a compiler's cache"
diff "$first/SHA256SUMS" "$machine/home/builder/second/SHA256SUMS"
echo "release: $(wc -l <"$first/SHA256SUMS") files, the same bytes from two machines"
