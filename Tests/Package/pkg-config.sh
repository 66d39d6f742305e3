#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs a program against an installed copy by pkg-config alone.
# Usage: pkg-config.sh INSTALLED SOURCE PROGRAM COMPILER [FLAG...]
set -eu
PKG_CONFIG_PATH=$(dirname "$(find "$1" -name physvib.pc)")
export PKG_CONFIG_PATH
source=$2 program=$3
shift 3
# shellcheck disable=SC2046 # lists of words
"$@" -std=c++20 "$source" -o "$program" $(pkg-config --cflags --libs physvib)
"$program"
