#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# first-start.sh BIN_FOLDER: the mixer is started with a cold home folder beside a JACK server of eight outputs; one press of Return opens the
# likely device, and a port of it plays. Counts what is pressed, and prints how long that took from the start and from the press.
set -eu
bin=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || { echo "skipped: needs the packages xvfb, xauth and xdotool"; exit 77; }
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$bin"
fi
display=$DISPLAY
. "$here/jack.sh"
serve 48000 256 8
export XDG_CONFIG_HOME="$folder/config" DISPLAY="$display"
now() { date +%s.%N; }
began=$(now)
"$bin/physvib-mixer" >"$folder/mixer.log" 2>&1 &
playing=$!
until window=$(xdotool search --name "PhysVib mixer" 2>/dev/null); do sleep 0.05; done
sleep 3 # as long as a person reads
jack_lsp 2>/dev/null | grep -v "^system:" && { echo "something plays before anybody has said where"; exit 1; }
pressed=$(now)
xdotool windowfocus $window 2>/dev/null || true # no window manager gives it the keys
sleep 0.3
xdotool mousemove 720 300 key Return
until jack_lsp 2>/dev/null | grep -q "out_1$"; do
    kill -0 "$playing" || { cat "$folder/mixer.log"; exit 1; }
    [ "$(awk -v a="$pressed" -v b="$(now)" 'BEGIN { print (b - a > 30) }')" = 0 ] || { echo "no port of the mixer after 30 s"; jack_lsp; exit 1; }
    sleep 0.02
done
ports=$(jack_lsp | grep "out_1$" | head -n 1)
"$bin/physvib-jack-recorder" "$folder/felt.raw" 4 4 "${ports%1}" >"$folder/recorder.log" 2>&1 &
recorder=$!
sleep 0.5
xdotool key space # the pulse again, for the recorder
wait "$recorder" || { cat "$folder/recorder.log"; exit 1; }
frame=$(od -An -v -t f4 -w16 "$folder/felt.raw" | awk '{ for (k = 1; k <= 4; ++k) if ($k > 0.001 || $k < -0.001) { print NR; exit } }')
[ -n "$frame" ] || { echo "silence on all ports"; exit 1; }
awk -v a="$began" -v b="$pressed" -v c="$(now)" 'BEGIN { printf "pressed once, %.1f s after the start\n", b - a }'
echo "the first sample above silence stands at frame $frame of the recording"
