#!/bin/sh
# SPDX-License-Identifier: MIT
# Saves PhysVib.jucer again in a copy of the sources, compiles what it makes, and lets the formats' tests load that VST3.
# A script beside the tests: it compiles JUCE once more (minutes). Needs the package juce-tools.
# Usage: projucer.sh [JOBS] [BUILD_FOLDER with bin/physvib-format-tests]
set -eu
cd "$(dirname "$0")/../.."
jobs=${1:-2} build=${2:-build/release}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export HOME="$folder" # the Projucer keeps settings there
cp -r Source Plugin PhysVib.jucer "$folder"
modules=$(sed -n 's/^JUCE_MODULES_DIR:INTERNAL=//p' "$build/CMakeCache.txt")
Projucer --set-global-search-path linux defaultJuceModulePath "$modules"
Projucer --resave "$folder/PhysVib.jucer"
cxx=g++
command -v ccache >/dev/null && cxx="ccache g++"
make -C "$folder/Builds/LinuxMakefile" -j"$jobs" CONFIG=Release CXX="$cxx" VST3 LV2 >"$folder/make.log" 2>&1 || { tail -n 40 "$folder/make.log"; exit 1; }
ls -l "$folder"/Builds/LinuxMakefile/build/PhysVib.*/
PHYSVIB_PLUGINS_FOLDER="$folder/Builds/LinuxMakefile/build" "$build/bin/physvib-format-tests" --gtest_filter='RawVst3.WithoutAnyArrangement:RawVst3.TheFirstNSpeakers:RawVst3.StateComesBack*'
