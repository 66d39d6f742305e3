#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How long after a contact its hit leaves a JACK server without hardware, 48 kHz, blocks of 64 frames, in each door's default call, by the
# session's clock. `play` and the mixer keep L to the frame; callers of the library have a pace of their own: histograms. Fails above 15 ms.
# Usage: doors.sh LIBPHYSVIB_LIVE BIN_FOLDER PYTHON_FOLDER SECONDS
set -eu
library=$1 bin=$2 python=$3 seconds=$4 here=$(dirname "$(realpath "$0")")
. "$here/jack.sh"
export PHYSVIB_LIVE_LIBRARY="$library" PHYSVIB_LIBRARY="$(dirname "$library")/libphysvib.so.1" PYTHONPATH="$python"
serve 48000 64 8

for door in "thread 100" "mixer 100"; do
    "$bin/physvib-latency-meter" $door "$seconds" >"$folder/row" || { cat "$folder/row"; exit 1; }
    cat "$folder/row"
    awk -F'|' '{ exit !($7 + 0 > 0 && $7 + 0 <= 15) }' "$folder/row"
done

# judge NAME LIMIT_MS PROGRAM...: the median of all hits, each by the first onset after its contact
judge() {
    name=$1 limit=$2
    shift 2
    "$@" >"$folder/told" 2>"$folder/said" || { cat "$folder/said"; exit 1; }
    awk '$1 != "-" { contact[++hits] = $1; next }
         { while (k < hits && contact[k + 1] <= $2) ++k; if (k > 0 && $2 - contact[k] < 120e6 && !taken[k]++) print ($2 - contact[k]) * 1e-6 }
         END { print hits >"/dev/stderr" }' "$folder/told" 2>"$folder/hits" | sort -n >"$folder/ms"
    echo "$name: $(cat "$folder/said")"
    awk -v limit="$limit" '{ exit !($2 + 64 / 48 <= limit) }' "$folder/said" || { echo "$name: L is above $limit ms" >&2; exit 1; }
    awk -v hits="$(cat "$folder/hits")" -v limit="$limit" -v xruns="$(sed 's/.*, \([0-9]*\) xruns/\1/' "$folder/said")" '{ ms[NR] = $1; ++bins[int($1)] }
         END { printf "  %d of %d hits, contact to port %.1f ms (5 to 95 %%: %.1f to %.1f)\n", NR, hits, ms[int(NR / 2) + 1], ms[int(NR / 20) + 1], ms[NR - int(NR / 20)]
               for (bin = 0; bin < 120; ++bin) if (bin in bins) { bar = ""; for (i = 0; i < bins[bin]; ++i) bar = bar "#"; printf "  %3d ms %s\n", bin, bar }
               if (xruns > 1) { print "  (the server had " xruns " xruns: no figure)"; exit 0 }
               exit !(NR > 0.8 * hits && hits > 9 && ms[int(NR / 2) + 1] <= limit) }' "$folder/ms" || { echo "$name: above $limit ms, or not heard" >&2; exit 1; }
}
judge "C, 100 steps/s" 15 "$bin/physvib-door" "$seconds" 100
judge "Python, 100 steps/s" 15 /usr/bin/python3 "$here/door.py" "$bin/../lib/libphysvib-port-onsets.so" "$seconds" 100
lua=$(command -v luajit || :) mcs=$(command -v mcs || :)
[ -z "$lua" ] || LUA_PATH="$python/../Lua/?.lua" judge "Lua, 100 steps/s" 15 "$lua" "$here/door.lua" "$bin/../lib/libphysvib-port-onsets.so" "$seconds" 100
if [ -n "$mcs" ]; then
    "$mcs" -out:"$folder/door.exe" "$here/door.cs" "$python/../CSharp/PhysVib.cs" "$python/../CSharp/PhysVibLive.cs"
    LD_LIBRARY_PATH="$bin/../lib" judge "C#, 100 steps/s" 15 mono "$folder/door.exe" "$seconds" 100
fi
judge "C, 60 steps/s, which the settings do not say" 15 "$bin/physvib-door" "$seconds" 60
