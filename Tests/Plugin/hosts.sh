#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What foreign hosts once made of the plug-in, and what they make of it now: a row per finding, each figure by what is named behind it. Tests are run here; the
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
[ ! -e "$work/failed" ]
