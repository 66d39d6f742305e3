#!/bin/sh
# SPDX-License-Identifier: MIT
# A program that includes a header of engines and calls nothing of it, as a strict compiler takes it: all warnings are errors, also those of
# unused functions. C from the standard on that the engine's own header takes, C++17 and C++20. Prints which standards those were.
# Usage: strict.sh COMPILER INCLUDE HEADER ENGINES_INCLUDE
set -eu
compiler=$1 include=$2 header=$3 engine=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
own=$(sed -n 's/^#include \(<.*>\).*/\1/p' "$include/physvib/engines/$header" | grep -v 'physvib/\|<[a-z]*\(\.h\)\{0,1\}>' | head -n 1)
echo "#include $own" >"$folder/engine.c"
printf '#include <physvib/engines/%s>\nint main(void) { return 0; }\n' "$header" >"$folder/program.c"
taken=""
for standard in c89 gnu89 c99 c11 c17 c++11 c++17 c++20; do
    language=c
    case $standard in c++*) language=c++ ;; esac
    "$compiler" -x $language -std=$standard -fsyntax-only -isystem "$engine" "$folder/engine.c" >"$folder/log" 2>&1 || continue # the engine's own is later
    "$compiler" -x $language -std=$standard -Wall -Wextra -Wshadow -Wunused -Werror -fsyntax-only -isystem "$engine" "-I$include" "$folder/program.c" || {
        case $header.$standard in
            physvib_bullet.h.c++11) continue ;; # C++17 and later
        esac
        exit 1
    }
    taken="$taken $standard"
done
case "$taken" in *" c++17 c++20") ;; *) echo "expected C++17 and C++20 among$taken" && exit 1 ;; esac
echo "$header:$taken"
