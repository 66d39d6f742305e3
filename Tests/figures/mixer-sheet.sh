#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the mixer's window at six sizes and two scales, dark and light, with 1, 4, 16 and 64 actuators and long names, into FOLDER, and one
# sheet of all of them to look at: FOLDER/sheet.png. Needs no display; the sheet needs the package python3-pil.
# Usage: mixer-sheet.sh SHOTS FOLDER; SHOTS is physvib-mixer-shots, a program of the tests
set -eu
shots=$1 folder=$2
mkdir -p "$folder"
for size in 1024x700 1280x720 1440x900 1920x1080 2560x1440 3840x2160; do
    for scale in 1 2; do
        [ "$size $scale" != "3840x2160 2" ] || continue # larger than any display
        for state in sheet-one four-enchanters light sheet-16 sheet-64 sheet-show sheet-rain; do
            "$shots" "$folder/$size-$scale-$state.png" "$state" "$size" "$scale"
        done
    done
done
python3 - "$folder" <<'EOF'
import pathlib, sys
from PIL import Image
folder = pathlib.Path(sys.argv[1])
pictures = sorted((p for p in folder.glob("*x*-*.png")), key=lambda p: (int(p.name.split("x")[0]), p.name))
width, height, columns = 480, 300, 7
sheet = Image.new("RGB", (columns * width, (len(pictures) + columns - 1) // columns * height))
for k, path in enumerate(pictures):
    picture = Image.open(path).convert("RGB")
    picture.thumbnail((width - 6, height - 6))
    sheet.paste(picture, (k % columns * width, k // columns * height))
sheet.save(folder / "sheet.png")
print(f"{len(pictures)} pictures in {folder}/sheet.png")
EOF
