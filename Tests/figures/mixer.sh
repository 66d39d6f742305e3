#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the pictures of Docs/mixer.md and of the studies in the mixer, without a display.
# Usage: mixer.sh SHOTS [FOLDER]; SHOTS is physvib-mixer-shots, a program of the tests
set -eu
shots=$1
folder=${2:-Docs}
for state in $("$shots" --states); do
    case $state in sheet-* | first-test) continue ;; studies-*) name=$state ;; *) name=mixer-$state ;; esac
    "$shots" "$folder/$name.png" "$state"
done
