#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Whether this tree makes the same events as another, field by field and to the bit: those of Worlds.h and of random worlds.
# Usage: hashes.sh OTHER_CHECKOUT [WORLDS [FIRST]], e.g. after `git worktree add ../before COMMIT`: hashes.sh ../before 10000
set -eu
other=$(realpath "${1:?"expected the folder of another checkout"}")
shift
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || set -- 400
hashes() { # ROOT ARGUMENTS...: this tree's program, with that tree's library
    root=$1
    shift
    cmake --preset library -S "$root" >/dev/null
    cmake --build "$root/build/library" --target physvib-physics >/dev/null
    libraries=$root/build/library/lib
    g++ -std=c++20 -O2 -ffp-contract=off "-I$root/Source" -ITests/Benchmarks Tests/Benchmarks/EventHashes.cpp "$libraries/libphysvib-physics.a" \
        "$libraries/libphysvib-contacts.a" "$libraries/libphysvib-core.a" -lhwy -lbox2d -o "$root/build/event-hashes"
    "$root/build/event-hashes" "$@"
}
before=$(mktemp)
after=$(mktemp)
trap 'rm -f "$before" "$after"' EXIT
hashes "$other" "$@" >"$before" &
hashes "$PWD" "$@" >"$after"
wait $!
if ! diff "$before" "$after" >&2; then
    echo "other events than in $other" >&2
    exit 1
fi
echo "$(wc -l <"$after") worlds, $(awk '{ for (i = 2; i <= NF; ++i) if ($i == "events") n += $(i - 1) } END { print n }' "$after") events, the same in both"
