#!/bin/sh
# SPDX-License-Identifier: MIT
# Whether the tests with the label `engines` passed with these files: exit code 0 if the checksum of what they use (below) is the one that
# the last night that passed wrote into passed.txt. Files are compared, not their history: a clone, a tarball and a changed tree are judged alike.
# Usage: passed.sh; passed.sh --keep writes the checksum (Tests/nightly.sh engines does).
set -eu
cd "$(dirname "$0")/../.."
kept=Tests/Engines/passed.txt
sum=$(find Source/Api/C Source/Api/CSharp Source/Api/Engines Source/Api/Live Source/Api/Lua Source/Contacts Tests/Api Tests/Engines Tests/Live/love \
    Docs/csharp.md Docs/engines.md Docs/lua.md -type f ! -name '*.pyc' ! -path "$kept" -exec sha256sum {} + | LC_ALL=C sort -k 2 | sha256sum | cut -d ' ' -f 1)
if [ "${1:-}" = --keep ]; then
    echo "$sum" >"$kept"
else
    [ -f "$kept" ] && [ "$(cat "$kept")" = "$sum" ]
fi
