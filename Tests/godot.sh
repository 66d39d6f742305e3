#!/bin/sh
# SPDX-License-Identifier: MIT
# The addon in Godot itself, headless: a bouncing ball in three engines at four tick rates, the ten acts of
# Tests/Engines, what games do to a world, what each tick costs, the demos, one of them exported, and the editor.
# Debian 12 has no Godot 4: a tree of Debian's unstable is made in FOLDER, or used if it is there (1.9 GB). Needs root,
# debootstrap and a network, and builds what it plays and records with in BUILD. Pictures of the editor and the demos, to be looked at, are
# left in FOLDER/editor and FOLDER/physvib/pictures.
# Usage: Tests/godot.sh BUILD FOLDER
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
tree=$(cd "$2" && pwd)
# shellcheck source=Tests/Godot/tree.sh
. "$root/Tests/Godot/tree.sh"
make_tree
# drawn FOLDER WORD...: Godot with a window, which no screen shows.
drawn() {
    folder=$1
    shift
    within "$folder" xvfb-run -a -s "-screen 0 1500x900x24" godot --rendering-driver opengl3 --audio-driver Dummy "$@"
}

fill_project physvib physvib-jack-recorder physvib-compare-recording
godot --import --frame-delay 1000 >>"$project/log" 2>&1 # without a delay Godot crashes (godot 111048)
rm -rf "$tree/editor"
mkdir -p "$tree/editor"
cp -r "$project/addons" "$project/libraries" "$root"/Tests/Godot/Editor/. "$tree/editor"
rm -r "$tree/editor/addons/physvib/demos"

failed=0
godot -s pace.gd 2>/dev/null | grep ticks || failed=1 # what no latency can be below
echo "| engine | ticks/s | onset, ms | strength, % | hits | |"
echo "| --- | --- | --- | --- | --- | --- |"
for engine in GodotPhysics3D "Jolt Physics"; do
    cp "$root/Tests/Godot/project.godot" "$project"
    echo "3d/physics_engine=\"$engine\"" >>"$project/project.godot"
    godot -s floors.gd --fixed-fps 60 >"$project/out" 2>&1 || failed=1
    grep -E '^(right|WRONG)' "$project/out" || { cat "$project/out" && failed=1; }
    for rate in 60 240; do
        godot -s edges.gd --fixed-fps "$rate" -- "hz=$rate" >"$project/out" 2>&1 || failed=1
        grep -E '^(right|WRONG)' "$project/out" || { cat "$project/out" && failed=1; }
    done
    for space in 2 3; do
        [ "$engine$space" != "Jolt Physics2" ] || continue # the plane has one engine
        for shape in ball box; do
            for rate in 30 60 120 240; do
                godot -s bounce.gd --fixed-fps "$rate" -- "space=$space" "hz=$rate" "$shape" >"$project/out" 2>&1 || failed=1
                sed -n "s/^| /| $shape, /p" "$project/out" | grep . || { cat "$project/out" && failed=1; }
            done
        done
        for rate in 60 240; do
            for act in "character.gd" "textures.gd rolls" "textures.gd slides"; do
                # shellcheck disable=SC2086 # a script and its word
                set -- $act
                godot -s "$1" --fixed-fps "$rate" -- "space=$space" "hz=$rate" ${2:-} >"$project/out" 2>&1 || failed=1
                grep -E '^(right|WRONG)' "$project/out" || { cat "$project/out" && failed=1; }
            done
        done
        for rate in 30 60 240; do
            godot -s kicks.gd --fixed-fps "$rate" -- "space=$space" "hz=$rate" >"$project/out" 2>&1 || failed=1
            grep -E '^(right|WRONG)' "$project/out" || { cat "$project/out" && failed=1; }
            ! grep '^ERROR' "$project/out" || failed=1
        done
        for rate in 30 240; do
            for striker in alone observed; do
                godot -s pair.gd --fixed-fps "$rate" -- "space=$space" "hz=$rate" "$striker" >"$project/out" 2>&1 || failed=1
                grep "pair in" "$project/out" || { cat "$project/out" && failed=1; }
            done
        done
    done
done
for script in outputs life nodes games hands; do
    godot -s $script.gd --fixed-fps 60 >"$project/out" 2>&1 || failed=1
    grep -E '^(right|WRONG|[0-9]+ wrong)' "$project/out" || failed=1
    grep -q '^0 wrong' "$project/out" || failed=1
done
godot -s sound.gd >"$project/out" 2>&1 || failed=1 # in real time
grep -E '^(right|WRONG|[0-9]+ wrong)' "$project/out" || failed=1
godot -s orders.gd --fixed-fps 60 -- changes=2000 >"$project/out" 2>&1 || failed=1
grep -E '^[0-9]+ (orders|scenes)' "$project/out" || failed=1
godot -s motors.gd --fixed-fps 60 >"$project/out" 2>&1 || failed=1
PYTHONPATH=$root/Source/Api/Python PYTHONDONTWRITEBYTECODE=1 PHYSVIB_LIBRARY=$build/godot/addons/physvib/bin/linux.x86_64/libphysvib.so.1 /usr/bin/python3 "$root/Tests/Godot/motors.py" "$project/out" || failed=1
# A JACK server of the tree, a recorder of its outputs, and the session that the world has written, rendered here.
cp "$build/bin/physvib-jack-recorder" "$root/Tests/Godot/played.sh" "$project"
# shellcheck disable=SC2016 # for the inner shell
unshare -m sh -c 'mount -t tmpfs none "$0/dev/shm" && mount -t proc proc "$0/proc" && exec chroot "$0" sh /physvib/played.sh' "$tree" >"$project/out" 2>&1 || { cat "$project/out" && failed=1; }
# The game ends after five seconds, and fades out what still rings.
"$build/bin/physvib" render "$project/played.json" --seconds 4.5 --out "$project/played.wav" >"$project/log"
tail -c +"$(($(grep -abo data "$project/played.wav" | head -n 1 | cut -d: -f1) + 9))" "$project/played.wav" >"$project/expected.raw"
"$build/bin/physvib-compare-recording" "$project/live.raw" "$project/expected.raw" 4 256 "$(sed -n 's/xruns //p' "$project/ready")" || failed=1
# left() is what left: the peaks of the recording, and nothing without an output.
python3 - "$project/live.raw" "$project/out" <<'END' || failed=1
import array, sys
samples, said = array.array("f", open(sys.argv[1], "rb").read()), open(sys.argv[2]).read()
peaks = [max(map(abs, samples[j::4])) for j in range(4)]
told = [float(word) for word in said.split("\nleft ")[1].split("\n")[0].split()]
isRight = "\nwithout an output {" in said and "without an output { 0" not in said and max(peaks) > 0.01 and all(abs(a - b) < 2e-6 for a, b in zip(peaks, told))
print("right" if isRight else "WRONG", "left() told", told, "of the recorded", [round(peak, 6) for peak in peaks])
sys.exit(not isRight)
END
for demo in "$project"/addons/physvib/demos/*.tscn; do
    name=${demo##*/}
    godot -s "demos.gd" --fixed-fps 60 -- "demo=res://addons/physvib/demos/$name" >"$project/out" 2>&1 || failed=1
    grep "^$name: [1-9][0-9]* hits" "$project/out" || { cat "$project/out" && failed=1; }
    ! grep -q "SCRIPT ERROR" "$project/out" || { cat "$project/out" && failed=1; }
    drawn physvib -s pictures.gd --fixed-fps 60 -- "demo=res://addons/physvib/demos/$name" ticks=200 >"$project/out" 2>&1 || failed=1
    grep "^picture of" "$project/out" || { cat "$project/out" && failed=1; }
done

# A release of the shaken box, elsewhere.
cp "$root/Tests/Godot/project.godot" "$project"
rm -rf "$tree/released"
mkdir "$tree/released" "$project/released"
godot --export-release Linux released/box.x86_64 >"$project/out" 2>&1 || { cat "$project/out" && failed=1; }
cp -r "$project"/released/* "$project/libraries" "$tree/released"
within released ./box.x86_64 --headless --fixed-fps 60 --quit-after 300 >"$project/out" 2>&1 || failed=1
echo "a release of shaken_box.tscn: $(grep -c ' N s at ' "$project/out") hits in 5 s"
grep -q ' N s at ' "$project/out" || { cat "$project/out" && failed=1; }

echo "ms per tick without / with the addon, of boxes on a floor:"
echo "| engine | 10 | 100 | 1,000 |"
echo "| --- | --- | --- | --- |"
godot -s cost.gd --fixed-fps 60 -- space=2 2>&1 | grep '^|' || failed=1
for engine in GodotPhysics3D "Jolt Physics"; do
    cp "$root/Tests/Godot/project.godot" "$project"
    echo "3d/physics_engine=\"$engine\"" >>"$project/project.godot"
    godot -s cost.gd --fixed-fps 60 -- space=3 2>&1 | grep '^|' || failed=1
done
cp "$root/Tests/Godot/project.godot" "$project"
run=$tree/run.sh
# shellcheck disable=SC2016 # for the script
printf '#!/bin/sh\nexec unshare -m sh -c '\''mount -t proc proc "$0/proc" && exec chroot "$0" env HOME=/physvib LD_LIBRARY_PATH=/physvib/libraries sh -c "cd /physvib && exec timeout 300 godot --headless \"\$@\"" sh "$@"'\'' "%s" "$@"\n' "$tree" >"$run"
python3 "$root/Tests/Godot/acts.py" "$project" sh "$run" || failed=1

import() { within editor godot --headless --import --frame-delay 1000 >"$tree/editor/log" 2>&1; }
import || import || failed=1 # a slow one crashes nevertheless, as it leaves
look() { drawn editor --editor --path /editor --resolution 1500x900 >>"$tree/editor/log" 2>&1; }
look || look || failed=1
grep "^dragged: \[(60.0, 40.0)" "$tree/editor/log" || failed=1
# What the editor warns of: an unknown part and preset, two on a body, no world of its kind; nothing where all is well.
grep "^warned: .*/HapticBody\|^warned: .*/Second" "$tree/editor/log" | sort -u >"$project/out"
cat "$project/out"
[ "$(wc -l <"$project/out")" -eq 4 ] || failed=1
for words in 'Ball/.*part "tail".*found "wood"' "Twice/HapticBody.*another HapticBody" "Twice/Second.*another HapticBody" "Bone/.*without a HapticWorld3D"; do
    grep -q "$words" "$project/out" || { echo "WRONG: no warning: $words" && failed=1; }
done
exit $failed
