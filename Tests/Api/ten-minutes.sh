#!/bin/sh
# SPDX-License-Identifier: MIT
# As a new user, on a bare Debian 12, as root, in a fresh clone: pastes what the pages of C, Chipmunk, Python, Lua and C# say, one after another,
# each to a sound file of its own. fresh-machine.sh --pages makes such a machine.
set -eu
cd "$(dirname "$0")/../.."
[ ! -e build ] || { echo "ten minutes: expected a fresh clone, found build/" && exit 1; }
PATH=$PATH:/usr/games
export DEBIAN_FRONTEND=noninteractive ALSOFT_DRIVERS=null
begin=$(date +%s)
apt-get update -qq
for page in c engines python lua csharp; do
    rm -f once commands drop.wav
    awk -f Tests/Api/page.awk "Docs/$page.md"
    sh -eu once >once.log 2>&1 || { tail once.log && exit 1; }
    display=
    [ $page != lua ] || { apt-get install -y -qq --no-install-recommends xvfb xauth >once.log 2>&1 && display="xvfb-run -a"; } # whoever has a game has a display
    $display sh -eu commands
    [ "$(head -c 4 drop.wav)" = RIFF ] && [ "$(wc -c <drop.wav)" -gt 100000 ]
    echo "ten minutes: $page.md ends in drop.wav, $((($(date +%s) - begin) / 60)) min $((($(date +%s) - begin) % 60)) s from the beginning"
done
