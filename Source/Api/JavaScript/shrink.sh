#!/bin/sh
# SPDX-License-Identifier: MIT
# A module of WebAssembly made smaller: samples stay the same. The linker leaves the first kilobyte of memory unused (--global-base).
# usage: Source/Api/JavaScript/shrink.sh FROM.wasm TO.wasm [OPTIONS]: of wasm-opt (-Oz)
set -eu
# shellcheck disable=SC2086 # a list of words
exec wasm-opt "$1" ${3:--Oz} --converge --low-memory-unused --enable-bulk-memory --enable-sign-ext --enable-nontrapping-float-to-int --enable-mutable-globals \
    --enable-multivalue --enable-reference-types -o "$2"
