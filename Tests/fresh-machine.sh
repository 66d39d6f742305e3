#!/bin/sh
# SPDX-License-Identifier: MIT
# Tries README's two commands on a bare Debian 12 that it makes in a folder of its own; needs root and a network.
#   --run-only      run.sh alone
#   --tutorials     instead of them, README and the tutorials, typed by follow.py, and what they make felt
#   --pages         instead of them, what the pages of C, Chipmunk, Python, Lua and C# say
#   --keep          leave the folder behind
#   --cache FOLDER  a compiler cache to use: tries everything sooner, and says less about times
#   --mirror URL    instead of the mirror in this system's apt sources
set -eu
cd "$(dirname "$0")/.."
. .ci/packages.sh
. Tests/bare-machine.sh

commands="run.sh test.sh"
keep=""
mirror=""
cache=""
while [ $# -gt 0 ]; do
    case $1 in
        --run-only) commands="run.sh" ;;
        --tutorials) commands="Tests/Docs/tutorials.sh" ;;
        --pages) commands="Tests/Api/ten-minutes.sh" ;;
        --keep) keep=yes ;;
        --cache) cache=$(realpath "${2:?"--cache needs a folder"}") && shift ;;
        --mirror) mirror=${2:?"--mirror needs a URL"} && shift ;;
        *) say "expected --run-only, --tutorials, --pages, --keep, --cache FOLDER or --mirror URL, not $1" && exit 2 ;;
    esac
    shift
done
ensure_packages debootstrap git

tried="fresh machine: $commands"
make_machine "$mirror"
[ -z "$(git status --porcelain)" ] || say "changes that are not committed stay out"
git clone --quiet . "$machine/root/PhysVib"
# Processor seconds of all that this script has waited for, in $worked; `times` knows them in this shell alone, and in no $( ).
count_work() {
    times >"$machine/times"
    worked=$(sed 's/[ms]/ /g' "$machine/times" | awk 'NR == 2 { print int(60 * ($1 + $3) + $2 + $4) }')
}
packages() { in_machine dpkg-query -W -f '.' | wc -c; }
for command in $commands; do
    before=$(packages)
    count_work
    started=$(date +%s) before_work=$worked
    in_machine "/root/PhysVib/$command"
    seconds=$(($(date +%s) - started))
    count_work
    say "$command took $((seconds / 60)):$(printf %02d $((seconds % 60))) min and $(((worked - before_work) / 60)) processor minutes, with $(($(packages) - before)) packages beyond the $before that were there"
done
case $commands in Tests/*) exit 0 ;; esac
for file in shake-the-box.wav shake-the-box.csv shake-the-box.png; do
    [ -s "$machine/root/PhysVib/out/$file" ] || { say "out/$file is missing" && exit 1; }
done
