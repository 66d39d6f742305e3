#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Keys typed into the plug-in's window in jalv (GTK 3) under Xvfb: what is typed into a value box is the box's, at once, after a click elsewhere and after a list was
# open; Esc closes a list and silences nothing, then it silences. A row per window manager, of those that are installed; pictures stay. Usage: keys.sh BUILD_FOLDER FOLDER [none|openbox|metacity|icewm]...
set -eu
build=$(realpath "$1") here=$(realpath "$(dirname "$0")")
mkdir -p "$2"
folder=$(realpath "$2")
shift 2
export HOME="$folder" XDG_RUNTIME_DIR="$folder" JACK_NO_AUDIO_RESERVATION=1 JACK_DEFAULT_SERVER=physvib-keys DISPLAY=:78 LV2_PATH="$folder/lv2"
mkdir -p "$folder/lv2"
ln -sfn "$build/plugins/PhysVib.lv2" "$folder/lv2/PhysVib.lv2"

. "$here/windows.sh"
click() { xdotool mousemove --window "$plugin" "$1" "$2" && sleep 0.2 && xdotool click 1 && sleep 0.7; }
silence() { import -window "$plugin" -crop 90x30+1075+12 +repage "txt:-" | md5sum; }
value() { import -window "$plugin" -crop 70x20+314+561 +repage "txt:-" | md5sum; } # the text below the knob
fault() { faults="$faults; $1"; }
try() { # MANAGER
    faults='' typed=0 closed=0
    jalv.gtk3 urn:physvib:plugin >>"$folder/log" 2>&1 &
    host=$!
    plugin=$(window '^jalv.gtk3$')
    sleep 3
    for way in at-once after-a-click after-a-list; do
        [ $way = at-once ] || click 200 250
        [ $way != after-a-list ] || {
            before=$(silence)
            click 120 22
            press Escape
            sleep 0.5
            [ "$(silence)" = "$before" ] && closed=1 || fault 'Esc that closes a list silences'
        }
        for key in 3 6; do
            before=$(value)
            click 349 571
            press BackSpace $key Return
            sleep 0.5
            [ "$(value)" != "$before" ] && typed=$((typed + 1)) || fault "$way: $key is not the value"
        done
        import -window root "$folder/$1-$way.png"
    done
    before=$(silence)
    click 200 250
    press Escape
    sleep 0.5
    [ "$(silence)" != "$before" ] || fault 'Esc did not silence'
    kill -9 $host
    printf '%-9s %s of 6 values typed, %s of 1 lists closed by Esc without silence%s\n' "$1" "$typed" "$closed" "$faults"
    [ -z "$faults" ] || failed=1
}

failed=0
for manager in "${@:-none openbox metacity icewm}"; do
    for name in $manager; do
        [ "$name" = none ] || command -v "$name" >/dev/null || continue
        started=''
        background Xvfb $DISPLAY -screen 0 1600x1000x24
        sleep 1
        [ "$name" = none ] || background "$name"
        background jackd -r -S -n $JACK_DEFAULT_SERVER -d dummy -r 48000 -p 1024
        sleep 2
        try "$name"
        kill $started 2>/dev/null || :
        wait $started 2>/dev/null || :
    done
done
exit $failed
