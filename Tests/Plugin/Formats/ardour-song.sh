#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A song in Ardour's Lua shell, without a window or a device: notes, MPE, steps of automation and music at the side chain (Song.cpp).
# Compared: Ardour's own recording of it, live; its stems, a file an actuator; and what physvib-plugin-song renders without a host.
# Usage: ardour-song.sh BUILD_FOLDER lv2|vst3; 77: Ardour is not installed (physvib_host_packages in .ci/packages.sh)
set -eu
build=$(realpath "$1") format=$2 block=512
command -v ardour7-lua >/dev/null || { echo "skipped: Ardour 7 (Debian package ardour) is not installed"; exit 77; }
here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
[ -n "${KEEP:-}" ] && echo "kept: $folder" || trap 'rm -rf "$folder"' EXIT
trap "exit 1" HUP INT TERM
export HOME="$folder"
unset DISPLAY || true
libraries=/usr/lib/ardour7
mkdir -p "$folder/.lv2" "$folder/.vst3" "$folder/.config/ardour7"
"$build/bin/physvib-plugin-song" "$block" "$folder" "$format"
session=$folder/song/song.ardour interchange=$folder/song/interchange/song
ardour() { ardour7-lua "$here/ardour-song.lua" "$@" >"$folder/$1.log" 2>&1; }
lua() { ardour "$@" || { tail -n 20 "$folder/$1.log"; exit 1; }; }
stems() { ardour stems "$folder/song" "$folder"; }
if [ "$format" = lv2 ]; then
    ln -s "$build/plugins/PhysVib-Music.lv2" "$folder/.lv2/"
    mv "$folder/state.lv2" "$folder/.lv2/"
    lua make "$folder/song" lv2 urn:physvib:plugin:music state
    column=3
else
    ln -s "$build/plugins/PhysVib.vst3" "$folder/.vst3/"
    LD_LIBRARY_PATH=$libraries "$libraries/ardour-vst3-scanner" -f "$folder/.vst3/PhysVib.vst3" >"$folder/scan.log" 2>&1
    lua make "$folder/song" vst3 ABCDEF019182FAEB5068566250687973
    column=4
    # Ardour 7.3 waits for itself when it loads a preset of a VST3 made with JUCE, so the state goes into the session's file.
    printf 's|<chunk>[^<]*</chunk>|<chunk>%s</chunk>|; /<vst3 /,/<\\/vst3>/{/<Port /d}\n' "$(base64 -w 0 "$folder/state.vstpreset")" >"$folder/state.sed"
    sed -i -f "$folder/state.sed" "$session"
fi

# What the Lua shell cannot: import the song. As Ardour writes it into a session.
mkdir -p "$interchange/midifiles" "$interchange/audiofiles"
mv "$folder/song.mid" "$interchange/midifiles/"
mv "$folder/music.wav" "$interchange/audiofiles/"
region='muted="0" opaque="1" locked="0" video-locked="0" automatic="0" whole-file="0" import="0" external="0" hidden="0" position-locked="0" stretch="1" shift="1" layering-index="0" first-edit="nothing" channels="1"'
audio='envelope-active="0" default-fade-in="0" default-fade-out="0" fade-in-active="0" fade-out-active="0" scale-amplitude="1"'
cat >"$folder/song.sed" <<END
s|<Sources/>|<Sources><Source name="song.mid" type="midi" flags="" id="90001" natural-position="b0" origin=""/><Source name="music.wav" type="audio" flags="" id="90002" natural-position="a0" channel="0" origin="" gain="1"/></Sources>|
s|\(<Playlist [^>]*name="PhysVib"[^>]*\)/>|\1><Region name="song" id="90003" type="midi" start="b0" length="b46080@b0" sync-position="b0" ancestral-start="b0" ancestral-length="b0@b0" source-0="90001" master-source-0="90001" $region/></Playlist>|
s|\(<Playlist [^>]*name="Music"[^>]*\)/>|\1><Region name="music" id="90004" type="audio" start="a0" length="a3386880000@a0" sync-position="a0" ancestral-start="a0" ancestral-length="a0@a0" source-0="90002" master-source-0="90002" $region $audio/></Playlist>|
END
sed -i -f "$folder/song.sed" "$session"
mkdir -p "$folder/.config/ardour7/export"
cat >"$folder/.config/ardour7/export/float.preset" <<'END'
<?xml version="1.0" encoding="UTF-8"?>
<ExportPreset id="5d1a1d3e-6f0c-4a57-9d3b-2f6c3f7a9e11" name="float">
  <ExportFormat id="20b4ab09-6452-4cb3-bd66-b921cdbd2942"/>
  <ExportFilename>
    <Folder relative="1" path="export"/>
    <Field name="label" enabled="0"/>
    <Field name="session" enabled="0"/>
    <Field name="snapshot" enabled="0"/>
    <Field name="timespan" enabled="1"/>
    <Field name="revision" enabled="0"/>
    <Field name="time" enabled="0" value="T_None"/>
    <Field name="date" enabled="0" value="D_None"/>
  </ExportFilename>
</ExportPreset>
END
# Export to Audio File(s), only the plug-in's track ticked, with Split to mono files: as the dialog keeps it with a session.
{
    echo "<instant><ExportPresets><ExportPreset id=\"5d1a1d3e-6f0c-4a57-9d3b-2f6c3f7a9e11\"><ExportChannelConfiguration split=\"1\" channels=\"4\">"
    for channel in 1 2 3 4; do echo "<Channel number=\"$channel\"><Port name=\"PhysVib/audio_out $channel\"/></Channel>"; done
    echo '</ExportChannelConfiguration></ExportPreset></ExportPresets></instant>'
} >"$folder/song/instant.xml"
lua play "$folder/song" "$folder" "$column"
stems || stems || stems || lua stems "$folder/song" "$folder" # Ardour 7.3 sometimes falls when it splits
grep '^Ardour' "$folder/play.log"
xruns=$(sed -n 's/^Ardour: xruns //p' "$folder/play.log")

# mono FILE.wav, interleaved FILE.wav: the samples of its data chunk
samples() { tail -c +"$(($(grep -abo data "$1" | head -n 1 | cut -d: -f1) + 9))" "$1"; }
failed=0
for channel in 1 2 3 4; do
    samples "$(find "$interchange/audiofiles" -name 'Take*.wav' | sort -V | sed -n "${channel}p")" >"$folder/live-$channel.raw"
    printf 'live, channel %s: ' "$channel"
    "$build/bin/physvib-compare-recording" "$folder/live-$channel.raw" "$folder/song-$channel.raw" 1 "$block" "$xruns" || failed=1
done
for channel in 1 2 3 4; do
    samples "$(find "$folder/export" -name '*.wav' | sort | sed -n "${channel}p")" >"$folder/stem-$channel.raw"
    printf 'stem, channel %s: ' "$channel"
    "$build/bin/physvib-compare-recording" "$folder/stem-$channel.raw" "$folder/song-$channel.raw" 1 "$block" 0 || failed=1
done
exit "$failed"
