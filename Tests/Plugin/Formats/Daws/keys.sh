#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Keys typed into the plug-in's window in jalv (GTK 3), Ardour and qtractor under Xvfb: what is typed into a value box is the box's, at once, after a click elsewhere and after
# a list was open; Esc closes a list and silences nothing, then it silences; Space, Ctrl-S and F5, which Ardour hands back, come to the host's window once, also after a value.
# A row per host and window manager, of those that are installed; pictures stay. Usage: keys.sh BUILD_FOLDER FOLDER [none|openbox|metacity|icewm]... with HOSTS (jalv ardour ardour-vst3 qtractor)
set -eu
build=$(realpath "$1") here=$(realpath "$(dirname "$0")")
mkdir -p "$2"
folder=$(realpath "$2")
shift 2
export HOME="$folder" XDG_RUNTIME_DIR="$folder" JACK_NO_AUDIO_RESERVATION=1 JACK_DEFAULT_SERVER=physvib-keys DISPLAY=:78 LV2_PATH="$folder/lv2" QT_QPA_PLATFORM=xcb
mkdir -p "$folder/lv2" "$folder/.vst3" "$folder/.config/ardour7"
ln -sfn "$build/plugins/PhysVib.lv2" "$folder/lv2/PhysVib.lv2"
ln -sfn "$build/plugins/PhysVib.vst3" "$folder/.vst3/PhysVib.vst3"

. "$here/windows.sh"
click() { xdotool mousemove --window "$plugin" "$1" "$2" && sleep 0.2 && xdotool click 1 && sleep 0.7; }
open_with_pointer() { xdotool mousemove --window "$1" "$2" "$3" && sleep 0.5 && xdotool click --repeat 2 --delay 120 1; }
run() { # HOST: $host, $top (its window with the plug-in) and $plugin (JUCE's in it)
    case $1 in
        jalv) jalv.gtk3 urn:physvib:plugin >>"$folder/log" 2>&1 & host=$! top='^PhysVib$' ;;
        ardour*)
            rm -rf "$folder/session" && touch "$folder/.config/ardour7/.a7"
            echo '<Ardour><Config><Option name="try-autostart-engine" value="1"/><Option name="hide-dummy-backend" value="0"/></Config><Extra><AudioMIDISetup><EngineStates><State backend="None (Dummy)" driver="Normal Speed" device="Silence" input-device="" output-device="" sample-rate="48000" buffer-size="1024" n-periods="0" input-latency="0" output-latency="0" lm-input="" lm-output="" active="1" use-buffered-io="0" midi-option="" lru="1"/></EngineStates></AudioMIDISetup></Extra></Ardour>' >"$folder/.config/ardour7/config"
            format=lv2 id=urn:physvib:plugin
            [ "$1" = ardour ] || {
                format=vst3 id=ABCDEF019182FAEB5068566250687973
                LD_LIBRARY_PATH=/usr/lib/ardour7 /usr/lib/ardour7/ardour-vst3-scanner -f "$folder/.vst3/PhysVib.vst3" >>"$folder/log" 2>&1
            }
            ardour7-lua "$here/../ardour.lua" make "$folder/session" $format $id >>"$folder/log" 2>&1
            echo '<instant><Main x="0" y="0" w="1380" h="841" current-tab="mixer"/></instant>' >"$folder/session/instant.xml"
            ardour "$folder/session/session.ardour" >>"$folder/log" 2>&1 & host=$! top='^PhysVib: PhysVib'
            main=$(window 'session - Ardour') && sleep 5 && open_with_pointer "$main" 338 188
            ;;
        qtractor)
            gcc -shared -fPIC -o "$folder/alsa-sequencer.so" "$here/alsa-sequencer.c"
            /usr/bin/python3 "$here/daws.py" session qtractor "$folder/keys.qtr" urn:physvib:plugin PhysVib 4
            LD_PRELOAD="$folder/alsa-sequencer.so" qtractor "$folder/keys.qtr" >>"$folder/log" 2>&1 & host=$! top='^PhysVib - '
            main=$(window 'keys.qtr') && sleep 4 && open_with_pointer "$main" 179 182
            ;;
    esac
    top=$(window "$top")
    sleep 3
    plugin=$(xwininfo -id "$top" -tree | awk '$NF ~ /^[+]/ && / 1[0-9][0-9][0-9]x/ { found = $1 } END { print found }') # the innermost
}
silence() { import -window "$plugin" -crop 90x30+1075+12 +repage "txt:-" | md5sum; }
value() { import -window "$plugin" -crop 70x20+314+561 +repage "txt:-" | md5sum; } # the text below the knob
heard() { grep -c '^KeyPress' "$folder/heard" || :; }
fault() { faults="$faults; $1"; }
try() { # HOST MANAGER
    faults='' typed=0 closed=0 once=0
    run "$1"
    xev -id "$top" -event keyboard >"$folder/heard" 2>&1 &
    listening=$!
    for way in at-once after-a-click after-a-list; do
        [ $way = at-once ] || click 200 250
        [ $way != after-a-list ] || {
            before=$(silence)
            click 120 22
            press Escape
            sleep 0.5
            [ "$(silence)" = "$before" ] && closed=1 || fault 'Esc that closes a list silences'
        }
        for digit in 3 6; do
            before=$(value) got=$(heard)
            click 349 571
            press BackSpace $digit Return
            sleep 0.5
            [ "$(value)" != "$before" ] && [ "$(heard)" = "$got" ] && typed=$((typed + 1)) || fault "$way: $digit is not the value, or the host's too"
        done
        for typing in space ctrl+s F5 space; do
            got=$(heard)
            press $typing
            sleep 1
            [ $(($(heard) - got)) = 1 ] && once=$((once + 1)) || fault "$way: $typing came $(($(heard) - got)) times"
        done
        import -window root "$folder/$1-$2-$way.png"
    done
    before=$(silence)
    click 200 250
    press Escape
    sleep 0.5
    [ "$(silence)" != "$before" ] || fault 'Esc did not silence'
    kill -9 $listening $host
    printf '%-11s %-9s %s of 6 values typed, %s of 1 lists closed by Esc without silence, %s of 12 keys once at the host%s\n' "$1" "$2" "$typed" "$closed" "$once" "$faults"
    [ -z "$faults" ] || failed=1
}

failed=0
for manager in "${@:-none openbox metacity icewm}"; do
    for name in $manager; do
        [ "$name" = none ] || command -v "$name" >/dev/null || continue
        for one in ${HOSTS:-jalv ardour ardour-vst3 qtractor}; do
            command -v "${one%-*}" >/dev/null || continue
            started=''
            background Xvfb $DISPLAY -screen 0 1600x1000x24
            sleep 1
            [ "$name" = none ] || background "$name"
            background jackd -r -S -n $JACK_DEFAULT_SERVER -d dummy -r 48000 -p 1024
            sleep 2
            try "$one" "$name"
            kill $started 2>/dev/null || :
            wait $started 2>/dev/null || :
        done
    done
done
exit $failed
