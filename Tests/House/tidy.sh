#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the checks of .clang-tidy over every file that is compiled, as the preset debug compiles it: each alone, and nothing is built.
# Usage: tidy.sh [FOLDER...], such as Source/Contacts; without one, all of ours. JOBS=n: at once (2).
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_build_packages $physvib_tidy_packages
folder=build/tidy
mkdir -p $folder
cmake --preset debug -B $folder -DPHYSVIB_STRICT=OFF >$folder/configure.log 2>&1 || { cat $folder/configure.log; exit 1; }
files=$folder/files
folders=$(echo "${@:-Source Standalone Plugin Firmware Tests}" | tr ' ' '|')
sed -n "s|^ *\"file\": \"$PWD/\(.*\)\".*|\1|p" $folder/compile_commands.json | grep -E "^($folders)/" | sort -u >$files || :
[ -s $files ] || { echo "tidy: no files that are compiled in $*"; exit 2; }
# What clang-tidy says of its own counts goes; commands are gcc's.
if xargs -P "${JOBS:-2}" -n 4 nice clang-tidy-14 -p $folder --quiet --extra-arg=-Wno-unknown-warning-option <$files >$folder/log 2>$folder/counts; then
    echo "tidy: nothing in $(wc -l <$files) files"
else
    grep -h ' error: \|^error: ' $folder/log $folder/counts | sed "s|$PWD/||g" | sort -u
    exit 1
fi
