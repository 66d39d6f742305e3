#!/bin/sh
# SPDX-License-Identifier: MIT
# Tries README's two commands on a bare Debian 12 that it makes in a folder of its own; needs root and a network.
#   --run-only      run.sh alone
#   --pages         instead of them, what the pages of C, Python, Lua and C# say
#   --keep          leave the folder behind
#   --mirror URL    instead of the mirror in this system's apt sources
set -eu
cd "$(dirname "$0")/.."
. .ci/packages.sh

commands="run.sh test.sh"
keep=""
mirror=""
while [ $# -gt 0 ]; do
    case $1 in
        --run-only) commands="run.sh" ;;
        --pages) commands="Tests/Api/ten-minutes.sh" ;;
        --keep) keep=yes ;;
        --mirror) mirror=${2:?"--mirror needs a URL"} && shift ;;
        *) say "expected --run-only, --pages, --keep or --mirror URL, not $1" && exit 2 ;;
    esac
    shift
done
[ "$(id -u)" -eq 0 ] || { say "a machine within a folder needs root" && exit 1; }
ensure_packages debootstrap git

# shellcheck disable=SC2016 # apt's own variable
bookworm_mirror() { apt-get indextargets --no-release-info --format '$(REPO_URI)' 'Release: bookworm' | head -n 1; }
[ -n "$mirror" ] || mirror=$(bookworm_mirror)
[ -n "$mirror" ] || { say "no mirror of Debian 12 in the apt sources of this system: give one with --mirror" && exit 1; }

# Namespaces of its own: mounts and processes end with the command, so nothing is ever mounted when a folder is removed.
apart() { unshare --mount --pid --fork --kill-child "$@"; }
in_machine() {
    apart --mount-proc="$machine/proc" chroot "$machine" env -i HOME=/root TERM=dumb \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} "$@"
}

machine=$(mktemp -d)
chmod 755 "$machine" # its /, which users who are not root must be able to enter
leave() {
    status=$?
    rm -f "$machine.log"
    if [ -n "$keep" ]; then say "left in $machine"; else rm -rf --one-file-system -- "${machine:?}"; fi
    minutes=$((($(date +%s) - begin + 30) / 60))
    [ $status -eq 0 ] && result="succeeded" || result="FAILED"
    echo "fresh machine: $commands $result on a bare Debian 12, $minutes minutes in all"
    exit $status
}
begin=$(date +%s)
trap leave EXIT
trap 'exit 130' INT TERM

say "a bare Debian 12 in $machine"
apart debootstrap --variant=minbase bookworm "$machine" "$mirror" >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
[ -z "$(git status --porcelain)" ] || say "changes that are not committed stay out"
git clone --quiet . "$machine/root/PhysVib"
for command in $commands; do
    say "$command, $(in_machine dpkg-query -W -f '.' | wc -c) packages installed before it"
    in_machine "/root/PhysVib/$command"
done
[ "$commands" != Tests/Api/ten-minutes.sh ] || exit 0
for file in shake-the-box.wav shake-the-box.csv shake-the-box.png; do
    [ -s "$machine/root/PhysVib/out/$file" ] || { say "out/$file is missing" && exit 1; }
done
