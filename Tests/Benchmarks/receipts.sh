#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# receipts.sh BIN_FOLDER [MOST]: what share of a block of `physvib play` its receipts take, in instructions that callgrind counts (its processor has AVX2 at best), with blocks
# of 512 frames, which are usual, and of 64; fails above MOST per cent (1) of a block of 512. Needs valgrind.
set -eu
bin=$(cd "$1" && pwd)
most=${2:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed=0
echo "| scene | frames | instructions a block | receipts | share |"
echo "| --- | --- | --- | --- | --- |"
for frames in 512 64; do
    for scene in shake-the-box drop; do
        valgrind --tool=callgrind --callgrind-out-file=out --toggle-collect='physvib::AudioOutput::block*' "$bin/physvib" play $scene --device "None:no device" \
            --seconds 4 --block $frames >said 2>&1 || { cat said; exit 1; }
        callgrind_annotate --inclusive=yes --threshold=100 out >counts
        awk -v row="| $scene | $frames |" -v blocks=$((4 * 48000 / frames)) -v most="$most" -v frames=$frames '
            /PROGRAM TOTALS/ { gsub(",", "", $1); all = $1 }
            /:physvib::Receipts::take/ { gsub(",", "", $1); taken += $1 }
            END { share = 100 * taken / all; printf "%s %d | %d | %.2f %% |\n", row, all / blocks, taken / blocks, share; exit taken == 0 || (frames == 512 && share > most) }' counts || failed=1
    done
done
exit $failed
