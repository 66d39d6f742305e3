#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# with-display.sh COMMAND...: runs it on a display of its own, in software, larger than the mixer's window; 77 (skipped) where there is no Xvfb.
set -eu
if ! command -v xvfb-run >/dev/null 2>&1; then
    echo "skipped: no display can be made here; install the packages xvfb and xauth"
    exit 77
fi
exec xvfb-run -a -s "-screen 0 1600x960x24" "$@"
