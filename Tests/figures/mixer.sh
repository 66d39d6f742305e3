#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the pictures of Docs/mixer.md and of the studies in the mixer, without a display.
# Usage: mixer.sh MIXER [FOLDER]
set -eu
mixer=$1
folder=${2:-Docs}
for state in $("$mixer" --states); do
    case $state in studies-*) name=$state ;; *) name=mixer-$state ;; esac
    "$mixer" --shot "$folder/$name.png" --state "$state"
done
