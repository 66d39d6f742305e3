#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs a program in C against an installed copy by pkg-config alone.
# Usage: pkg-config-c.sh INSTALLED SOURCE FOLDER COMPILER [FLAG...]
set -eu
PKG_CONFIG_PATH=$(dirname "$(find "$1" -name physvib-c.pc)")
export PKG_CONFIG_PATH
source=$2
cd "$3"
shift 3
compiler=$1
shift
# shellcheck disable=SC2046 # lists of words
"$compiler" -x c "$source" -x none "$@" $(pkg-config --cflags --libs physvib-c) -o drop
LD_LIBRARY_PATH=$(pkg-config --variable=libdir physvib-c) ./drop
