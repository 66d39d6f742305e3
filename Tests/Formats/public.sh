#!/bin/sh
# SPDX-License-Identifier: MIT
# Renders every haptic file below a folder, or hears in one line why not: public.sh FOLDER [BIN_FOLDER].
# Ends with the counts of each ending; 1 if a file was neither rendered nor refused by one clear line that names it.
set -eu
[ $# -ge 1 ] && [ -d "$1" ] || { echo "public.sh FOLDER [BIN_FOLDER]" >&2; exit 2; }
bin=${2:-$(dirname "$0")/../../build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
find "$1" -type f \( -iname '*.hjif' -o -iname '*.haptic' -o -iname '*.ahap' \) | sort >"$work/files"
: >"$work/outcomes"
while IFS= read -r file; do
    ending=$(printf '%s' "${file##*.}" | tr '[:upper:]' '[:lower:]')
    code=0
    timeout 60 "$bin/physvib" render "$file" --out "$work/out.wav" >"$work/out" 2>"$work/err" </dev/null || code=$?
    if [ $code -eq 0 ] && [ -s "$work/out.wav" ]; then
        outcome=rendered
    elif [ $code -eq 1 ] && [ "$(wc -l <"$work/err")" -eq 1 ] && grep -qF "$file" "$work/err" && [ ! -e "$work/out.wav" ]; then
        outcome=refused
        cat "$work/err"
    else
        outcome=unclear
        echo "unclear, exit $code: $file"
        cat "$work/err"
    fi
    echo "$ending $outcome" >>"$work/outcomes"
    rm -f "$work/out.wav"
done <"$work/files"
sort "$work/outcomes" | uniq -c
echo "$(wc -l <"$work/files") files"
[ -s "$work/files" ] && ! grep -q unclear "$work/outcomes"
