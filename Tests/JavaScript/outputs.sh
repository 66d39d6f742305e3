#!/bin/sh
# SPDX-License-Identifier: MIT
# In Chromium and Firefox, on sound devices that play to nobody: which device output each of 1 to 8 actuators reaches, two worlds on one output, a device that is unplugged and
# comes back, and a machine without one; in the package and in the page. Ten minutes. Needs npm, and build-package.sh before. usage: Tests/JavaScript/outputs.sh [BROWSER...]
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
ensure_packages chromium firefox-esr
work=$(mktemp -d)
trap '[ -z "${sound_pid:-}" ] || kill "$sound_pid" 2>/dev/null || :; rm -rf "$work"' EXIT
. Tests/JavaScript/sound-server.sh
start_sound
mkdir "$work/package"
tar -xzf build/web/physvib-*.tgz -C "$work"
[ -d build/web/page ] || Standalone/Web/build-web.sh
PULSE_PROGRAMS=$sound/usr/bin PULSE_LIBRARIES=$sound_libraries node Tests/JavaScript/outputs.mjs "$work/package" build/web/page "$@"
