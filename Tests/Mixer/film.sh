#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# film.sh [BUILD] [FOLDER] [SECONDS]: draws a world in the real window, tilts and shakes it as a phone does, records what is felt, in SECONDS (120; 590
# at most), saves all of it as a movie and shares it; FOLDER keeps movie, take, session, link and pictures. The movie must show every moment and
# have a stereo sound whose loudest hit is within a picture of an impact. A script, since it needs a display, the port 9000 and the time.
set -eu
build=${1:-build/release} out=${2:-$(mktemp -d)} seconds=${3:-120}
here=$(cd "$(dirname "$0")" && pwd)
if [ "${DISPLAY_OF_ITS_OWN:-}" != yes ]; then
    DISPLAY_OF_ITS_OWN=yes exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$build" "$out" "$seconds"
fi
. "$here/hand.sh"
wall() { printf ', {"name": "%s", "type": "static", "position_m": [%s], "fixtures": [{"shape": "box", "size_m": [%s], "material": "wood"}]}' "$@"; }
scene box "$(wall ceiling 3,3.1 6.4,0.2; wall left -0.1,1.5 0.2,3.4; wall right 6.1,1.5 0.2,3.4)"
mkdir -p config/physvib # messages of this computer are taken
printf '<?xml version="1.0" encoding="UTF-8"?>\n\n<PROPERTIES>\n  <VALUE name="osc" val="this-computer"/>\n</PROPERTIES>\n' >config/physvib/mixer.settings
began=$(date +%s)
start_mixer box.json
draw_things
key b; drag 1.2 1.0 1.4 1.0; drag 1.8 0.4 2.0 0.4; drag 3.8 2.4 3.95 2.4 # three more balls
key h; key ctrl+r
key space
python3 - "$((seconds - 4 - $(date +%s) + began))" <<'PY'
import math, socket, struct, sys, time
def word(text):
    return text.encode() + b"\0" * (4 - len(text) % 4)
phone, begin = socket.socket(socket.AF_INET, socket.SOCK_DGRAM), time.time()
while (t := time.time() - begin) < float(sys.argv[1]): # rocked by a third of a turn, and shaken every ten seconds
    angle, shake = 1.1 * math.sin(0.7 * t), 25 * math.sin(30 * t) if t % 10 > 9 else 0
    numbers = struct.pack(">fff", 9.81 * math.sin(angle) + shake, 9.81 * math.cos(angle), 0)
    phone.sendto(word("/accelerometer") + word(",fff") + numbers, ("127.0.0.1", 9000))
    time.sleep(1 / 60)
PY
picture 3-tilted
key ctrl+r
key space
key ctrl+s; sleep 1; key Return; sleep 1 # under the name and in the folder that are suggested
menu 1 Up 4                       # Save movie
picture 4-movie
xdotool type 600                  # all of it: the field has the keys, and its text is selected
key Return; sleep 1
picture 5-file
made=$(date +%s)
key Return; sleep 2
picture 6-made
share                             # meanwhile
while ls Documents/PhysVib/*.part >/dev/null 2>&1; do sleep 1; done
made=$(($(date +%s) - made))
sleep 1
picture 7-saved
end_mixer
cp Documents/PhysVib/* "$out"
cd "$out"
[ -s session-movie.mp4 ] || { echo "there is no movie; see $out" >&2; exit 1; }
long=$(ffprobe -v error -show_entries format=duration -of csv=p=0 session-movie.mp4)
"$bin/physvib" render session.json --events hits.csv --seconds "$long" >/dev/null
for at in 10 50 90; do
    ffmpeg -v error -y -ss "$(awk "BEGIN { print $long * $at / 100 }")" -i session-movie.mp4 -frames:v 1 "frame-$at.png"
done
python3 - "$made" <<'PY'
import array, csv, json, os, subprocess, sys
def run(*words):
    return subprocess.run(words, capture_output=True, check=True).stdout
movie = "session-movie.mp4"
video, sound = json.loads(run("ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", movie))["streams"]
samples = array.array("f", run("ffmpeg", "-v", "error", "-i", movie, "-ar", "1000", "-f", "f32le", "-"))
level = [max(abs(v) for v in samples[k:k + 10]) for k in range(0, len(samples) - 10, 10)] # of both ears, every 5 ms
rise = [level[k] - max(level[max(0, k - 6):k], default=0) for k in range(len(level))]
loudest = 0.005 * rise.index(max(rise))
hits = [float(row["time_s"]) for row in csv.DictReader(line for line in open("hits.csv") if not line.startswith("#"))]
off = min(abs(hit - loudest) for hit in hits)
seconds = float(video["duration"])
print(f"{movie}: {seconds:.2f} s, {video['nb_read_frames']} pictures of {video['width']} x {video['height']}, {os.path.getsize(movie)} bytes, made in {sys.argv[1]} s")
print(f"sound: {sound['channels']} channels, {float(sound['duration']):.2f} s, at most {max(level):.4f}; its loudest hit at {loudest:.3f} s, {1e3 * off:.0f} ms from one of {len(hits)}")
print(f"link: {os.path.getsize('link')} letters")
isWhole = abs(int(video["nb_read_frames"]) - 20 * seconds) <= 1 and abs(float(sound["duration"]) - seconds) < 0.05
sys.exit(0 if isWhole and sound["channels"] == 2 and max(level) > 0.001 and off <= 0.05 else 1)
PY
echo "all of it in $out"
