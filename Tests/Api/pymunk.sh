#!/bin/sh
# SPDX-License-Identifier: MIT
# pymunk_space.py, the kit's situations and the page's game with pymunk and pygame from PyPI, as Debian has no pymunk. Needs node. Usage: pymunk.sh LIBRARY
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check pymunk pygame
export PYTHONPATH="$here/../../Source/Api/Python" PYTHONDONTWRITEBYTECODE=1 PHYSVIB_LIBRARY="$1"
"$work/venv/bin/python" "$here/pymunk_space.py" "$1"
node "$here/../JavaScript/kit.mjs" - "pymunk=$work/venv/bin/python $here/pymunk_kit.py --kit" --page "$here/../../Docs/javascript.md"
SDL_VIDEODRIVER=dummy timeout 20 "$work/venv/bin/python" "$here/../../Source/Api/Python/examples/pymunk_game.py" | grep -m 1 "N s at"
