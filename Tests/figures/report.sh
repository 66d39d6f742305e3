#!/bin/bash
# SPDX-License-Identifier: MIT
# Simulates every built-in study and the thesis', makes their reports, and looks at them from outside: pictures as XML, the page in headless Chromium (no complaint
# on the console, nothing loaded, A4 in print), the tests in R. Pictures of the pages stay in FOLDER, to be looked at.
# Usage: report.sh PHYSVIB FOLDER [PARTICIPANTS]
set -euo pipefail
physvib=$1
folder=$2
participants=${3:-12}
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=../../.ci/packages.sh
. "$here/../../.ci/packages.sh"
ensure_packages chromium-headless-shell poppler-utils libxml2-utils r-base-core || say "what is missing is left out below"
faults=0
fault() { echo "  FAULT: $*"; faults=$((faults + 1)); }
has() { command -v "$1" >/dev/null 2>&1; }

# in_chromium FOLDER: prints index.html there.
in_chromium() {
    chromium-headless-shell --no-sandbox --disable-gpu --enable-logging=stderr --no-pdf-header-footer --print-to-pdf="$1/page.pdf" "file://$(realpath "$1")/index.html" >/dev/null 2>"$1/chromium.txt"
    complaints=$(grep -c CONSOLE "$1/chromium.txt" || true)
    [ "$complaints" -eq 0 ] || fault "$(grep CONSOLE "$1/chromium.txt" | head -n 3)"
    size=$(pdfinfo "$1/page.pdf" | sed -n 's/^Page size: *//p')
    case $size in *A4*) ;; *) fault "printed as $size" ;; esac
    echo "  Chromium: $complaints complaints, $(pdfinfo "$1/page.pdf" | sed -n 's/^Pages: *//p') pages, $size"
    rm -f "$1"/page-*.png
    pdftoppm -r 80 -png "$1/page.pdf" "$1/page"
}

look_at() {
    pictures=$(grep -c '^<svg ' "$1/index.html" || true)
    if has xmllint; then
        awk '/^<svg /{n++; file=sprintf("%s/picture-%02d.svg", folder, n)} file{print > file} /^<\/svg>/{close(file); file=""}' folder="$1" "$1/index.html"
        for svg in "$1"/picture-*.svg; do xmllint --noout "$svg" || fault "$svg is no XML"; done
        echo "  $pictures pictures are XML"
    fi
    if has chromium-headless-shell && has pdfinfo; then in_chromium "$1"; else echo "  Chromium is not here: the page was not opened"; fi
    [ -e "$1/analysis.R" ] || return 0
    if has Rscript; then
        (cd "$1" && Rscript analysis.R >r.txt 2>&1) || fault "R: $(tail -n 3 "$1/r.txt")"
        echo "  R: $(tail -n 1 "$1/r.txt")"
    else echo "  R is not here: no test was run"; fi
}

mkdir -p "$folder/trials"
for study in $("$physvib" study list | cut -d' ' -f1 | grep -v -e -thesis$); do
    rm -rf "${folder:?}/$study"
    "$physvib" study run "$study" --observer simulated --participants "$participants" --out "$folder/trials" >/dev/null
    "$physvib" report "$folder/trials/$study"-P*.csv --out "$folder/$study" | sed 's/^/  /' >"$folder/told"
    echo "$study: $(tail -n 1 "$folder/told" | sed 's/.*  //')"
    look_at "$folder/$study"
done
rm -rf "${folder:?}/thesis"
"$(dirname "$physvib")/physvib-thesis" "$folder/thesis" >/dev/null # of the tests
for page in "$folder/thesis" "$folder"/thesis/*/; do
    echo "${page#"$folder/"}"
    look_at "${page%/}"
done
echo "$faults faults"
[ "$faults" -eq 0 ]
