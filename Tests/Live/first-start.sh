#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# first-start.sh BIN_FOLDER [jack | none | pad | board] [PLUG_IN.so [IMAGE.elf]]: the mixer is started with a cold home folder
# beside a JACK server of eight outputs, with no device at all, with a virtual controller or a virtual board. One press of
# Return opens the likely one, and it plays. Counts what is pressed, and prints how long that took from the start and from the
# press. The plug-in is that of Tests/Pads or Tests/Board, the image the board's.
set -eu
bin=$(cd "$1" && pwd)
kind=${2:-jack}
here=$(cd "$(dirname "$0")" && pwd)
command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || { echo "skipped: needs the packages xvfb, xauth and xdotool"; exit 77; }
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$@"
fi
plugin=${3:+$(realpath "$3")} image=${4:+$(realpath "$4")}
display=$DISPLAY
. "$here/jack.sh"
[ "$kind" != jack ] || serve 48000 256 8
export XDG_CONFIG_HOME="$folder/config" DISPLAY="$display"
export PHYSVIB_PAD_LOG="$folder/pad" PHYSVIB_PAD_FIRST=yes PHYSVIB_BOARD_PORT="$folder/port"
now() { date +%s.%N; }
later() { awk -v a="$1" -v b="$(now)" 'BEGIN { printf "%.1f", b - a }'; }
fail() { echo "$*"; cat "$folder/mixer.log"; exit 1; }
preload=""
case $kind in
pad) preload=$plugin ;;
board)
    preload=$plugin
    "$bin/physvib-virtual-board" "$image" --link "$folder/port" --log "$folder/sound.csv" >/dev/null 2>"$folder/board" &
    playing=$!
    until [ -e "$folder/port" ]; do sleep 0.05; done
    ;;
esac
sounds() { # whether what plays is above silence
    case $kind in
    jack) jack_lsp 2>/dev/null | grep -q "out_1$" ;;
    pad) grep -qE " (0\.0*[1-9][0-9]*|1\.0000)( |$)" "$folder/pad" 2>/dev/null ;;
    board) [ "$(wc -l <"$folder/sound.csv")" -gt "$quiet" ] ;;
    esac
}
began=$(now)
LD_PRELOAD="$preload" "$bin/physvib-mixer" --summary >"$folder/mixer.log" 2>&1 &
mixer=$!
playing="$mixer $playing"
until window=$(xdotool search --name "PhysVib mixer" 2>/dev/null); do sleep 0.05; done
sleep 3 # as long as a person reads
[ "$kind" != jack ] || ! jack_lsp 2>/dev/null | grep -v "^system:" || fail "something plays before anybody has said where"
[ "$kind" != pad ] || ! sounds || fail "a controller shakes before anybody has said so"
quiet=$([ "$kind" != board ] || wc -l <"$folder/sound.csv")
pressed=$(now) took=$(later "$began")
for _ in $(seq 50); do # no window manager gives it the keys
    xdotool windowfocus "$window" 2>/dev/null || true
    [ "$(xdotool getwindowfocus 2>/dev/null)" != "$window" ] || break
    sleep 0.1
done
xdotool mousemove 720 300 key Return
if [ "$kind" = none ]; then # nobody feels anything: the world is seen, and the card has gone
    sleep 3
    kill "$mixer"
    wait "$mixer" || true
    played=$(sed -n 's/.*: \([0-9]*\) collisions rendered.*/\1/p' "$folder/mixer.log")
    [ "${played:-0}" -gt 0 ] || fail "no collision was played"
    echo "pressed once, $took s after the start; $played collisions were played on no device"
    exit 0
fi
until sounds; do
    kill -0 "$mixer" 2>/dev/null || fail "the mixer has ended"
    [ "$(awk -v a="$pressed" -v b="$(now)" 'BEGIN { print (b - a > 90) }')" = 0 ] || fail "nothing plays after 90 s"
    sleep 0.02
done
echo "pressed once, $took s after the start; it plays $(later "$pressed") s after that"
[ "$kind" = jack ] || exit 0
ports=$(jack_lsp | grep "out_1$" | head -n 1)
"$bin/physvib-jack-recorder" "$folder/felt.raw" 4 4 "${ports%1}" >"$folder/recorder.log" 2>&1 &
recorder=$!
while sleep 0.5 && kill -0 "$recorder" 2>/dev/null; do xdotool key space; done # the pulse again: the recorder connects late on a busy machine
wait "$recorder" || { cat "$folder/recorder.log"; exit 1; }
frame=$(od -An -v -t f4 -w16 "$folder/felt.raw" | awk '{ for (k = 1; k <= 4; ++k) if ($k > 0.001 || $k < -0.001) { print NR; exit } }')
[ -n "$frame" ] || { echo "silence on all ports"; exit 1; }
echo "the first sample above silence stands at frame $frame of the recording"
