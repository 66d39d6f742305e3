#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints a table of real recordings (Docs/materials.md): what `physvib material` finds in drums and key strikes that Debian
# packages as sound data (GPL-2+). They are downloaded with apt unless folders with their contents are given; nothing is installed.
# Usage: recordings.sh PHYSVIB [FOLDER...]
set -eu
physvib=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

if [ $# = 0 ]; then
    (cd "$folder" && apt-get download -qq hydrogen-data bucklespring-data && for package in ./*.deb; do dpkg-deb -x "$package" unpacked; done) >&2
    set -- "$folder/unpacked"
fi

# row FILE: the fit's report in columns, and the highest spectral peak, which the fit has no part in.
row() {
    name=$(basename "$1" .wav)
    if ! "$physvib" material "$1" >"$folder/numbers" 2>"$folder/report"; then
        printf '| %s | %s |\n' "$name" "$(sed 's/.*\.wav: //' "$folder/report")"
        return
    fi
    peak=$("$physvib" material "$1" --rule two-peaks 2>"$folder/none" | sed -n '2s/,.*//p')
    sed -n 's/^physvib: \([^ ]*\) Hz +- \([^,]*\), \([^ ]*\) \/s +- \([^;]*\); residual \([^;]*\) dB; \([0-9]*\) partials\{0,1\} .*confidence \(.*\)$/\1 \2 \3 \4 \5 \6 \7/p' "$folder/report" |
        awk -v name="$name" -v peak="${peak:-none}" '{ printf "| %s | %s +- %s | %s | %s +- %s | %s | %s | %s |\n", name, $1, $2, peak, $3, $4, $5, $6, $7 }'
}

echo '| recording | f, Hz | spectral peak, Hz | tau, /s | residual, dB | partials | confidence |'
echo '| --- | --- | --- | --- | --- | --- | --- |'
find "$@" -type f \( -path '*/GMRockKit/Tom*.wav' -o -path '*/GMRockKit/Cowbell*.wav' -o -path '*/GMRockKit/SideStick*.wav' \) | sort >"$folder/list"
for key in 1c 1e 23 2c 39; do find "$@" -type f -path "*/buckle/wav/$key-[01].wav"; done | sort >>"$folder/list"
[ "$(wc -l <"$folder/list")" -gt 0 ] || { echo "recordings.sh: expected the packages' recordings, found none" >&2; exit 1; }
while read -r file; do row "$file"; done <"$folder/list"
figures=$(dirname "$physvib")/physvib-partial-figures
[ ! -x "$figures" ] || { echo && xargs "$figures" <"$folder/list"; }
