#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# headphones.sh [BIN_FOLDER] [TIMES]: the mixer on headphones, on a display and a JACK server of its own: both ears play, also with a
# third actuator; and it lives on when the server ends, so many times (3), also where the settings of an older version name ALSA's
# way to JACK. Needs the packages xvfb, xauth, xdotool, openbox and jackd2; with libasound2-plugins ALSA has that way.
set -eu
bin=$(cd "${1:-$(dirname "$0")/../../build/release/bin}" && pwd) times=${2:-3}
here=$(cd "$(dirname "$0")" && pwd)
for program in xvfb-run xdotool openbox jackd; do command -v $program >/dev/null || { echo "skipped: needs $program"; exit 77; }; done
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$bin" "$times"
fi
display=$DISPLAY
. "$here/../Live/jack.sh"
export XDG_CONFIG_HOME="$folder/config" DISPLAY="$display"
settings=$XDG_CONFIG_HOME/physvib/mixer.settings
openbox >/dev/null 2>&1 &
manager=$!
playing=$manager
fail() { echo "$*"; cat "$folder/mixer.log"; exit 1; }
mixer() {
    "$bin/physvib-mixer" >"$folder/mixer.log" 2>&1 &
    mixer=$!
    playing="$mixer $manager"
    until window=$(xdotool search --name "PhysVib mixer" 2>/dev/null); do sleep 0.1; done
    sleep 3
    xdotool windowfocus "$window"
}
ears() { # LABEL: both play for some seconds
    until ports=$(jack_lsp 2>/dev/null | grep "out_1$"); do kill -0 "$mixer" || fail "$1: the mixer has ended"; sleep 0.1; done
    "$bin/physvib-jack-recorder" "$folder/felt.raw" 2 6 "${ports%1}" >"$folder/recorder.log" 2>&1 || { cat "$folder/recorder.log"; exit 1; }
    od -An -v -t f4 -w8 "$folder/felt.raw" | awk -v label="$1" '{ for (k = 1; k <= 2; ++k) { x = $k < 0 ? -$k : $k; if (x > peak[k]) peak[k] = x } }
        END { printf "%s: left %.4f, right %.4f\n", label, peak[1], peak[2]; exit !(peak[1] > 0.001 && peak[2] > 0.001) }' || fail "$1: an ear is silent"
}
output() { sed -n "s/.*name=\"$1\" val=\"\([^\"]*\)\".*/\1/p" "$settings"; }

again() { # LABEL: within 20 s it is connected to both ears of a new server
    for _ in $(seq 200); do
        kill -0 "$mixer" 2>/dev/null || fail "$1: the mixer has ended"
        [ "$(jack_lsp -c 2>/dev/null | grep -c "^ .*:out_[12]$")" = 2 ] && return
        sleep 0.1
    done
    fail "$1: it does not play again"
}
ends() { # LABEL: the server, so many times
    for k in $(seq "$times"); do
        close_server
        sleep 3
        serve 48000 512 8
        again "$1, end $k of the server"
    done
    echo "$1: the mixer lives and plays after $times ends of the server"
}

serve 48000 512 8
mixer
xdotool key Down Return # the second choice
ears "A and B on headphones"
[ "$(output headphones)" = 1 ] || fail "the settings have no headphones"
ends "headphones"
kill "$mixer"
wait "$mixer" || true
printf '<?xml version="1.0" encoding="UTF-8"?>\n<PROPERTIES>' >"$settings"
for pair in device="ALSA:JACK Audio Connection Kit" device-chosen=1 outputs=2 monitor-left=1 monitor-right=2 monitor-db=-20; do
    printf '<VALUE name="%s" val="%s"/>' "${pair%%=*}" "${pair#*=}" >>"$settings"
done
echo "</PROPERTIES>" >>"$settings"
mixer
ears "settings of an older version"
ends "settings of an older version"
