#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# recovery.sh [CRASHES] [SEED] [BIN_FOLDER]: kills the mixer (SIGKILL) so many times (200) at random moments, on a
# display of its own, while copies of sessions are offered, looked through, taken up and kept, some of them cut short,
# some on a full disk, some with two mixers at once. Fails if a session that was whole on the disk is in no copy
# afterwards; nobody declines any.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
bin=${3:-$here/../../build/release/bin}
command -v xdotool >/dev/null 2>&1 || { echo "skipped: no xdotool"; exit 77; }
exec "$here/../Mixer/Window/with-display.sh" \
    python3 "$here/recovery.py" "$bin/physvib-mixer" "${1:-200}" "${2:-1}"
