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
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$build" "$out" "$page"
fi
. "$here/hand.sh"
scene floor
start_mixer floor.json
draw_things
key ctrl+r; sleep 0.5             # what is played is recorded, and
key ctrl+shift+r; sleep 1         # hands are, as the script: the world begins anew
drag 5.2 1.4 4.5 1.4              # rings the bell
picture 3-recorded
key Left; key Left; sleep 0.7; key Right; key Right; sleep 0.5; key Down; sleep 1
key ctrl+shift+r; sleep 0.5
picture 4-script
key ctrl+r; sleep 1
menu 3 Down 2                     # World: New scene, Open a scene, Save as scene
picture 6-save
key Return; sleep 1               # under the name and in the folder that are suggested
picture 7-saved
cp config/physvib/scenes/scene.json own.json || { echo "the scene was not saved; see $out" >&2; exit 1; }
share
end_mixer
python3 - "$bin/physvib" <<'PY'
import csv, json, subprocess, sys
scene = json.load(open("own.json"))
drawn = [(b["name"], b["fixtures"][0]["material"]) for b in scene["bodies"]]
if drawn != [("floor", "wood"), ("wall 1", "wood"), ("ball 1", "wood"), ("box 1", "wood"), ("polygon 1", "steel")] or len(scene["joints"]) != 2:
    sys.exit(f"another world was drawn: {drawn}")
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
[ -z "$page" ] || python3 "$here/opened-in-the-page.py" own.json "$page" "$bin/physvib" "$out" 5 "$(cat link)"
echo "pictures in $out"
