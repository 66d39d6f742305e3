#!/bin/sh
# SPDX-License-Identifier: MIT
# A module of WebAssembly made smaller: samples stay the same. The linker leaves the first kilobyte of memory unused (--global-base).
# Nothing of ours traps, and code whose branches are laid out anew is compressed better: together 1.7 KB of the page.
# usage: Source/Api/JavaScript/shrink.sh FROM.wasm TO.wasm [OPTIONS]: of wasm-opt (twice -Oz)
set -eu
# shellcheck disable=SC2086 # a list of words
exec wasm-opt "$1" --ignore-implicit-traps ${3:--Oz --flatten --rereloop -Oz} --converge --low-memory-unused --enable-bulk-memory --enable-sign-ext --enable-nontrapping-float-to-int --enable-mutable-globals \
    --enable-multivalue --enable-reference-types -o "$2"
