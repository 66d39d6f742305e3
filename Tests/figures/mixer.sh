#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the pictures of Docs/mixer.md, without a display.
# Usage: mixer.sh MIXER [FOLDER]
set -eu
mixer=$1
folder=${2:-Docs}
for state in $("$mixer" --states); do "$mixer" --shot "$folder/mixer-$state.png" --state "$state"; done
