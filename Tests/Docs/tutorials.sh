#!/bin/sh
# SPDX-License-Identifier: MIT
# As a new user, on a bare Debian 12, as root, in a fresh clone: ./run.sh, the line that it tells to type next, then README and the tutorials, one
# after another, all that they say but what needs a device. What was felt is looked at. fresh-machine.sh --tutorials makes such a machine.
set -eu
cd "$(dirname "$0")/../.."
[ ! -e build ] || { echo "tutorials: expected a fresh clone, found build/" && exit 1; }
export DEBIAN_FRONTEND=noninteractive
begin=$(date +%s)
apt-get update -qq
apt-get install -y -qq --no-install-recommends python3 >/dev/null # follow.py's
./run.sh | tee next
next=$(sed -n 's/  renders a list of impacts.*//p' next)
[ -n "$next" ] || { echo "run.sh names no line to type next" && exit 1; }
sh -euc "$next"
for file in shake-the-box again; do python3 Tests/Docs/felt.py out/$file.wav 0.148 0.092 0.295 0.235; done
grep -q '`./run.sh physvib` builds the program' README.md && ./run.sh physvib
for page in README.md Docs/tutorials/first-impact.md Docs/tutorials/first-study.md Docs/tutorials/first-track.md Docs/tutorials/first-game.md Docs/board.md; do
    python3 Tests/Docs/follow.py . $page >page.log 2>&1 || { cat page.log && exit 1; }
    echo "tutorials: $page is followed, $((($(date +%s) - begin) / 60)) min from the beginning"
done
