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
server=""
trap '[ -z "$server" ] || kill "$server"; rm -rf "$work"' EXIT
# Firefox opens no sound without a server of it. This one plays to nobody, and is unpacked only, so nothing else on this machine finds it.
sound=$work/sound
mkdir "$sound"
# shellcheck disable=SC2086 # a list of words
from_debian "$sound" download $physvib_sound_files
for archive in "$sound"/*.deb; do dpkg-deb -x "$archive" "$sound"; done
libraries=$(ls -d "$sound"/usr/lib/*-linux-gnu) modules=$(ls -d "$sound"/usr/lib/pulse-*/modules)
HOME=$sound XDG_RUNTIME_DIR=$sound LD_LIBRARY_PATH=$libraries:$libraries/pulseaudio:$modules "$sound/usr/bin/pulseaudio" -n -p "$modules" --use-pid-file=no --disable-shm=yes \
    --exit-idle-time=-1 --daemonize=no -L "module-null-sink rate=48000" -L "module-native-protocol-unix auth-anonymous=1 socket=$sound/socket" >"$sound/log" 2>&1 &
server=$!
echo '{ "private": true }' >"$work/package.json"
(cd "$work" && npm install --silent --no-audit --no-fund "$OLDPWD"/build/web/physvib-*.tgz matter-js@0.20 planck@1 @dimforge/rapier2d-compat@0.21 @dimforge/rapier3d-compat@0.21 box2d3-wasm@5.2)
[ -d build/web/page ] || Standalone/Web/build-web.sh
[ -S "$sound/socket" ] || { cat "$sound/log" >&2; exit 1; }
PULSE_SERVER=unix:$sound/socket node Tests/JavaScript/browsers.mjs "$work" build/web/page "$@"
