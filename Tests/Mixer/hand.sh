# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by draw-a-world.sh and film.sh: a hand at the real window, in a home of its own; needs $build, $out and $here. The places are
# those of a field of 6 m by 3 m in a window of 1440 x 900, to play.
for program in xvfb-run xdotool ffmpeg; do command -v $program >/dev/null || { echo "needs the packages xvfb, xauth, xdotool and ffmpeg" >&2; exit 1; }; done
mkdir -p "$out"
out=$(realpath "$out") bin=$here/../../$build/bin
home=$(mktemp -d)
pid=""
trap 'test -z "$pid" || kill -9 "$pid" 2>/dev/null || :; rm -rf "$home"' EXIT
export XDG_CONFIG_HOME="$home/config" HOME="$home"
cd "$home"

scene() { # NAME [BODIES]: a floor, and these
    cat >"$1.json" <<JSON
{"physvib_scene": 1, "name": "$1", "field_m": [6, 3], "gravity_m_per_s2": [0, -9.8], "drive_gain": 40,
 "materials": [{"name": "wood", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 80, "decay_per_s": 30},
               {"name": "steel", "density_kg_per_m2": 7800, "friction": 0.3, "restitution": 0.5, "frequency_hz": 250, "decay_per_s": 12},
               {"name": "rubber", "density_kg_per_m2": 120, "friction": 0.8, "restitution": 0.7, "frequency_hz": 45, "decay_per_s": 60}],
 "bodies": [{"name": "floor", "type": "static", "position_m": [3, -0.1], "fixtures": [{"shape": "box", "size_m": [6.4, 0.2], "material": "wood"}]}${2:-}]}
JSON
}
start_mixer() { # FILE...
    mkdir -p programs             # the browser that the mixer opens keeps the link
    printf '#!/bin/sh\nprintf %%s "$1" >"%s/link"\n' "$home" >programs/xdg-open
    chmod +x programs/xdg-open
    PATH="$home/programs:$PATH" "$bin/physvib-mixer" "$@" --device "None:no device" &
    pid=$!
    until xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.1; done
    sleep 2
}
end_mixer() {
    xdotool key ctrl+q sleep 0.5 key Tab key Return sleep 0.5 || :
    kill "$pid" 2>/dev/null || :
    wait "$pid" 2>/dev/null || :
    pid=""
}

x() { awk "BEGIN { print int(71 + 220 * ($1)) }"; }
y() { awk "BEGIN { print int(793.6 - 220 * ($1)) }"; }
drag() { # X Y X Y in metres, in steps as of a hand
    xdotool mousemove "$(x "$1")" "$(y "$2")" sleep 0.1 mousedown 1 sleep 0.1
    for k in 1 2 3 4 5 6 7 8; do
        xdotool mousemove "$(x "$1 + ($3 - $1) * $k / 8")" "$(y "$2 + ($4 - $2) * $k / 8")" sleep 0.03
    done
    xdotool sleep 0.1 mouseup 1 sleep 0.2
}
click() { xdotool mousemove "$(x "$1")" "$(y "$2")" sleep 0.1 click 1 sleep 0.3; }
key() { xdotool key "$1" sleep 0.3; }
picture() { ffmpeg -loglevel error -y -f x11grab -video_size 1440x900 -i "$DISPLAY" -frames:v 1 "$out/$1.png"; }
menu() { # NUMBER Down|Up COUNT: of that menu the item that so many presses choose, from its first
    xdotool mousemove 1100 500    # not over the menu
    key F10
    for k in $(seq "$1"); do xdotool key Down sleep 0.1; done
    key Right
    for k in $(seq "$3"); do xdotool key "$2" sleep 0.1; done
    key Return
    sleep 1
}
share() {
    menu 1 Up 3
    picture share
    for k in 1 2 3; do xdotool key Tab sleep 0.1; done # from Address to Link, Cancel, Open it
    key Return
    sleep 1
    [ -s link ] || { echo "no link was opened; see $out" >&2; exit 1; }
    cp link "$out"
}
draw_things() {
    click 5.9 2.9                 # the window has the keys, and the hint goes
    key space                     # the world stands still
    key w; drag 0.2 2.2 2.2 1.3   # a slope
    key b; drag 0.6 2.6 0.78 2.6  # a ball above it
    key x; drag 2.5 0.55 4.5 0.67 # a plank
    key i; click 3.5 0.61         # pinned to the field: a see-saw
    key p; click 4.9 1.2; click 5.5 1.2; click 5.2 1.75; key Return # a bell
    key r; drag 5.2 1.6 5.2 2.7   # on a rope from the field
    picture 1-drawn
    key s; click 5.2 1.4          # the bell is chosen
    xdotool mousemove 155 97 click 1 sleep 0.5 # and becomes steel: the second material of the palette
    picture 2-steel
    key h
}
