#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What foreign hosts once made of the plug-in, and what they make of it now: a row per finding, each figure by what is named behind it; and what held in
# them, by the tests that hold it in the finished modules: 248 checks of a VST3 host and 80 of an LV2 host, by their kinds. Tests are run here; the
# scripts that drive hosts leave their logs in FOLDER (Tests/nightly.sh: steps ardour, daws, keys), and rows without one say so.
# Exit code 1 if a row that was measured is not as it has to be. Usage: hosts.sh BUILD_FOLDER [FOLDER (build/nightly)]
set -eu
build=$(realpath "$1") logs=${2:-build/nightly}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

tested() { # PROGRAM FILTER: its output
    "$build/bin/physvib-$1-tests" --gtest_filter="$2" >"$work/out" 2>&1 || { : >"$work/failed" && grep '^\[  FAILED' "$work/out" >&2; }
    grep -v '^\[\|^Note\|^Running\|^$' "$work/out" || echo 'NOT MEASURED'
}
row() { # FINDING WAS BY; now: standard input, a line or several
    printf '%-4s %s\n     was: %s\n' "$1" "$3" "$2"
    sed 's/^/     now: /'
}
logged() { # STEP PATTERN: of its log, each line once
    if [ -e "$logs/$1.log" ]; then
        grep -a -- "$2" "$logs/$1.log" || { : >"$work/failed" && echo 'NOT MEASURED'; }
    else
        echo "not run: Tests/nightly.sh $1"
    fi
}
# of lines with sizes: the least and the most
span() { awk '{ for (i = 1; i < NF; ++i) if ($(i + 1) == "bytes,") { n = $i; least = !c || n < least ? n : least; most = n > most ? n : most; ++c } } END { printf "%d to %d bytes, %d presets\n", least, most, c }'; }

logged keys 'values typed' | row F1 'typed values went to the host after a list or a click: 5 of 7 ways' 'Formats/Daws/keys.sh'
logged keys 'values typed' | sed 's/.*typed, //; s/;.*//' | sort | uniq -c | sed 's/^ *\([0-9]*\)/\1 hosts under window managers:/' |
    row F2 'Esc that closes a list silenced, 6 of 6, and a session kept it' 'Formats/Daws/keys.sh; kept: HostKeys.WhatNoControlUses...'
logged ardour '^stem' | sed 's/recording: //' | row F3 "Ardour's stem export: one MIDI file, no sound" 'Formats/ardour-song.sh, LV2 and VST3'
tested plugin 'PluginChunk.APresetIsTheSame*' | row F4 'a preset was another after other presets: 6 of 6 ways to a world' 'PluginChunk.APresetIsTheSameWhateverWasChosenBefore'
{ tested plugin 'Voice.PressureIsOf*' && tested format 'RawVst3.ExpressionOf*'; } |
    row F5 "pressure of keys, note expression, MPE's master: no change" 'Voice.PressureIsOfItsKey..., RawVst3.ExpressionOfANote...'
tested plugin 'Voice.AMasterBends*' | row F6 'CC 121 was not read: 293.66 Hz instead of 261.63' 'Voice.AMasterBends...'
tested plugin 'PluginMemory.APrepared*' | span | row F7 'an instance: 6.0 to 6.6 MB, 8.1 with a world' 'PluginMemory.APreparedInstanceTakesTwoMegabytes'
tested plugin 'PluginMemory.OfAnInstanceByKind' | sed 's/memory of an instance: *//' | row F7 '5.6 of 9.6 MB were contacts, also without a body' 'PluginMemory.OfAnInstanceByKind'
tested realtime 'RealtimePlugin.TightTakesNoMemory' | awk '{ n += $3; ++c } END { printf "%d pieces of memory in %d worlds, 3,000 render calls each\n", n, c }' |
    row F8 'Timing tight: 12 to 27 pieces of memory in 4 s' 'RealtimePlugin.TightTakesNoMemory'
tested realtime 'RealtimeModule.TakesNoMemoryHowever*' | awk '{ ms = $(NF - 1) > ms ? $(NF - 1) : ms } END { printf "%d blocks of 10,000 events without memory, at most %.1f ms each\n", NR, ms }' |
    row F8 'VST3: thousands of events in a block took memory' 'RealtimeModule.TakesNoMemoryHoweverManyNotesComeInABlock'
tested realtime 'RealtimeModule.OfLv2*' | row F8 'LV2: a lock a block' 'RealtimeModule.OfLv2TakesNoMemoryAndNoLock'
logged daws 'are ours\|differ by' | row F9 "qtractor's four channels ended in two" 'Formats/Daws/daws.sh; steps: first-track.md'
sed -n 's/.*lv2:m\(inor\|icro\)Version \([0-9]*\) .*/m\1 version \2/p' "$build"/plugins/PhysVib.lv2/dsp.ttl | row F10 "LV2's version 0.0, which means unstable" 'the bundle'
tested plugin 'PluginProcessor.HostsShow*' | row F10 'units twice, "-0.0 dB"' 'PluginProcessor.HostsShowAUnitOnceAndNoMinusZero'

# PROGRAM (or ctest: a test of that name), FILTER, WHAT of these checks
while IFS='|' read -r program filter what; do
    case $program in
        ctest) ctest --test-dir "$build" -R "^$filter\$" --no-tests=error </dev/null >"$work/out" 2>&1 && ended=passed || ended=FAILED
            ! grep -q 'Skipped' "$work/out" || ended='not run' ;;
        *) "$build/bin/physvib-$program-tests" --gtest_filter="$filter" </dev/null >"$work/out" 2>&1 && grep -q '^\[  PASSED  \] [1-9]' "$work/out" && ended=passed || ended=FAILED ;;
    esac
    [ "$ended" != FAILED ] || : >"$work/failed"
    printf '%-7s %s\n        by %s\n' "$ended" "$what" "$filter"
done <<'END'
format|RawVst3.AnyPresetIsTheSame*|VST3: every preset, in blocks of 0, 1, 8,192 and any, is the same to the bit and within full scale
format|RawVst3.AnyPresetIsTheSame*|VST3: so it is set up and called as a bounce, live, ahead, or by turns; and in time, a world with a mix, Direct or not
format|RawVst3.SixtyFourInstances*|VST3: 64 instances on 12 threads in blocks of 64 to 2,048, the latency taken out
format|RawVst3.AStateSavedAmongNotes*|VST3: a state saved in the middle of notes, loaded elsewhere
format|RawVst3.AShortLoop*|VST3: loops of 100 and 10 ms with Restart on play
format|RawVst3.WhereASongStands*|VST3: places negative, INT64_MIN and MAX, standing, jumping, backwards; tempo 0, NaN, 1e300; no context
format|RawVst3.PointsOfParameters*|VST3: 10,240 points of ten parameters a block of 8,192, as in blocks of 1 to 1,000
format|RawVst3.FloodsAndNonsense*|VST3: 16,000 notes in 8 frames, 2,000 held, 20,000 more, into a world too
format|RawVst3.FloodsAndNonsense*|VST3: channels -1 and 255, pitch 128, velocity NaN, 70 kB of sysex, unknown kinds, frames beyond the block
realtime|RealtimeModule.TakesNoMemory*|VST3: no memory in the render call, in floods too
format|RawVst3.ANoteIsFeltAtItsFrame*|VST3: a note at each frame of 0 to 511 is felt there
format|RawVst3.ANoteIsFeltAtItsFrame*|VST3: 600 activations leave no memory behind, with a world and without
format|RawVst3.StatesComeAndGo*|VST3: states and presets set on another thread beside the render
format|RawVst3.TheFirstNSpeakers|VST3: 1 to 16 channels taken, 17 and 7.1.4 refused
format|RawVst3.Surround*:RawVst3.Pairs:RawVst3.MonoBuses:RawVst3.WithoutAny*|VST3: each enchanter on its channel in every arrangement, on pairs, on mono buses, in none
format|RawVst3.StateComesBack*|VST3: a state comes back, also one that cannot be read; suspended and resumed, the take is the same
format|RawVst3.TheSideChain*:RawVst3.WhatComesIn*|VST3: the side chain is off, and felt as in the processor
format|RawVst3.Expression*:RawVst3.StandIns*:RawVst3.ShortTitles*|VST3: expression of single notes, controllers, titles
format|HostedFormats.Vst3:HostedFormats.Lv2OfEveryWidth|VST3, LV2 of every width: the processor's samples
format|HostedFormats.Parameters*:HostedFormats.StateGoes*|VST3, LV2: parameters, defaults, states in JUCE's host
format|HostedFormats.TheHostIsTold*|VST3, LV2: Timing switched 40 times, the latency is told
format|ModulesTogether.PlayWhat*|VST3, LV2: rates of 5,000 to 192,000 Hz in blocks of 1 to 16,384
format|ModulesTogether.AreSilent*|VST3, LV2: rates of -1, 0, 1, 4,999, 192,001, 384,000, 384,001, 1e9 Hz are silent
format|ModulesTogether.SeeNothing*|VST3, LV2: in one process, neither sees the other
format|Silence.*|VST3, LV2: SILENCE by every door
format|RawLv2.BlocksFarLarger*|LV2: blocks to 100,000 where 512 was announced, ports moved before each, activated again
format|RawLv2.WhatSetsAParameter*|LV2: 10,240 patch:Set a block of 8,192, as in blocks of 64 to 1,000
format|RawLv2.APortThatHoldsNoNumber*|LV2: controls and patch:Set of NaN, infinity, 1e30
format|RawLv2.Malformed*|LV2: time positions of wrong kinds, INT64_MIN and MAX, NaN; empty and 70 kB MIDI, unknown atoms
format|RawLv2.AVelocityBeyond*|LV2: data bytes beyond 127 are no louder
format|RawLv2.StatesAreSaved*|LV2: states saved and restored 800 times beside blocks
format|RawLv2.WhatWasSetLast*:RawLv2.APortThatIsOther*:RawLv2.APreset*:RawLv2.AControlPort*|LV2: ports beside states, whichever came last
format|RawLv2.TheLatency*:RawLv2.NothingIsTold*:RawLv2.TheHostsSwitch*|LV2: latency by the usual block, the host's switch
format|RawLv2.Music*:RawLv2.AHostThatKnows*:RawLv2.Descriptions*|LV2: music, hosts of the core alone, descriptions
realtime|RealtimeModule.OfLv2*|LV2: no memory and no lock in the render call
ctest|Live.JalvPlaysWhatABounceGives|LV2: live in jalv is the bounce
ctest|SilenceButton.InEveryFormatsWindow|windows of VST3 and LV2 opened again and again: no thread and no descriptor stays
ctest|PluginEditor.OpensFiftyTimesInAWindow|no memory stays of a window
ctest|HostedFormats.ModulesShowTheirEntryPointsOnly|modules show their entry points only
plugin|Loudness.*|presets are as strong as each other on 1 to 16 outputs
END
[ ! -e "$work/failed" ]
