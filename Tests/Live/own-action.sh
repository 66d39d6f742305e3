#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How long after one's own push the hit is heard, with the thread driver and blocks of 64 frames, through a JACK server
# without hardware; fails if a hit is not heard exactly L after its contact.
# Usage: own-action.sh BIN_FOLDER [PUSHES]
set -eu
. "$(dirname "$0")/jack.sh"
serve 48000 64 8
"$1/physvib-own-action-meter" "${2:-50}"
