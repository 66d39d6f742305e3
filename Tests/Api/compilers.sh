#!/bin/sh
# SPDX-License-Identifier: MIT
# Compiles a program as C of every standard from 1989 on, and as C++, with all warnings as errors, and runs each.
# Usage: compilers.sh COMPILER PROGRAM.c INCLUDE LIBRARY [FLAG...]
set -eu
compiler=$1 program=$(realpath "$2") include=$3 library=$4
shift 4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for standard in c89 c99 c11 c17 c++11 c++20; do
    language=c
    case $standard in c++*) language=c++ ;; esac
    "$compiler" -x $language -std=$standard -Wall -Wextra -pedantic -Werror "-I$include" "$program" -x none "$@" "$library" "-Wl,-rpath,$(dirname "$library")" -o program
    printf '%s: ' $standard
    ./program
done
