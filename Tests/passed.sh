#!/bin/sh
# SPDX-License-Identifier: MIT
# Whether tests passed with these files: exit code 0 if the checksum of what they use (below) is the one that the last night that passed wrote into
# passed/NAME.txt. Files are compared, not their history: a clone, a tarball and a changed tree are judged alike.
# Usage: passed.sh engines|laboratory|sanitizers; with --keep behind it, it writes the checksum (Tests/nightly.sh engines laboratory, Tests/sanitizers.sh --keep).
set -eu
cd "$(dirname "$0")/.."
kept=Tests/passed/$1.txt
case $1 in
engines) used="Source/Api/C Source/Api/CSharp Source/Api/Engines Source/Api/Live Source/Api/Lua Source/Contacts Tests/Api Tests/Engines Tests/Live/love
    Docs/csharp.md Docs/engines.md Docs/lua.md" ;;
laboratory) used="Source/Core Source/Io Source/Lab Source/Scene Source/Stimuli Standalone/Calls Standalone/CommandLine Standalone/Studies Tests/Study/R
    Tests/Thesis/rows.py" ;;
sanitizers) used="CMakeLists.txt CMakePresets.json Source Tests/CMakeLists.txt Tests/sanitizers.sh Tests/Fuzz Tests/Support Tests/Core Tests/Wire Tests/Io
    Tests/Scene Tests/Formats Tests/Study Tests/Api Tests/Documents Tests/Session Tests/Osc" ;;
*) echo "$1: expected engines, laboratory or sanitizers" >&2 && exit 2 ;;
esac
# shellcheck disable=SC2086 # a list of words
sum=$(find $used -type f ! -name '*.pyc' -exec sha256sum {} + | LC_ALL=C sort -k 2 | sha256sum | cut -d ' ' -f 1)
if [ "${2:-}" = --keep ]; then
    echo "$sum" >"$kept"
else
    [ -f "$kept" ] && [ "$(cat "$kept")" = "$sum" ]
fi
