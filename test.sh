#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing, builds as released and runs every test. Half an hour more: what parses, hands memory over or is concurrent under the
# sanitizers (Tests/sanitizers.sh). What takes hours: Tests/nightly.sh.
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh
case ${1:-} in
"") ;;
-h | --help) sed -n '3,/^set/{/^#/s/^# //p}' test.sh && exit 0 ;;
*) say "$1: expected nothing: ./test.sh runs every test. Some of them, once it is built: ctest --preset release -R $1" && exit 2 ;;
esac

# shellcheck disable=SC2086 # a list of words
ensure_build_packages $physvib_test_packages

# Engines and languages of others, and what runs the studies in R, are tested at night, and here where their files changed since the last night that passed.
# No label is called "none".
at_night=none not_made=
if Tests/passed.sh engines; then
    at_night="$at_night|engines" not_made='PHYSVIB_ENGINE_*'
else
    # shellcheck disable=SC2086 # a list of words
    ensure_packages $physvib_engine_packages
fi
if Tests/passed.sh laboratory; then
    at_night="$at_night|laboratory"
    say "laboratory: passed with these files (Tests/passed/laboratory.txt)"
fi
# What this Debian has no package of.
not_had=
command -v clang-format-14 >/dev/null || not_had=PHYSVIB_CLANG_FORMAT

# tests PRESET NAME OPTION...: those of CTest; what they say of themselves, in full, is kept for skipped.py.
tests() {
    preset=$1 report=$PWD/build/tests-$2.xml
    shift 2
    ctest --preset "$preset" --output-junit "$report" --test-output-size-passed 1000000 "$@"
}

# twice PRESET NAME OPTION...: as tests, but what fails may be tried a second time, and is named with what the machine did meanwhile: a display takes the
# focus from a window now and then, and what plays in real time shares the processors.
twice() {
    /usr/bin/python3 Tests/Support/away.py >"build/away-$2" &
    away=$!
    first=0
    tests "$@" || first=1
    kill "$away" && wait "$away" || :
    say "$2: the machine was $(cat "build/away-$2")"
    [ "$first" = 0 ] && return 0
    say "$2: a second try of$(sed 's/^[0-9]*:/ /' "build/$1/Testing/Temporary/LastTestsFailed.log" | tr '\n' ',')"
    tests "$1" "$2-again" --rerun-failed --output-on-failure
}

rm -f build/tests-*-again.xml # of another run
build release all
# Three at once on two cores: many wait for a program or a disk.
tests release quiet -j3 --progress -LE "live|display|$at_night"
# Each has a display of its own, and waits most of the time.
twice release display -j4 -L display
# What plays in real time waits most of the time: each of these takes the place of two.
twice release live -j6 -L live -LE "$at_night"
# Nothing is left out in silence.
Tests/House/skipped.py --at-night "$not_made" --at-night "$not_had" --at-night PHYSVIB_PICO_SDK build/release build/tests-quiet.xml build/tests-display*.xml build/tests-live*.xml
if Tests/passed.sh sanitizers; then
    say "sanitizers: passed with these files (Tests/passed/sanitizers.txt)"
else
    say "sanitizers: not run with these files; Tests/sanitizers.sh does"
fi
