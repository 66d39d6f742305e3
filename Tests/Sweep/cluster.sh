#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# cluster.sh [BIN_FOLDER [TASKS (600)]]: a sweep as a job array on a real Slurm of this machine, with processes and a whole node killed in between:
# nothing is lost, nothing done twice, and the table has the bytes of one made without Slurm. A script beside the tests.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../.ci/packages.sh"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_cluster_packages
bin=${1:-$here/../../build/release/bin} tasks=${2:-600}
physvib=$(cd "$bin" && pwd)/physvib
folder=$(mktemp -d)
. "$here/slurm.sh"
trap 'end_cluster; rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder"
fail() { echo "$*"; squeue -a || true; sinfo || true; tail -n 5 ./*.log; cat s/slurm/*.txt; exit 1; }
done_tasks() { find s/tasks -name '*.csv' 2>/dev/null | wc -l; }
more_than() { [ "$(done_tasks)" -gt "$1" ]; }
node_is_down() { sinfo -h -N -n one -o %t | grep -q down; }
no_jobs() { [ -z "$(squeue -h)" ]; }
steps() { ps -eo pid=,args= | awk -v program="$physvib" -v folder="$folder" '$2 == program && index($0, folder) { print $1 }'; }

echo '{"physvib_sweep": 1, "name": "cluster", "scenes": ["shake-the-box", "marbles"], "seeds": {"from": 1, "count": '$((tasks / 4))'},
 "layouts": ["phone4", "ring2"], "options": {"seconds": 10}}' >design.json
"$physvib" sweep design.json --out alone
start_cluster
"$physvib" sweep design.json --out s --slurm

wait_for 120 more_than $((tasks / 10)) || fail "nothing begins"
for process in $(steps); do kill -9 "$process" 2>/dev/null || true; done
echo "processes of the jobs killed: $(done_tasks) tasks done"

wait_for 120 more_than $((tasks / 4)) || fail "nothing goes on"
kill -9 "$node_one"
for process in $(ps -eo pid=,comm= | awk '$2 == "slurmstepd" { print $1 }'); do # with what they started
    ls -l "/proc/$process/fd" 2>/dev/null | grep -q "$folder/slurmd.one.log" || continue
    for child in $(ps -eo pid=,ppid= | awk -v parent="$process" '$2 == parent { print $1 }'); do kill -9 "$child" 2>/dev/null || true; done
    kill -9 "$process" 2>/dev/null || true
done
echo "a node and what ran on it killed: $(done_tasks) tasks done"
wait_for 120 node_is_down || fail "nobody misses it"
start_node one
wait_for 300 no_jobs || fail "the jobs do not end"
echo "the jobs are over: $(done_tasks) tasks done"

times=1
until "$physvib" sweep design.json --out s --gather; do # whose process was killed gave up the rest of its job
    [ $times -lt 4 ] || fail "tasks are lost"
    "$physvib" sweep design.json --out s --slurm
    wait_for 300 no_jobs || fail "the jobs do not end"
    times=$((times + 1))
done
cmp alone/index.csv s/index.csv || fail "another table than without Slurm"
[ -z "$(find s -name '*.part')" ] || fail "left behind"
cat s/log/*.txt | awk '$1 == "begun" { begun++ } $1 == "finished" { finished++; if (seen[$2]++) twice++ }
    END { printf "submitted '$times' times; %d begun, %d finished, %d finished twice; the same bytes as without Slurm\n", begun, finished, twice; exit twice > 0 }'
