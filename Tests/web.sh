#!/bin/sh
# SPDX-License-Identifier: MIT
# The page as a visitor meets it, beside CI: built, opened in headless Chromium from 127.0.0.1, and held against the native program.
# Needs 400 MB of packages and some minutes; with npm, axe-core judges it as well. Pictures: out/web.
# usage: Tests/web.sh [PATH/physvib]
set -eu
cd "$(dirname "$0")/.."
physvib=${1:-build/release/bin/physvib}
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_web_test_packages
Standalone/Web/build-web.sh
bytes=$(tar -C build/web --exclude=THIRD-PARTY.txt -cz page | wc -c) # no page loads the licences
[ "$bytes" -lt 310800 ] || { say "the page: expected less than 310.8 KB compressed, found $bytes bytes"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
seconds=10
seed=3
natives=""
for scene in marbles fruit-basket; do # of round bodies: Docs/web.md says why
    "$physvib" render "$scene" --seconds "$seconds" --seed "$seed" --instructions scalar --out "$work/$scene.wav" >/dev/null
    natives="$natives $scene=$work/$scene.wav"
done
sed 's/"radius_m": 0.099/"radius_m": -1/' Source/Scene/Scenes/shake-the-box.json >"$work/bad.json"
physvib=$(realpath "$physvib")
(cd "$work" && "$physvib" render bad.json --out never.wav 2>fault.txt) && exit 1
# shellcheck disable=SC2086 # a list of words
python3 Tests/Web/browser.py build/web/page "$seconds" "$seed" "$work/bad.json" out/web $natives <"$work/fault.txt"
axe=""
if command -v npm >/dev/null; then
    (cd "$work" && echo '{ "private": true }' >package.json && npm install --silent --no-audit --no-fund axe-core@4)
    axe=$work/node_modules/axe-core/axe.min.js
fi
python3 Tests/Web/sharing.py build/web/page "$physvib" out/web ${axe:+"$axe"}
