#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How long after a message its strike is heard where a session is direct, through a JACK server without hardware; fails if one is not heard
# a block and the limiter after it came.
# Usage: direct.sh BIN_FOLDER [MESSAGES [BLOCK_FRAMES]]
set -eu
. "$(dirname "$0")/jack.sh"
serve 48000 "${3:-256}" 8
"$1/physvib-direct-meter" "${2:-30}"
