#!/bin/sh
# SPDX-License-Identifier: MIT
# Everything that is too long for test.sh: the other modules under the sanitizers, a million fuzzed inputs, soaks, other processors and
# systems, programs of others that judge ours. It needs root, a network, and about nine hours on two cores.
# Prints a line per step as it ends, and a table. Logs: build/nightly/STEP.log. Exit code 1 if a step failed.
# Usage: nightly.sh [STEP...]; nightly.sh --list
set -u
cd "$(dirname "$0")/.."
. .ci/packages.sh
bin=build/release/bin

under() { build "$1" all && ctest --preset "$1" -j2 -LE 'live|display|checked' && ctest --preset "$1" -L display --repeat until-pass:2; }
# of_label LABEL: all tests of it; what passed is kept, and test.sh leaves them out until it changes.
of_label() {
    # shellcheck disable=SC2086 # a list of words
    ensure_packages $physvib_engine_packages && build release all &&
        ctest --preset release -L "$1" --no-tests=error --output-junit "$PWD/build/tests-$1.xml" --test-output-size-passed 1000000 &&
        Tests/House/skipped.py --quiet --at-night PHYSVIB_PICO_SDK build/release "build/tests-$1.xml" && Tests/passed.sh "$1" --keep
}
step() {
    case $1 in
        asan) under asan ;;
        tsan) under tsan ;;
        sanitizers) Tests/sanitizers.sh --keep --at-night PHYSVIB_PICO_SDK ;;
        fuzz) build asan physvib-fuzzers && Tests/Fuzz/run.sh 1000000 ;;
        doors) build asan physvib-hostile-doors && build/asan/bin/physvib-hostile-doors 1000000 "$(date +%j)" ;;
        freed) Tests/Physics/freed.sh ;;
        hostile) Tests/Hostile/run.sh 10000 ;;
        guard) $bin/physvib-guard-figures attack 20000 ;;
        kills) Tests/CommandLine/kills.sh $bin 200 render study play ;;
        receipts) ensure_packages valgrind && Tests/Benchmarks/receipts.sh $bin ;;
        full-disk) Tests/CommandLine/full-disk.sh $bin ;;
        kinds) ensure_packages ffmpeg sox && Tests/Live/sounds.py $bin/physvib-sound-kinds --judges && Tests/Formats/texts.py $bin/physvib ;;
        skipped) ensure_packages openbox && Tests/Plugin/skipped.sh $bin ;;
        engines) of_label engines ;;
        laboratory) of_label laboratory ;;
        box2d3) Tests/Engines/box2d3.sh build/release ;;
        farseer) ensure_packages git mono-mcs mono-runtime && Tests/Engines/farseer.sh build/release ;;
        pymunk) Tests/Api/pymunk.sh $PWD/build/release/lib/libphysvib.so.1 ;;
        quick) Tests/quick.py build/release ;;
        osc) Tests/Osc/run.sh $bin && Tests/Osc/oscquery.sh ;;
        jalv) ensure_packages jalv && Tests/Plugin/Formats/jalv.sh "$PWD/build/release" 5 ;;
        ardour) ensure_packages $physvib_host_packages && for format in lv2 vst3; do Tests/Plugin/Formats/ardour-song.sh build/release $format || return 1; done ;;
        daws) Tests/Plugin/Formats/Daws/daws.sh build/release build/nightly/daws ;;
        keys) ensure_packages jalv ardour qtractor openbox xdotool imagemagick x11-utils xvfb jackd2 && Tests/Plugin/Formats/Daws/keys.sh build/release build/nightly/keys ;;
        hosts) Tests/Plugin/hosts.sh build/release ;;
        apply) ensure_packages $physvib_apply_packages && Tests/Plugin/Formats/apply.sh "$PWD/build/release" ;;
        live) Tests/Live/soak.sh ;;
        mixer) Tests/Mixer/soak.sh && ensure_packages openbox && Tests/Mixer/headphones.sh $bin ;;
        breaks) Tests/breaks.py build/release build/nightly/breaks ;;
        studies) ensure_packages r-cran-lme4 && Tests/Study/R/run.sh Tests/Study/R/analysis_test.R Source/Lab/Script/analysis.R && Tests/Studies/recorded.sh $bin && Tests/Studies/faults.sh $bin && Tests/Studies/every-fault.sh $bin ;;
        coverage) $bin/physvib-study-coverage && ensure_packages r-cran-lme4 && Tests/Study/R/run.sh Tests/Study/R/alarms.R Source/Lab/Script/analysis.R ;;
        hours) Tests/ten-hours.sh ;;
        realtime) Tests/Realtime/rtsan.sh ;;
        projucer) Tests/House/projucer.sh ;;
        tidy) Tests/House/tidy.sh ;;
        abi) Tests/Release/abi.sh ;;
        meson) ensure_packages meson && Tests/Package/meson.sh "$(mktemp -d)/felt" ;;
        sweep) Tests/Sweep/sweeps.sh $bin ;;
        godot) Tests/godot.sh build/release build/nightly/godot && Tests/godot-sanitized.sh build/nightly/godot && Tests/godot-cross.sh build/nightly/godot-arm64 ;;
        web) Tests/web.sh $bin/physvib ;;
        javascript) Tests/javascript.sh $bin/physvib ;;
        bundlers) Source/Api/JavaScript/build-package.sh && Tests/JavaScript/bundlers.sh && Tests/JavaScript/browsers.sh && Tests/JavaScript/outputs.sh ;;
        site) Tests/site.sh ;;
        movies) Tests/CommandLine/movies.sh $bin/physvib ;;
        report) Tests/figures/report.sh $bin/physvib build/nightly/report ;;
        arm64) Tests/arm64.sh $bin/physvib-render ;;
        windows) Tests/windows.sh $bin/physvib-render ;;
        fresh) Tests/fresh-machine.sh --same-as build/release ;;
        fresh-13) Tests/fresh-machine.sh --suite trixie --same-as build/release ;;
        fresh-sid) Tests/fresh-machine.sh --suite sid --same-as build/release ;;
        juce-8) Tests/fresh-machine.sh --suite trixie --own-juce ;;
        juce-9) Tests/fresh-machine.sh --suite sid --own-juce ;;
        no-lab) Tests/House/no-lab.sh build/no-lab ;;
        options) Tests/House/options.sh "$(mktemp -d)" ;;
        additions) Tests/House/additions.py build/nightly/additions ;;
        pages) Tests/fresh-machine.sh --pages ;;
        pico) .ci/pico-sources.sh && build release physvib-pico physvib-render && Tests/Firmware/pico.sh ;;
        pads) /usr/bin/python3 Tests/Pads/judge.py $bin/physvib build/release/Tests/Pads/libphysvib-plug-in.so 600 ;;
        packages) Tests/Release/bare-debian.sh ;;
        reproducible) Tests/Release/reproducible.sh npm page site firmware windows arm64 packages wheel sbom ;;
        *) echo "no step of this name" && return 2 ;;
    esac
}
steps=$(sed -n 's/^        \([a-z0-9-]*\)) .*;;$/\1/p' "$0")
[ "${1:-}" != --list ] || { echo "$steps" && exit; }
[ $# -eq 0 ] || steps="$*"

# shellcheck disable=SC2086 # a list of words
ensure_build_packages $physvib_test_packages && build release all physvib-by-hand || exit 1
mkdir -p build/nightly
table=$(mktemp)
trap 'rm -f "$table"' EXIT
for name in $steps; do
    began=$(date +%s)
    if (step "$name") >"build/nightly/$name.log" 2>&1; then ended=passed; else ended=FAILED; fi
    printf '%-14s %-7s %6d s  %s\n' "$name" "$ended" $(($(date +%s) - began)) "$(grep -a . "build/nightly/$name.log" | tail -n 1 | cut -c1-90)" | tee -a "$table"
done
echo
cat "$table"
! grep -q FAILED "$table"
