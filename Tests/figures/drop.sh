#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the tables of Docs/drop.md: the hits of the scene "drop" beside free fall, restitution and Eq. 5.4/5.7. Other sizes and heights: DropTest.
# Usage: drop.sh PHYSVIB
set -eu
physvib=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# hits PAIR SIZE HEIGHT RATE: the rows of the first fall.
hits() {
    "$physvib" render drop --set pair="$1" --set size="$2" --set height="$3" --steps-per-second "$4" --seed 0 \
        --seconds "$(($3 + 1)).2" --events "$folder/hits.csv" >"$folder/report"
    grep -v '^[#t]' "$folder/hits.csv"
}

# by_hand PAIR SIZE HEIGHT RATE: Table 5.1 and school physics against the rows on stdin, as a row.
by_hand() {
    awk -F, -v pair="$1" -v size="$2" -v h="$3" -v rate="$4" '
        BEGIN {
            g = 9.8; width = 8; gain = 4.1; pi = 3.14159265358979
            scale = size == "small" ? 1 : size == "medium" ? 2 : 3
            circle = pi * 0.15 * 0.15 * scale * scale; can = 0.157 * 0.3 * scale * scale
            if (pair == "rubber-concrete") { m = 120 * circle; e = 0.688; plate = 870 }
            if (pair == "wood-wood") { m = 850 * circle; e = 0.603; plate = 739.5 }
            if (pair == "steel-steel") { m = 1193 * can; e = 0.597; plate = 6803.4 }
            v = sqrt(2 * g * h); t = v / g
        }
        v > 1 {
            j = m * v * (1 + e); a = gain / (2 * width) * j / (plate + plate)
            late = 1000 * ($1 - t); more = 100 * ($10 / j - 1); louder = 100 * ($4 / a - 1)
            if (NR == 1) first = sprintf("%.1f | %.1f | %.2f | %.2f", 1000 * t, 1000 * $1, j, $10)
            if (abs(late) > abs(latest)) latest = late
            if (abs(more) > abs(most)) most = more
            if (abs(more - louder) > 1e-9 * 100) { print "amplitude is not that of its impulse" > "/dev/stderr"; exit 1 }
            ++count; v *= e; t += 2 * v / g
        }
        END {
            if (v > 1) { print "a bounce is missing" > "/dev/stderr"; exit 1 }
            printf "| %s | %d | %s | %d | %+.1f | %+.1f |\n", pair, rate, first, count, latest, most
        }
        function abs(x) { return x < 0 ? -x : x }'
}

echo '| pair | steps/s | first ms | measured | N s | measured | bounces | worst ms | worst % |'
echo '| --- | --- | --- | --- | --- | --- | --- | --- | --- |'
for pair in rubber-concrete wood-wood steel-steel; do
    for rate in 100 1000; do
        hits $pair medium 2 $rate | by_hand $pair medium 2 $rate
    done
done
