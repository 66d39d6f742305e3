#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Exports of qtractor and MuSE, driven by keys and pointer under Xvfb: three of the plug-in on a stereo track, as a new instance is (Keys), and one of a probe
# that answers when the host plays its notes. The exports are to be equal, and each note as late as is told.
# From qtractor also four stems as first-track.md has them, of the LV2 and, where a build has it, of the CLAP: they are to be what the plug-in plays without a host.
# Usage: daws.sh BUILD_FOLDER FOLDER [qtractor|muse]...
set -eu
build=$(realpath "$1") here=$(realpath "$(dirname "$0")")
mkdir -p "$2"
folder=$(realpath "$2")
shift 2
. "$here/../../../../.ci/packages.sh"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_daw_packages
told=47 # frames: the limiter's (Docs/plugin-reference.md)
uri=urn:physvib:plugin:2
export HOME="$folder" XDG_RUNTIME_DIR="$folder" JACK_NO_AUDIO_RESERVATION=1 JACK_DEFAULT_SERVER=physvib-daws DISPLAY=:77 LV2_PATH="$folder/lv2" QT_QPA_PLATFORM=xcb
mkdir -p "$folder/lv2/onset-probe.lv2"
gcc -shared -fPIC -O2 -o "$folder/lv2/onset-probe.lv2/onset-probe.so" "$here/onset-probe.c"
cp "$here/onset-probe.ttl" "$folder/lv2/onset-probe.lv2/manifest.ttl"
gcc -shared -fPIC -o "$folder/alsa-sequencer.so" "$here/alsa-sequencer.c"
for width in PhysVib PhysVib-2; do ln -sfn "$build/plugins/$width.lv2" "$folder/lv2/$width.lv2"; done
daws() { /usr/bin/python3 "$here/daws.py" "$@"; }

. "$here/windows.sh"
background Xvfb $DISPLAY -screen 0 1400x900x24
sleep 1
background openbox
background jackd -n $JACK_DEFAULT_SERVER -d dummy -r 48000 -p 1024
sleep 2

click() { xdotool mousemove --window "$1" "$2" "$3" click 1 && sleep 0.7; }
written() { # FILE: waits until it grows no more
    last=0
    for _ in $(seq 60); do
        sleep 1
        size=$(stat -c %s "$1" 2>/dev/null || echo 0)
        [ "$size" -gt 1000000 ] && [ "$size" = "$last" ] && return
        last=$size
    done
    import -window root "$folder/no-file.png"
    say "$1: expected an export; the screen is $folder/no-file.png" && exit 1
}

export_from_qtractor() { # SESSION FILE [save]
    LD_PRELOAD="$folder/alsa-sequencer.so" qtractor "$1" >>"$folder/log" 2>&1 &
    daw=$!
    main=$(window '[.]qtr')
    sleep 3
    xdotool windowfocus --sync "$main"
    press alt+t x a
    dialog=$(window 'Export Audio Tracks')
    sleep 1
    press ctrl+a
    xdotool type "$2" && sleep 0.5
    click "$dialog" 176 93 # the sample format: float
    press Home f Return
    click "$dialog" 263 147 # the bus
    click "$dialog" 296 345 # OK
    written "$2"
    [ -z "${3:-}" ] || { xdotool windowfocus --sync "$main" && press ctrl+s && sleep 1; }
    kill -9 $daw
}
stems_from_qtractor() { # PLUG-IN NAME: its four channels, and whether they are ours, of the state that is loaded and that qtractor has saved
    session=$folder/qtractor/$2.qtr
    daws session qtractor "$session" "$1" PhysVib 4 "$folder"
    for way in loaded saved; do
        export_from_qtractor "$session" "$folder/qtractor/$2-$way.wav" save
        grep -q 'version="Qtractor' "$session" || { say "$session: expected that qtractor saves it" && exit 1; }
        sndfile-deinterleave "$folder/qtractor/$2-$way.wav" >>"$folder/log"
        daws stems "$folder/ours.raw" "$folder/qtractor/$2-${way}"_0?.wav
    done
}
more_of_qtractor() {
    daws notes "$folder/qtractor/probe.wav" >"$folder/notes.txt"
    "$build/bin/physvib-plugin-bounce" 4 9 64 "$folder" "$folder/notes.txt" >"$folder/ours.raw"
    stems_from_qtractor urn:physvib:plugin lv2
    [ -e "$build/plugins/PhysVib.clap" ] || { echo 'no CLAP in this build' && return; }
    stems_from_qtractor "$build/plugins/PhysVib.clap" clap
}
export_from_muse() {
    muse "$1" >>"$folder/log" 2>&1 &
    daw=$!
    window 'MusE Project' >/dev/null
    for _ in $(seq 10); do # what it says and asks first
        asked=$(xdotool search --onlyvisible --name 'Did you know|Instrument initialization' | tail -n 1)
        [ -z "$asked" ] || { xdotool windowfocus "$asked" && press Escape; } || :
        sleep 0.7
    done
    main=$(window 'MusE Project')
    xdotool windowfocus --sync "$main"
    press alt+a Down Return
    dialog=$(window 'Set Downmix Wavefile')
    sleep 1
    click "$dialog" 355 26 # a file
    sleep 2
    xdotool type "$2" && sleep 0.5
    press Return
    click "$dialog" 297 57 # the format: the last
    press End Return
    click "$dialog" 243 90 # OK
    written "$2"
    kill -9 $daw
}

for daw in "${@:-qtractor muse}"; do
    for name in $daw; do
        extension=qtr
        [ "$name" = qtractor ] || extension=med
        mkdir -p "$folder/$name"
        rm -f "$folder/$name"/*.wav
        daws session "$name" "$folder/$name/probe.$extension" urn:physvib:test:onset-probe 'Onset probe LV2'
        daws session "$name" "$folder/$name/physvib.$extension" $uri 'PhysVib-2 LV2'
        export_from_"$name" "$folder/$name/probe.$extension" "$folder/$name/probe.wav"
        for i in 1 2 3; do export_from_"$name" "$folder/$name/physvib.$extension" "$folder/$name/export-$i.wav"; done
        echo "$name"
        daws compare $told "$folder/$name/probe.wav" "$folder/$name"/export-?.wav
        [ "$name" != qtractor ] || more_of_qtractor
    done
done
