#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# with-display.sh COMMAND...: runs it on a display of its own, in software, of PHYSVIB_DISPLAY pixels (1440x900); 77 (skipped) where there is no Xvfb.
set -eu
if ! command -v xvfb-run >/dev/null 2>&1; then
    echo "skipped: no display can be made here; install the packages xvfb and xauth"
    exit 77
fi
exec xvfb-run -a -s "-screen 0 ${PHYSVIB_DISPLAY:-1440x900}x24" "$@"
