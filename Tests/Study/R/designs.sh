#!/bin/bash
# SPDX-License-Identifier: MIT
# designs.sh PHYSVIB: six designs that papers have, written from the pages; simulated people, of whom some are killed and go on; their reports; and
# designs.R, which computes each figure from the trial files with R's own functions, beside tests.csv.
set -euo pipefail
physvib=$1
here=$(cd "$(dirname "$0")" && pwd)
command -v Rscript >/dev/null 2>&1 || { echo "Rscript (Debian: r-base-core) is not here: no design was tried"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
call='"call": "stimulus phantom --at 0.5,0.5 --layout phone1 --frequency'
protocol() { # NAME CONDITIONS SESSIONS
    echo "{\"physvib_protocol\": 1, \"name\": \"$1\", \"condition_order\": \"latin-square\", \"conditions\": [$2], \"sessions\": [$3]}" >"$1.json"
}
tone() { # NAME FREQUENCY: levels as factors
    echo "{\"name\": \"$1\", \"layout\": \"phone1\", \"stimuli\": \"calls\", \"factors\": [{\"name\": \"g\", \"values\": [\"0.05\", \"0.1\", \"0.2\", \"0.4\"]}], $call $2 --level-g {g} --seconds 0.2\"}"
}
pair() { # NAME FREQUENCY: a standard and one whose level is moved
    echo "{\"name\": \"$1\", \"layout\": \"phone1\", \"frequency_hz\": $2, \"level_g\": 0.1, \"stimuli\": \"grid\", \"columns\": 1, \"rows\": 1, \"seconds\": 0.2}"
}
line() { # NAME LAYOUT: places on a line
    echo "{\"name\": \"$1\", \"layout\": \"phone2\", \"stimuli\": \"calls\", \"factors\": [{\"name\": \"x\", \"values\": [\"0.2\", \"0.35\", \"0.45\", \"0.55\", \"0.65\", \"0.8\"]}], \"call\": \"stimulus phantom --at {x},0.5 --layout phone2 --frequency $2 --seconds 0.2 --level-g 0.3\"}"
}
grid() { echo "{\"name\": \"$1\", \"layout\": \"$2\", \"stimuli\": \"grid\", \"columns\": 3, \"rows\": 3, \"seconds\": 0.2}"; }

protocol realism "{\"name\": \"tap\", \"layout\": \"phone1\", \"stimuli\": \"calls\", \"factors\": [{\"name\": \"frequency\", \"values\": [\"80\", \"200\"]}, {\"name\": \"decay\", \"values\": [\"10\", \"40\"]}, {\"name\": \"level\", \"values\": [\"0.1\", \"0.2\", \"0.4\"]}], $call {frequency} --decay {decay} --level-g {level} --seconds 0.2\"}" \
    '{"name": "practice", "training": true, "task": "rate", "scales": ["realism", "hardness"]}, {"name": "main", "task": "rate", "scales": ["realism", "hardness"], "repetitions": 2}'
protocol load "$(pair low 80), $(pair middle 150), $(pair high 250)" \
    '{"name": "main", "task": "estimate"}, {"name": "load", "task": "rate", "once": true, "scales": ["effort", "frustration"]}'
protocol sides "$(line slow 80), $(line fast 200)" '{"name": "main", "task": "choose", "answers": ["left", "right"], "repetitions": 12}'
protocol numbers "$(tone deep 60), $(tone middle 150), $(tone high 300)" '{"name": "main", "task": "estimate", "repetitions": 2}'
protocol steps "$(pair deep 60), $(pair middle 150), $(pair high 300)" \
    '{"name": "main", "task": "choose", "alternatives": [{"name": "standard"}, {"name": "stronger"}], "staircase": {"alternative": "stronger", "start_db": 8, "most_db": 12, "reversals": 8}}'
protocol hurried "$(grid PHONE phone4), $(grid RING ring4)" '{"name": "main", "task": "identify", "repetitions": 3, "answer_within_s": 2.5}'

kills=0
for design in realism load sides numbers steps hurried; do
    "$physvib" study check "$design.json" >check.txt || { cat check.txt; exit 1; }
    "$physvib" study run "$design.json" --observer simulated --participants 8 --out whole >/dev/null
    for number in 1 2 3 4 5 6 7 8; do
        for _ in 1 2 3; do # a half is killed, three times each
            [ $number -le 4 ] || break
            "$physvib" study run "$design.json" --observer simulated --number $number --out trials --pace 0.005 >/dev/null & study=$!
            sleep 0.2
            kill -9 $study 2>/dev/null || :
            wait $study 2>/dev/null && break
            kills=$((kills + 1))
        done
        "$physvib" study run "$design.json" --observer simulated --number $number --out trials >/dev/null
        cmp "whole/$design-P0$number.csv" "trials/$design-P0$number.csv"
    done
    "$physvib" report trials/"$design"-P*.csv --protocol "$design.json" --out "$design" >told
    grep -q ' tests by R$' told || { cat told; exit 1; }
done
echo "$kills runs were killed and went on"
[ $kills -gt 0 ]
Rscript "$here/designs.R"
