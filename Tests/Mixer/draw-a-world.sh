#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# draw-a-world.sh [BUILD] [FOLDER] [PAGE]: a person's act in the real window, by pointer and keys: draws a slope, a ball,
# a pinned see-saw and a bell on a rope, changes materials, plays with it while hands are recorded as the script, and saves
# the scene, and shares it; pictures of it go to FOLDER. Then the hits that the mixer played must be those that physvib renders of the scene
# file, to the bit. With PAGE, the folder of the built page, Chromium opens the scene there, shares it and opens the link, and
# that of the mixer: the same samples. A script, since it needs a display and ten seconds of sound.
set -eu
build=${1:-build/release} out=${2:-$(mktemp -d)} page=${3:+$(realpath "$3")}
here=$(cd "$(dirname "$0")" && pwd)
for program in xvfb-run xdotool ffmpeg; do command -v $program >/dev/null || { echo "needs the packages xvfb, xauth, xdotool and ffmpeg" >&2; exit 1; }; done
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$build" "$out" "$page"
fi
mkdir -p "$out"
home=$(mktemp -d)
pid=""
trap 'test -z "$pid" || kill -9 "$pid" 2>/dev/null || :; rm -rf "$home"' EXIT
export XDG_CONFIG_HOME="$home/config" HOME="$home"
cat >"$home/floor.json" <<'JSON'
{"physvib_scene": 1, "name": "floor", "field_m": [6, 3], "gravity_m_per_s2": [0, -9.8], "drive_gain": 40,
 "materials": [{"name": "wood", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 80, "decay_per_s": 30},
               {"name": "steel", "density_kg_per_m2": 7800, "friction": 0.3, "restitution": 0.5, "frequency_hz": 250, "decay_per_s": 12},
               {"name": "rubber", "density_kg_per_m2": 120, "friction": 0.8, "restitution": 0.7, "frequency_hz": 45, "decay_per_s": 60}],
 "bodies": [{"name": "floor", "type": "static", "position_m": [3, -0.1], "fixtures": [{"shape": "box", "size_m": [6.4, 0.2], "material": "wood"}]}]}
JSON
cd "$home"
mkdir programs                    # the browser that the mixer opens keeps the link
printf '#!/bin/sh\nprintf %%s "$1" >"%s/link"\n' "$home" >programs/xdg-open
chmod +x programs/xdg-open
PATH="$home/programs:$PATH" "$here/../../$build/bin/physvib-mixer" floor.json --device "None:no device" &
pid=$!
until xdotool search --name "PhysVib mixer" >/dev/null 2>&1; do sleep 0.1; done
sleep 2

# Places of the field of 6 m by 3 m in a window of 1440 x 900.
x() { awk "BEGIN { print int(53.0 + 128.33 * ($1)) }"; }
y() { awk "BEGIN { print int(494.5 - 128.33 * ($1)) }"; }
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

click 5.9 2.9                     # the window has the keys, and the hint goes
key space                         # the world stands still
key w; drag 0.2 2.2 2.2 1.3       # a slope
key b; drag 0.6 2.6 0.78 2.6      # a ball above it
key x; drag 2.5 0.55 4.5 0.67     # a plank
key i; click 3.5 0.61             # pinned to the field: a see-saw
key p; click 4.9 1.2; click 5.5 1.2; click 5.2 1.75; key Return # a bell
key r; drag 5.2 1.6 5.2 2.7       # on a rope from the field
picture 1-drawn
key s; click 5.2 1.4              # the bell is chosen
xdotool mousemove 152 85 click 1 sleep 0.5 # and becomes steel: the second material of the palette
picture 2-steel
key h
key ctrl+r; sleep 0.5             # what is played is recorded, and
key ctrl+shift+r; sleep 1         # hands are, as the script: the world begins anew
drag 5.2 1.4 4.5 1.4              # rings the bell
picture 3-recorded
key Left; key Left; sleep 0.7; key Right; key Right; sleep 0.5; key Down; sleep 1
key ctrl+shift+r; sleep 0.5
picture 4-script
key ctrl+r; sleep 1
xdotool mousemove 1100 500        # not over the menu
key F10; sleep 0.3
picture 5-menu
for k in 1 2 3 4 5 6 7 8; do xdotool key Down sleep 0.1; done # New, Open, Save, Save as, Undo, New scene, Scene, Save as scene
key Return; sleep 1
picture 6-save
key Return; sleep 1               # under the name and in the folder that are suggested
picture 7-saved
cp config/physvib/scenes/scene.json own.json || { echo "the scene was not saved; see $out" >&2; exit 1; }
xdotool mousemove 1100 500
key F10; sleep 0.3
for k in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do xdotool key Down sleep 0.1; done # to Share
key Return; sleep 1
picture 8-share
xdotool mousemove 583 591 click 1 sleep 1 # Open it
[ -s link ] || { echo "no link was opened; see $out" >&2; exit 1; }
xdotool key ctrl+q sleep 0.5 key Tab key Return sleep 0.5 || :
kill "$pid" 2>/dev/null || :
wait "$pid" 2>/dev/null || :
pid=""
python3 - "$here/../../$build/bin/physvib" <<'PY'
import csv, json, subprocess, sys
scene = json.load(open("own.json"))
script = [i for i in scene["script"]]
end = max(i["time_s"] for i in script)
subprocess.run([sys.argv[1], "render", "own.json", "--out", "own.wav", "--events", "own.csv", "--seconds", f"{end:.2f}"], check=True)
def rows(path):
    lines = [l for l in open(path) if not l.startswith("#")]
    return [(float(r.pop("time_s")), tuple(sorted(r.items()))) for r in csv.DictReader(lines)]
live, rendered = rows("Documents/PhysVib/session-take.csv"), rows("own.csv")
same = [a[1] == b[1] for a, b in zip(live, rendered)]
shifts = [a[0] - b[0] for a, b in zip(live, rendered)]
print(f"bodies {', '.join(b['name'] for b in scene['bodies'])}; joints {len(scene.get('joints', []))}; script of {len(script)} inputs, {end:.2f} s")
print(f"hits: {len(rendered)} rendered, {sum(same)} of them those that were played, to the bit")
print(f"time between a hit of the recording and of the render: {min(shifts):.9f} to {max(shifts):.9f} s (it grows where the world waited)")
sys.exit(0 if rendered and len(live) >= len(rendered) and all(same) else 1)
PY
cp own.json "$out/drawn.json"
cp link "$out/link"
[ -z "$page" ] || python3 "$here/opened-in-the-page.py" own.json "$page" "$here/../../$build/bin/physvib" "$out" 5 "$(cat link)"
echo "pictures in $out"
