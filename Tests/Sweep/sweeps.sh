#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# sweeps.sh [BIN_FOLDER [POINTS (100)]]: the workflow of Docs/sweeps on two cores, killed twice and resumed, and as jobs of a real Slurm on this machine
# that loses processes and a node: the same bytes each time, and what was done is not done again.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../.ci/packages.sh"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_sweep_packages
bin=$(cd "${1:-$here/../../build/release/bin}" && pwd) points=${2:-100}
folder=$(mktemp -d)
. "$here/slurm.sh"
trap 'end_cluster; rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder"
fail() { echo "$*"; tail -n 20 said; exit 1; }
sweep() { # OUT WORD...
    out=$1
    shift
    PATH="$bin:$PATH" setsid -w sh -c 'echo $$ >leader; exec snakemake "$@"' sh -s "$here/../../Docs/sweeps/Snakefile" --config design=design.csv "out=$out" --rerun-incomplete "$@" >>said 2>&1
}
rows() { find "$1" -name '*[0-9a-f].csv' -path '*/points/*' ! -name '*.events.csv' 2>/dev/null | sort; }
more_than() { [ "$(rows "$1" | wc -l)" -gt "$2" ]; }
# cut_off OUT: ends by force what works at it; `before` has the rows that are there.
cut_off() {
    kill -s KILL -- "-$(cat leader)"
    wait "$sweeping" 2>/dev/null || true
    rows "$1" | xargs stat -c '%n %Y %i' >before
    echo "killed: $(wc -l <before) of $points points done"
    [ "$(wc -l <before)" -lt "$points" ] || fail "killed too late"
}
# once OUT ALLOWED: of the rows that were there at most so many were made again.
once() {
    rows "$1" | xargs stat -c '%n %Y %i' >after
    again=$(grep -cvxF -f after before || true)
    [ "$again" -le "$2" ] || fail "$again points were made again"
}

/usr/bin/python3 - "$points" >design.csv <<'END'
import sys
print("scene,set:height,seed,layout,seconds")
for n in range(int(sys.argv[1])):
    print(("drop,%d" % (1 + n % 3) if n % 4 < 2 else "shake-the-box,") + f",{n},{('phone4', 'ring2')[n % 2]},2")
END
sweep alone --cores 2 || fail "the sweep fails"
[ "$(wc -l <alone/table.csv)" = $((points + 1)) ] || fail "expected a row per point"
grep -q '^shake-the-box,,2,phone4,2,[1-9][0-9]*,0,.*,physvib render shake-the-box --seed=2 --layout=phone4 --seconds=2$' alone/table.csv || fail "a row is wrong: $(sed -n 4p alone/table.csv)"

for share in 5 2; do
    sweep cut --cores 2 &
    sweeping=$!
    wait_for 120 more_than cut $((points / share)) || fail "nothing begins"
    cut_off cut
    sweep cut --unlock || fail "it stays locked"
done
sweep cut --cores 2 || fail "it does not go on"
cmp alone/table.csv cut/table.csv || fail "another table than uninterrupted"
once cut 2
[ -z "$(find cut -name '*.part')" ] || fail "left behind: $(find cut -name '*.part')"
sweep cut --cores 2 && tail -n 3 said | grep -q 'Nothing to be done' || fail "what is done is done again"
echo "on two cores: killed twice, the same bytes as uninterrupted; $again points made again"

(cat design.csv && echo drop,1,1,phone4,oops) >design.next && mv design.csv design.whole && mv design.next design.csv
! sweep cut --cores 2 || fail "an impossible point passes"
tail -n 40 said | grep -q 'drop .*seconds' || fail "no reason is told"
cp alone/table.csv mine && printf 'scene,out\ndrop,mine\n' >design.csv
! sweep mean --cores 2 || fail "a design writes where it wants"
grep -q 'design.csv: expected what `render` reads, and a cell per column; found out: mine' said && cmp -s mine alone/table.csv || fail "a design writes where it wants"
mv design.whole design.csv

node_is_down() { sinfo -h -N -n one -o %t | grep -q down; }
# those_of NAME: processes of that name that work in this folder.
those_of() { for process in $(ps -eo pid=,comm= | awk -v name="$1" '$2 == name { print $1 }'); do [ "$(readlink "/proc/$process/cwd")" != "$PWD" ] || echo "$process"; done; }
start_cluster
sweep slurm --jobs 2 --cluster-sync "srun --quiet -n1" --group-components points=10 --restart-times 5 &
sweeping=$!
wait_for 120 more_than slurm $((points / 10)) || fail "nothing begins"
for process in $(those_of physvib); do kill -9 "$process" 2>/dev/null || true; done
echo "renders of the jobs killed: $(rows slurm | wc -l) points done"
wait_for 120 more_than slurm $((points / 4)) || fail "nothing goes on"
kill -9 "$node_one"
for process in $(ps -eo pid=,comm= | awk '$2 == "slurmstepd" { print $1 }'); do # with what they started
    ls -l "/proc/$process/fd" 2>/dev/null | grep -q "$folder/slurmd.one.log" || continue
    kill -9 "$process" $(ps -eo pid=,ppid= | awk -v parent="$process" '$2 == parent { print $1 }') 2>/dev/null || true
done
echo "a node and what ran on it killed: $(rows slurm | wc -l) points done"
wait_for 120 node_is_down || fail "nobody misses it"
start_node one
wait "$sweeping" || sweep slurm --jobs 2 --cluster-sync "srun --quiet -n1" --group-components points=10 || fail "it does not go on"
cmp alone/table.csv slurm/table.csv || fail "another table than without Slurm"
echo "by Slurm: renders and a node killed, the same bytes as without it"
