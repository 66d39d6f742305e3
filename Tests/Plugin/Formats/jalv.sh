#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The LV2 plug-in of eight channels in jalv, live on a JACK server of its own, with a transport that starts, notes, and a
# JACK client that records: passes if the recording is what a bounce of the same state and notes gives, to the bit, but for
# breaks that the server's xruns explain.
# Usage: jalv.sh BUILD_FOLDER [SECONDS] [BLOCK_FRAMES]; 77: jalv is not installed
set -eu
command -v jalv >/dev/null || { echo "skipped: jalv (Debian package jalv) is not installed"; exit 77; }
build=$1 seconds=${2:-10} block=${3:-512}
. "$(dirname "$0")/../../Live/jack.sh"
export LV2_PATH="$build/plugins"
serve 48000 "$block" 8
"$build/bin/physvib-plugin-bounce" 8 "$seconds" "$block" "$folder" >"$folder/bounce.raw"
"$build/bin/physvib-jack-recorder" "$folder/live.raw" 8 "$((seconds + 2))" physvib:audio_out_ >"$folder/ready" &
recording=$!
for _ in $(seq 100); do grep -q ready "$folder/ready" && break; sleep 0.1; done
mkfifo "$folder/commands"
jalv -x -n physvib -l "$folder/state.lv2" urn:physvib:plugin:8 <"$folder/commands" >"$folder/jalv.log" 2>&1 &
playing=$!
exec 3>"$folder/commands" # none, but it ends with its input
"$build/bin/physvib-jack-notes" physvib:in "$seconds" || { cat "$folder/jalv.log"; exit 1; }
wait "$recording" || { cat "$folder/jalv.log"; exit 1; }
"$build/bin/physvib-compare-recording" "$folder/live.raw" "$folder/bounce.raw" 8 "$block" "$(sed -n 's/xruns //p' "$folder/ready")"
