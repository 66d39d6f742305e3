#!/bin/sh
# SPDX-License-Identifier: MIT
# In Chromium, Firefox and WebKitGTK: the package's tests that need no Node, the web page, and how late impacts are felt at five rates of pictures, 20 s or SECONDS each.
# Needs npm, and build-package.sh before. usage: Tests/JavaScript/browsers.sh [SECONDS [BROWSER...]]
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_browser_packages
work=$(mktemp -d)
trap '[ -z "${sound_pid:-}" ] || kill "$sound_pid" 2>/dev/null || :; rm -rf "$work"' EXIT
# Firefox opens no sound without a server of it.
. Tests/JavaScript/sound-server.sh
start_sound -L "module-null-sink rate=48000"
echo '{ "private": true }' >"$work/package.json"
(cd "$work" && npm install --silent --no-audit --no-fund "$OLDPWD"/build/web/physvib-*.tgz matter-js@0.20 planck@1 @dimforge/rapier2d-compat@0.21 @dimforge/rapier3d-compat@0.21 box2d3-wasm@5.2)
[ -d build/web/page ] || Standalone/Web/build-web.sh
node Tests/JavaScript/browsers.mjs "$work" build/web/page "$@"
