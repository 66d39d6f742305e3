#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every module shows its format's entry points and nothing else: what two modules both show, the loader may merge.
# Usage: exports.sh PLUGINS_FOLDER
set -eu
failed=0
expect() { # what every module FOLDER has to show
    found=$(nm -D --defined-only "$2" | awk '{ printf "%s%s", separator, $NF; separator = " " }')
    [ "$found" = "$1" ] && return
    failed=1
    echo "$2: expected $1, found $(echo "$found" | wc -w) symbols: $(echo "$found" | cut -c 1-300)"
}
for module in "$1"/*.vst3/Contents/*/*.so; do expect "GetPluginFactory ModuleEntry ModuleExit" "$module"; done
for module in "$1"/*.lv2/*.so; do expect "lv2_descriptor lv2ui_descriptor" "$module"; done
[ ! -e "$1/PhysVib.clap" ] || expect clap_entry "$1/PhysVib.clap"
exit $failed
