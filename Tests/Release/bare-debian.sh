#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs the packages of a release on a bare Debian that it makes in a folder of its own, uses all of them, and removes them: nothing
# may be left. Before that lintian reads them, after it piuparts tries them. Needs root and a network.
#   --release FOLDER   of release.sh, or of fresh-machine.sh --packages; else it is made of HEAD
#   --suite NAME       bookworm (Debian 12, as is said without it), or the one that the packages were built on
#   --picture FILE.png keep what the mixer shows
#   --keep             leave the folder behind
#   --mirror URL       instead of the mirror in this system's apt sources
# shellcheck disable=SC2016 # the machine's own shell expands what it is told
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
. Tests/bare-machine.sh
release="" picture="" keep="" mirror="" suite=bookworm
while [ $# -gt 0 ]; do
    case $1 in
        --release) release=$(realpath "${2:?"--release needs a folder"}") && shift ;;
        --suite) suite=${2:?"--suite needs a name"} && shift ;;
        --picture) picture=${2:?"--picture needs a file"} && shift ;;
        --keep) keep=yes ;;
        --mirror) mirror=${2:?"--mirror needs a URL"} && shift ;;
        *) say "expected --release FOLDER, --suite NAME, --picture FILE.png, --keep or --mirror URL, not $1" && exit 2 ;;
    esac
    shift
done
# shellcheck disable=SC2086 # a list of words
ensure_build_packages $physvib_release_test_packages

step() { echo "release: $*"; }
quietly() { "$@" >"$machine.log" 2>&1 || { tail -n 30 "$machine.log" && return 1; }; }
# $1 is done in the machine by a shell, in a folder of a user.
there() { in_machine sh -euc "mkdir -p /root/use && cd /root/use && $1"; }
apt() { quietly in_machine env DEBIAN_FRONTEND=noninteractive apt-get -y --no-install-recommends "$@"; }
files() {
    in_machine find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /root -o -path /var/cache -o -path /var/log \
        -o -path /var/lib/apt -o -path '/var/lib/dpkg/*-old' \) -prune -o -print | sort
}

tried="release: packages"
make_machine "$mirror"
[ -n "$release" ] || { release=$machine/root/release && Standalone/Packaging/release.sh "$release" HEAD dsc packages >/dev/null; }
(cd "$release" && sha256sum --quiet -c SHA256SUMS)
lintian --allow-root --fail-on error,warning "$release"/*.deb && step "lintian has no errors and no warnings"
lintian --allow-root --fail-on error "$release"/*.dsc && step "lintian has no errors in the source package"

bare=$machine/root/bare.tar.gz
tar -C "$machine" --exclude='./proc/*' --exclude='./sys/*' --exclude='./root/*' -czf "$bare" .
mkdir -p "$machine/root/packages"
cp "$release"/*.deb "$machine/root/packages"
names=$(for file in "$release"/*.deb; do dpkg-deb -f "$file" Package; done)
quietly in_machine apt-get update
there 'apt-get -y --no-install-recommends install ../packages/*.deb' >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
step "installed on a bare Debian: $(echo "$names" | xargs)"
cp Standalone/Packaging/debian/tests/renders Standalone/Packaging/debian/tests/compiles "$machine/root"
there 'physvib --version && ../renders'

apt install gcc g++ libc6-dev pkg-config cmake make lilv-utils jalv jackd2 man-db bash zsh fish libglib2.0-bin shared-mime-info desktop-file-utils \
    appstream xvfb xauth xdotool imagemagick ardour
! in_machine apt-cache show jack-example-tools >/dev/null 2>&1 || apt install jack-example-tools # Debian 12 has them in jackd2
there ../compiles
step "programs in C by pkg-config and in C++ by CMake"

[ "$(there 'lv2ls' | grep -c '^urn:physvib:plugin')" -eq 5 ]
there 'export JACK_DEFAULT_SERVER=physvib-release
    jackd -n physvib-release -d dummy -r 48000 -p 512 >jackd.log 2>&1 & server=$!
    jack_wait -w -t 30 >/dev/null 2>&1
    sleep 60 | jalv -x -n physvib urn:physvib:plugin:8 >jalv.log 2>&1 & host=$!
    for try in $(seq 50); do [ "$(jack_lsp 2>/dev/null | grep -c physvib:audio_out_)" -ne 8 ] || break; sleep 1; done
    jack_lsp 2>/dev/null | grep -c physvib:audio_out_ | grep -qx 8
    kill $host $server'
step "lilv finds five LV2; jalv plays one on eight ports"
cp Tests/Release/ardour.lua "$machine/root"
there 'ardour=$(cd /usr/lib && echo ardour[0-9]*)
    export LD_LIBRARY_PATH=/usr/lib/$ardour
    for name in PhysVib PhysVib-Pairs; do timeout 120 /usr/lib/$ardour/ardour-vst3-scanner -f /usr/lib/vst3/$name.vst3 >scan-$name.log 2>&1; done
    timeout 120 $ardour-lua ../ardour.lua session ABCDEF019182FAEB5068566250687973 2>&1 | grep "^Ardour: PhysVib on a track" || { cat scan-*.log; exit 1; }'

there 'man physvib-render | grep -q -- --law && man physvib-mixer | grep -q -- --summary
    for shell in bash zsh fish; do command -v $shell >/dev/null; done
    bash -n /usr/share/bash-completion/completions/physvib && zsh -n /usr/share/zsh/vendor-completions/_physvib
    fish -n /usr/share/fish/vendor_completions.d/physvib.fish
    fish -c "complete -C \"physvib render --lim\"" | grep -q "^--limiter"
    desktop-file-validate /usr/share/applications/org.physvib.mixer.desktop
    if ! appstreamcli validate --no-net --pedantic /usr/share/metainfo/org.physvib.mixer.metainfo.xml >appstream.log; then
        cat appstream.log
        grep -q "^W:.*url-homepage-missing" appstream.log # a packager has that
        [ "$(grep -c "^[EW]:" appstream.log)" -eq 1 ]
    fi
    printf "{ \"physvib_session\": 2 }" >a.json && printf "{}" >b.json
    gio info -a standard::content-type a.json b.json box.csv' >"$machine.log" 2>&1 || { cat "$machine.log" && exit 1; }
[ "$(sed -n 's/.*content-type: //p' "$machine.log" | xargs)" = "application/vnd.physvib.session+json application/json text/vnd.physvib.events" ]
step "manual pages, completions of three shells, entry of menus, kinds of files"

# The mixer in a window, until the picture has more in it than an empty one.
there 'cat >shown.sh <<"END"
physvib-mixer &
mixer=$!
timeout 120 xdotool search --sync --onlyvisible --name PhysVib >/dev/null
for try in $(seq 60); do
    import -window root mixer.png
    [ "$(identify -format %k mixer.png)" -lt 200 ] || break
    sleep 1
done
[ "$(identify -format %k mixer.png)" -ge 200 ]
kill -TERM $mixer
wait $mixer
END
    timeout 300 xvfb-run -a -s "-screen 0 1440x900x24" sh -eu shown.sh' >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
[ -z "$picture" ] || cp "$machine/root/use/mixer.png" "$picture"
step "the mixer shows its world in a window"

# With all that they need there, the packages alone come and go.
# shellcheck disable=SC2086 # a list of words
apt purge $names
files >"$machine/root/before"
there 'apt-get -y --no-install-recommends install ../packages/*.deb && physvib scenes && python3 -c "import physvib"' >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
files >"$machine/root/between"
step "$(diff "$machine/root/before" "$machine/root/between" | grep -c '^>') files and folders come"
# shellcheck disable=SC2086 # a list of words
apt purge $names
files | diff "$machine/root/before" - && step "none of them stays"

apart piuparts --basetgz="$bare" --distribution="$suite" --mirror="$mirror main" --warn-on-leftovers-after-purge --no-eatmydata \
    "$release"/*.deb >"$machine.log" 2>&1 || { tail -n 40 "$machine.log" && exit 1; }
step "piuparts: $(tail -n 1 "$machine.log")"
