#!/bin/sh
# SPDX-License-Identifier: MIT
# pymunk_space.py with pymunk from PyPI, which Debian does not have. Usage: pymunk.sh LIBRARY
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check pymunk
PYTHONPATH=$here/../../Source/Api/Python PYTHONDONTWRITEBYTECODE=1 "$work/venv/bin/python" "$here/pymunk_space.py" "$1"
