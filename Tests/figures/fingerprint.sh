#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints a checksum of everything that must not change when only the house does: samples and events of every scene, layout,
# law, timing, location and method, the same list on other layouts, a session, the rows of simulated studies, the
# board's image. Compare the output of two builds with diff. Of a build that has physvib-render alone: what that takes, and pictures;
# PHYSVIB_FINGERPRINT=render asks for this of a whole build too.
# Usage: fingerprint.sh BUILD_FOLDER [SECONDS]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
physvib=$build/bin/physvib seconds=${2:-5}
measured=$here/Fuzz/corpus/actuator/measured.json
render="$physvib render" scenes=$(cd "$here/../Source/Scene/Scenes" && ls ./*.json | sed -n '/schema/d; s|^./\(.*\).json|\1|p')
[ -x "$physvib" ] && [ "${PHYSVIB_FINGERPRINT:-}" != render ] || render=$build/bin/physvib-render
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# sum NAME FILE...: one line per file. Lines that name the program's version are no result.
sum() {
    name=$1
    shift
    for file in "$@"; do
        printf '%s %s\n' "$(sha256sum <"$file" | cut -c1-16)" "$name"
    done
}
# rendered NAME ARGUMENTS...
rendered() {
    name=$1
    shift
    # shellcheck disable=SC2086 # a program and its command
    $render "$@" --seconds "$seconds" --out a.wav --events a.csv >/dev/null 2>&1 || { echo "failed $name"; return 0; }
    ! grep -q '^time_s.*,material$' a.csv || sed -i '/^#/!s/,[^,]*$//' a.csv # a name is no figure, and older builds write none
    sum "$name" a.wav a.csv
}

if [ "$render" = "$build/bin/physvib-render" ]; then
    for scene in $scenes; do
        for layout in phone1 phone2 phone3 phone4 ring1 ring2 ring3 ring4 cabinet4 pico4 pico8 glove5 sleeve8 vest16; do
            for set in best scalar; do rendered "$scene $layout $set" "$scene" --layout $layout --instructions $set; done
        done
        for option in '--seed 7 --rate 44100' '--steps-per-second 1000'; do
            # shellcheck disable=SC2086 # an option and its value
            rendered "$scene $option" "$scene" $option
        done
        $render "$scene" --seconds "$seconds" --events list.csv --picture a.png >/dev/null
        sum "$scene picture" a.png
        for layout in phone4 ring2; do rendered "$scene list $layout" list.csv --field 6.4,3.6 --layout $layout; done
    done
    exit 0
fi
for scene in $scenes; do
    for layout in phone1 phone2 phone3 phone4 ring1 ring2 ring3 ring4; do
        for law in linear log log-outer energy; do rendered "$scene $layout $law" "$scene" --layout $layout --law $law; done
    done
    for layout in phone2 ring4 cabinet4 pico8 glove5 sleeve8 vest16; do
        for law in auto neighbours distance triangles; do rendered "$scene $layout $law" "$scene" --layout $layout --law $law; done
    done
    for option in '--timing release' '--location fixture' '--method AF-FV-DRF' '--method AV-FF-DRV' '--steps-per-second 1000' \
        '--limiter off' "--actuator $measured" "--actuator $measured --remap on" '--perceived-level on' '--seed 7 --rate 44100 --block 77'; do
        # shellcheck disable=SC2086 # an option and its value
        rendered "$scene $(echo "$option" | sed 's|/.*/||')" "$scene" $option
    done
    "$physvib" render "$scene" --seconds "$seconds" --events list.csv >/dev/null 2>&1
    for layout in phone4 ring2; do rendered "$scene list $layout" --from-events list.csv --field 6.4,3.6 --layout $layout; done
done
rendered session "$here/Fuzz/corpus/session/two-takes.json"
for protocol in $("$physvib" study list | cut -d' ' -f1 | grep -v -e -thesis$); do
    rm -f -- *.csv
    "$physvib" study run "$protocol" --observer simulated >/dev/null 2>&1 || true
    for file in *.csv; do [ ! -e "$file" ] || sum "study $protocol $file" "$file"; done
done
[ ! -e "$build/firmware/physvib-f334.bin" ] || sum "board's image" "$build/firmware/physvib-f334.bin"
