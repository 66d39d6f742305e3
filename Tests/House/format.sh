#!/bin/sh
# SPDX-License-Identifier: MIT
# Every file of C and C++ is as clang-format 14 leaves it: format.sh ROOT [FOLDER...] names those that are not, and what mends them.
set -eu
cd "$1"
shift
bad=$(find "${@:-.}" -path '*/build' -prune -o -path '*/.git' -prune -o -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.c' \) -print |
    xargs -P 4 -n 50 clang-format-14 --dry-run 2>&1 | sed -n 's/^\([^:]*\):.*-Wclang-format-violations.*/\1/p' | sort -u)
[ -z "$bad" ] || { printf '%s\nexpected these as the formatter leaves them: clang-format-14 -i FILE\n' "$bad"; exit 1; }
