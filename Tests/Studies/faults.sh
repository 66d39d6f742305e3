#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# faults.sh BIN_FOLDER [TRIALS]: a scripted participant of the mixer feels a study through JACK, whose server is stopped for a second, killed and
# started again, at moments that are not chosen. Passes if every row left as planned, at the planned g, and the report counts them all. Needs jackd and Xvfb.
set -eu
bin=$(cd "$1" && pwd)
trials=${2:-40}
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../Live/jack.sh"
cat >"$folder/short.json" <<END
{"physvib_protocol": 1, "name": "short", "conditions": [{"name": "c", "layout": "phone1", "level_g": 0.2, "stimuli": "grid", "columns": 1, "rows": 1,
 "seconds": 0.4}], "sessions": [{"name": "main", "task": "estimate", "repetitions": $trials}]}
END
serve 48000 256 8
"$here/../Mixer/Window/with-display.sh" "$bin/physvib-studies-recorded" "$folder" "$folder/short.json" JACK:system >"$folder/said" 2>&1 &
playing=$!
for round in $(seq 200); do
    sleep 1.7
    kill -0 "$playing" 2>/dev/null || break
    if [ $((round % 3)) = 0 ]; then
        kill -9 "$server" 2>/dev/null || true
        wait "$server" 2>/dev/null || true
        sleep 0.5
        serve 48000 256 8
    else
        kill -STOP "$server" 2>/dev/null || true
        sleep 1
        kill -CONT "$server" 2>/dev/null || true
    fi
done
wait "$playing" || { cat "$folder/said" >&2; exit 1; }
playing=
rows "$folder/short-P01.csv" | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { ++n; again += $NF; if ($(NF - 1) != 1) bad = bad " left:" n }
    { peak = $(NF - 9); if (peak < 0.178 || peak > 0.225) bad = bad " peak:" n ":" peak }
    END { print n " trials, " again " plays were repeated" bad; exit bad != "" || again == 0 }'
(cd "$folder" && "$bin/physvib" report short-P01.csv --out report --protocol short.json >/dev/null)
grep -q "^JACK:system,.*,$trials,$trials,[0-9]*,[0-9.e-]*$" "$folder/report/apparatus.csv"
echo "the report counts $trials trials"
