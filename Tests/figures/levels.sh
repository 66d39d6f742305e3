#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the table of Docs/studies-thesis.md: peak and root mean square of the model in the conditions of model-or-sound with falls of 1 m, at the highest level
# that its sessions can set, in g of one actuator of 2 g.
# Usage: levels.sh PHYSVIB
set -eu
"$1" study check model-or-sound | awk -F '\t' '
    NR == 1 { print "| pair | size | peak, g | root mean square, g | below full scale, dB | above threshold, dB |"; print "| --- | --- | --- | --- | --- | --- |"; next }
    NF < 9 { exit }
    $4 == -38 || $2 !~ /height=1/ || $3 == "SV" { next } # the lowest level; higher falls; recordings
    { split($2, of, " "); for (i in of) sub(/.*=/, "", of[i]); printf "| %s | %s | %s | %s | %s | %s |\n", of[1], of[2], $5, $6, $7, $8 }'
