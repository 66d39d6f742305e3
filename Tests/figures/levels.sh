#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the table of Docs/studies-levels.md: peak and root mean square of each condition of model-or-sound, both alternatives at the highest level that its
# sessions can set, in g of one actuator of 2 g.
# Usage: levels.sh PHYSVIB
set -eu
"$1" study check model-or-sound | awk -F '\t' '
    NR == 1 { print "| pair | size | m | rendering | level, dB | peak, g | root mean square, g | below full scale, dB | above threshold, dB |"; print "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"; next }
    NF < 9 { exit }
    $4 == -38 { next } # the lowest
    { split($2, of, " "); for (i in of) sub(/.*=/, "", of[i]); printf "| %s | %s | %s | `%s` | %s | %s | %s | %s | %s |\n", of[1], of[2], of[3], $3, $4, $5, $6, $7, $8 }'
