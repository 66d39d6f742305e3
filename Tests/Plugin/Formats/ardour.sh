#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The plug-in in Ardour's Lua shell without a window, on a JACK server of its own, following JACK's transport, with notes
# from a JACK client; its first eight channels recorded by another: passes if the recording is what a bounce of the same
# state and notes gives, to the bit, but for breaks that the server's xruns explain.
# Usage: ardour.sh BUILD_FOLDER lv2|vst3 [SECONDS] [BLOCK_FRAMES]; 77: Ardour is not installed
set -eu
build=$1 format=$2 seconds=${3:-10} block=${4:-512}
shell=$(command -v ardour7-lua) || { echo "skipped: Ardour 7 (Debian package ardour) is not installed"; exit 77; }
here=$(dirname "$0")
. "$here/../../Live/jack.sh"
libraries=/usr/lib/ardour7
mkdir -p "$folder/.lv2" "$folder/.vst3" "$folder/.config/ardour7"
# It has no other way to be told that JACK's transport leads; and its ports resample, with a delay, unless told.
cat >"$folder/.config/ardour7/config" <<'END'
<?xml version="1.0" encoding="UTF-8"?>
<Ardour>
  <Config><Option name="port-resampler-quality" value="0"/></Config>
  <TransportMasters current="JACK Transport"><TransportMaster type="Engine" name="JACK Transport" removeable="0"/></TransportMasters>
</Ardour>
END
serve 48000 "$block" 8
"$build/bin/physvib-plugin-bounce" 8 "$seconds" "$block" "$folder" >"$folder/bounce.raw"
session=$folder/session/session.ardour
if [ "$format" = lv2 ]; then
    ln -s "$build/plugins/PhysVib-8.lv2" "$folder/.lv2/"
    mv "$folder/state.lv2" "$folder/.lv2/"
    "$shell" "$here/ardour.lua" make "$folder/session" lv2 urn:physvib:plugin:8 state >"$folder/make.log" 2>&1
else
    ln -s "$build/plugins/PhysVib-Pairs.vst3" "$folder/.vst3/"
    LD_LIBRARY_PATH=$libraries "$libraries/ardour-vst3-scanner" -f "$folder/.vst3/PhysVib-Pairs.vst3" >"$folder/scan.log" 2>&1
    "$shell" "$here/ardour.lua" make "$folder/session" vst3 ABCDEF019182FAEB5068566250687970 >"$folder/make.log" 2>&1
    # Ardour 7.3 waits for itself when it loads a preset of a VST3 made with JUCE, so the state goes into the session's file.
    state=$(base64 -w 0 "$folder/state.vstpreset")
    printf 's|<chunk>[^<]*</chunk>|<chunk>%s</chunk>|; /<vst3 /,/<\\/vst3>/{/<Port /d}\n' "$state" >"$folder/state.sed"
    sed -i -f "$folder/state.sed" "$session"
fi

# Sometimes the JACK library closes Ardour's connection while Ardour connects its ports from two threads.
start() {
    "$shell" "$here/ardour.lua" play "$folder/session" "$((seconds + 30))" >"$folder/ardour.log" 2>&1 &
    playing=$!
    for _ in $(seq 300); do grep -q '^Ardour' "$folder/ardour.log" && break; sleep 0.1; done
    ! grep -q HALTED "$folder/ardour.log" && return
    kill "$playing"
    return 1
}
start || start || start
grep '^Ardour' "$folder/ardour.log" # from now on it leaves its ports' connections alone
"$build/bin/physvib-jack-recorder" "$folder/live.raw" 8 "$((seconds + 2))" "ardour:PhysVib/audio_out " >"$folder/ready" &
recording=$!
for _ in $(seq 100); do grep -q ready "$folder/ready" && break; sleep 0.1; done
"$build/bin/physvib-jack-notes" "ardour:PhysVib/midi_in 1" "$seconds" || { tail -n 20 "$folder/ardour.log"; exit 1; }
wait "$recording" || { tail -n 20 "$folder/ardour.log"; exit 1; }
"$build/bin/physvib-compare-recording" "$folder/live.raw" "$folder/bounce.raw" 8 "$block" "$(sed -n 's/xruns //p' "$folder/ready")"
