#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# speed.sh [BIN_FOLDER [TASKS (2000)]]: a sweep by one call and by two at once, with the bytes compared; killed twice and resumed; 100,000 tasks planned.
# Prints times and memory; a script beside the tests, as the machine may be shared.
set -eu
bin=${1:-$(cd "$(dirname "$0")/../.." && pwd)/build/release/bin} tasks=${2:-2000}
physvib=$bin/physvib
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

design() { # NAME SEEDS: of eight tasks each
    echo '{"physvib_sweep": 1, "name": "'"$1"'", "scenes": ["shake-the-box", "marbles"], "seeds": {"from": 1, "count": '"$2"'},
 "layouts": ["phone4", "ring2"], "laws": ["linear", "energy"], "options": {"seconds": 5, "rate": 48000}}' >"$1.json"
}
# measured COMMAND...: what it says, and its seconds (real, user, system) and largest memory in MB.
measured() {
    python3 - "$@" <<'END'
import resource, subprocess, sys, time
begin = time.monotonic()
said = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, text=True, check=True).stdout
took, own = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
print(said.strip().splitlines()[-1], f"| {took:.2f} s, user {own.ru_utime:.2f} s, system {own.ru_stime:.2f} s, {own.ru_maxrss / 1024:.0f} MB")
print(f"{took:.4f} {own.ru_utime + own.ru_stime:.4f}", file=open("figures", "w"))
END
}

design many $((tasks / 8))
echo "load before: $(cut -d' ' -f1-3 /proc/loadavg)"
# halves DESIGN FOLDER: both at once, and the table.
cat >halves <<END
seq 2 | xargs -P 2 -I {} '$physvib' sweep "\$1" --out "\$2" --part {}/2 && exec '$physvib' sweep "\$1" --out "\$2" --gather
END
echo "one core:  $(measured "$physvib" sweep many.json --out one)"; mv figures figures.one
echo "two cores: $(measured sh halves many.json two)"; mv figures figures.two
cmp one/index.csv two/index.csv
paste -d' ' figures.one figures.two | awk '{ printf "two cores are %.2f times one; %.2f times the processor time\n", $1 / $3, $4 / $2 }'

seconds=$(awk '{ printf "%.2f", $1 / 3 }' figures.one)
for time in first second; do
    timeout -s KILL "$seconds" "$physvib" sweep many.json --out cut >said 2>&1 && { echo "too fast to be killed"; exit 1; }
    echo "killed for the $time time: $(find cut/tasks -name '*.csv' | wc -l) tasks done"
done
"$physvib" sweep many.json --out cut
cmp one/index.csv cut/index.csv
cat cut/log/*.txt | awk '$1 == "begun" { b++ } $1 == "finished" { f++; if (seen[$2]++) twice++ } END { printf "%d begun, %d finished, %d twice; the same bytes as uninterrupted\n", b, f, twice; exit twice > 0 }'

design plan 12500
echo "plan: $(measured "$physvib" sweep plan.json --plan)"
design plan 125000
echo "plan: $(measured "$physvib" sweep plan.json --plan)"
