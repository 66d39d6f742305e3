#!/bin/sh
# SPDX-License-Identifier: MIT
# ./run.sh: renders "shake the box" into out/: four channels, an event list, a picture. It installs and builds what that takes, which is
# little; with a display it then does the same for the mixer, and opens it.
# ./run.sh PROGRAM...: installs what is missing, and builds these in build/release/bin: physvib, physvib-mixer, physvib-virtual-board ...
set -eu
cd "$(dirname "$0")"
. .ci/packages.sh

programs() {
    # shellcheck disable=SC2046,SC2086 # lists of words
    ensure_build_packages $physvib_run_packages $(case " $* " in *" physvib-virtual-board "*) echo "$physvib_board_packages" ;; esac)
    build release "$@"
}
# Refused before anything is installed: what is no program of ours.
for name in "$@"; do
    case $name in
    -h | --help) sed -n '3,/^set/{/^#/s/^# //p}' run.sh && exit 0 ;;
    physvib | physvib-*) ;;
    *) say "$name: expected programs, as: ./run.sh physvib physvib-mixer; options are those of the program, once it is built" && exit 2 ;;
    esac
done
if [ $# -gt 0 ]; then
    programs "$@"
    for name in "$@"; do [ ! -x "build/release/bin/$name" ] || echo "build/release/bin/$name"; done
    sed -n 's/^-- \(JUCE [0-9].*\)/\1/p' build/release.log 2>/dev/null || :
    # shellcheck disable=SC2016 # for the reader's shell
    echo 'Pages call it by its name alone; for that, here: export PATH="$PWD/build/release/bin:$PATH"'
    exit 0
fi

# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_first_packages
build first physvib-render
mkdir -p out
name=out/shake-the-box
render=build/first/bin/physvib-render
$render shake-the-box --out $name.wav --events $name.csv --picture $name.png >build/render.log
cat <<END
$name.wav  four channels of vibration, one per actuator
$name.csv  every impact in it: when, where, how hard; $name.png is the picture to look at
$render $name.csv --out out/again.wav  renders a list of impacts, this one or yours; --help has the rest
END
next='./run.sh physvib  builds the program of all pages (a quarter of an hour at most, on two slow cores); then
build/release/bin/physvib play out/shake-the-box.wav  says what you can play it on, and how'
[ -n "${DISPLAY:-}" ] || { echo "There is no display, so the mixer was not built. $next" && exit 0; }
say "there is a display: now the mixer, with all that it needs (a quarter of an hour on two slow cores)"
programs physvib physvib-mixer
echo "Next time: build/release/bin/physvib-mixer; the command line is build/release/bin/physvib --help; pages: Docs/README.md"
exec build/release/bin/physvib-mixer # the same scene, to see, to feel, to hear and to mix
