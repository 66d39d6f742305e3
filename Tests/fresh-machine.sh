#!/bin/sh
# SPDX-License-Identifier: MIT
# Tries README's two commands on a bare Debian that it makes in a folder of its own; needs root and a network.
#   --suite NAME    bookworm (Debian 12, as is said without it), trixie (13) or sid
#   --same-as BUILD afterwards, renders there are compared with those of this build here: all scenes, layouts and lists
#   --run-only      run.sh alone
#   --programs      run.sh, then run.sh with the programs and a plug-in of each format
#   --own-juce      instead of them, these programs with the JUCE of that suite (8 or 9), installed, and not Debian 12's
#   --tutorials     instead of them, README and the tutorials, typed by follow.py, and what they make felt
#   --packages DIR  instead of them, Debian's packages, built there and put into DIR, which bare-debian.sh tries
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
suite=""
same_as=""
while [ $# -gt 0 ]; do
    case $1 in
        --suite) suite=${2:?"--suite needs a name"} && shift ;;
        --same-as) same_as=$(realpath "${2:?"--same-as needs the folder of a build"}") && shift ;;
        --run-only) commands="run.sh" ;;
        --programs) commands="run.sh programs" ;;
        --own-juce) commands="own-juce programs" ;;
        --tutorials) commands="Tests/Docs/tutorials.sh" ;;
        --packages) commands="release.sh" && release=$(realpath -m "${2:?"--packages needs a folder"}") && shift ;;
        --pages) commands="Tests/Api/ten-minutes.sh" ;;
        --keep) keep=yes ;;
        --cache) cache=$(realpath "${2:?"--cache needs a folder"}") && shift ;;
        --mirror) mirror=${2:?"--mirror needs a URL"} && shift ;;
        *) say "expected --suite NAME, --same-as BUILD, --run-only, --programs, --own-juce, --tutorials, --packages DIR, --pages, --keep, --cache FOLDER or --mirror URL, not $1" && exit 2 ;;
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
programs="run.sh physvib physvib-mixer PhysVibPlugin_VST3 PhysVibPlugin_LV2"
counted() { sed -n "s/.*[[:space:]]$1=\"\([0-9]*\)\".*/\1/p" "$2" | head -n 1; }
packages() { in_machine dpkg-query -W -f '.' | wc -c; }
for command in $commands; do
    before=$(packages)
    count_work
    started=$(date +%s) before_work=$worked
    case $command in
        own-juce) in_machine sh -c "apt-get install -y -qq --no-install-recommends juce-modules-source >/dev/null" ;;
        release.sh)
            in_machine sh -c "apt-get install -y -qq --no-install-recommends git ${cache:+ccache} >/dev/null && cd /root/PhysVib && Standalone/Packaging/release.sh /root/release HEAD dsc packages"
            cp -r "$machine/root/release" "$release"
            ;;
        programs) command=$programs && in_machine sh -c "exec /root/PhysVib/$programs" ;;
        *) in_machine "/root/PhysVib/$command" ;;
    esac
    seconds=$(($(date +%s) - started))
    count_work
    say "$command took $((seconds / 60)):$(printf %02d $((seconds % 60))) min and $(((worked - before_work) / 60)) processor minutes, with $(($(packages) - before)) packages beyond the $before that were there; warnings of the compiler: $(cat "$machine"/root/PhysVib/build/*.log | grep -c ' warning: ' || :)"
    # What CTest wrote of the tests that this command ran.
    for report in "$machine"/root/PhysVib/build/tests-*.xml; do
        [ ! -e "$report" ] || say "$(basename "$report" .xml): $(counted tests "$report") tests, $(counted failures "$report") failed, $(counted skipped "$report") skipped"
    done
done
case $commands in Tests/* | own-juce* | release.sh) exit 0 ;; esac
for file in shake-the-box.wav shake-the-box.csv shake-the-box.png; do
    [ -s "$machine/root/PhysVib/out/$file" ] || { say "out/$file is missing" && exit 1; }
done
[ -n "$same_as" ] || exit 0
# What the first build renders is compared: physvib-render is what every machine has.
PHYSVIB_FINGERPRINT=render Tests/figures/fingerprint.sh "$same_as" >"$machine.here"
in_machine sh -c "cd /root/PhysVib && Tests/figures/fingerprint.sh build/first" >"$machine.there"
differ=$(diff "$machine.here" "$machine.there" | sed -n 's/^> [^ ]* //p' | sort -u)
say "of $(wc -l <"$machine.here") renders, lists of events and pictures, $(diff "$machine.here" "$machine.there" | grep -c '^>' || :) have other bytes than here"
rm -f "$machine.here" "$machine.there"
[ -z "$differ" ] || { printf '%s\n' "$differ" && exit 1; }
