# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# A bare Debian in a folder, for scripts that try what a newcomer does. Sourced, after .ci/packages.sh; needs root and a network.
# $suite, if it says something, is another than Debian 12.

# Namespaces of its own: mounts and processes end with the command, so nothing is ever mounted when a folder is removed.
apart() { unshare --mount --pid --fork --kill-child "$@"; }
# It has pseudo-terminals and shared memory, as every booted system; $cache, if it says something, is its compiler cache,
# whose entries know in which language a compiler complains.
# shellcheck disable=SC2016 # of the inner shell
in_machine() {
    apart --mount-proc="$machine/proc" sh -ec '
        machine=$1 cache=$2
        shift 2
        mkdir -p "$machine/dev/pts" "$machine/dev/shm"
        mount -t devpts -o ptmxmode=0666,newinstance devpts "$machine/dev/pts"
        mount -t tmpfs -o mode=1777 tmpfs "$machine/dev/shm"
        [ -z "$cache" ] || { mkdir -p "$machine/ccache" && mount --bind "$cache" "$machine/ccache"; }
        exec chroot "$machine" env -i HOME=/root TERM=dumb PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            ${http_proxy:+http_proxy="$http_proxy"} ${cache:+CCACHE_DIR=/ccache LANG="${LANG:-}"} "$@"' sh "$machine" "${cache:-}" "$@"
}

# shellcheck disable=SC2016 # apt's own variable
debian_mirror() { apt-get indextargets --format '$(REPO_URI)' 'Label: Debian' | head -n 1; }
debian_called() { case $1 in bookworm) echo "Debian 12" ;; trixie) echo "Debian 13" ;; *) echo "Debian $1" ;; esac; }

# make_machine [MIRROR]: $machine is its folder, which goes with the script unless $keep says something. The script's last line says
# whether what was $tried went well.
make_machine() {
    [ "$(id -u)" -eq 0 ] || { say "a machine within a folder needs root" && exit 1; }
    suite=${suite:-bookworm}
    mirror=${1:-$(debian_mirror)}
    [ -n "$mirror" ] || { say "no mirror of Debian in the apt sources of this system: give one with --mirror" && exit 1; }
    begin=$(date +%s)
    machine=$(mktemp -d)
    chmod 755 "$machine" # its /, which users who are not root must be able to enter
    trap leave EXIT
    trap 'exit 130' INT TERM
    say "a bare $(debian_called "$suite") in $machine"
    apart debootstrap --variant=minbase "$suite" "$machine" "$mirror" >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
    echo 'Acquire::Check-Valid-Until "false";' >"$machine/etc/apt/apt.conf.d/80mirror" # one that lags behind will do
}
leave() {
    status=$?
    rm -f "$machine.log"
    if [ -n "${keep:-}" ]; then say "left in $machine"; else rm -rf --one-file-system -- "${machine:?}"; fi
    [ $status -eq 0 ] && word="succeeded" || word="FAILED"
    echo "$tried $word on a bare $(debian_called "$suite"), $((($(date +%s) - begin + 30) / 60)) minutes in all"
    exit $status
}
