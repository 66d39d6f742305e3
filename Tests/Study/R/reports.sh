#!/bin/bash
# SPDX-License-Identifier: MIT
# reports.sh PHYSVIB: analysis.R of the reports of simulated studies runs again as the report ran it, and every test has a p.
set -euo pipefail
physvib=$1
command -v Rscript >/dev/null 2>&1 || { echo "Rscript (Debian: r-base-core) is not here: no report's tests were run"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for study in patterns phantom-grids phantom-places model-or-sound eight-methods magnitudes; do
    "$physvib" study run "$study" --observer simulated --participants 6 --out trials >/dev/null
    "$physvib" report trials/"$study"-P*.csv --out "$study" >told
    ran=$(sed -n 's/.*  \([0-9]*\) tests by R$/\1/p' told)
    cp "$study/tests.csv" beside.csv
    Rscript "$study/analysis.R" >"$study/out.txt" || { cat "$study/out.txt"; exit 1; }
    cmp beside.csv "$study/tests.csv"
    run=$(Rscript -e "t <- read.csv('$study/tests.csv', comment.char = '#'); cat(length(unique(t$""test[which(t$""p <= 1)])))")
    echo "$study: $ran tests, $run with a p"
    [ "$ran" = "$run" ]
done
# The notebook's steps, as Quarto would run them.
"$physvib" report trials/magnitudes-P*.csv --out magnitudes --notebook >/dev/null
(cd magnitudes && awk '/^```$/ || /^#\| eval: false/ { inside = 0 } inside { print } /^```\{r\}/ { inside = 1 }' analysis.qmd >notebook.R)
grep -q "^source" magnitudes/notebook.R
(cd magnitudes && Rscript notebook.R) >told
grep -q "participant *: *chr" told && grep -q "^ *stimulus.*chi-squared" told
# Without R the page says what to install, and has all but the tests.
mkdir bin
for program in env timeout; do ln -s "$(command -v $program)" bin/; done
PATH=$PWD/bin "$physvib" report trials/magnitudes-P*.csv --out without >told
grep -q 'tests: run `Rscript without/analysis.R` where R is (Debian: r-base-core)' told
grep -q 'Not run: ' without/index.html
[ -e without/analysis.R ] && [ ! -e without/tests.csv ]
