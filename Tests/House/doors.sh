#!/bin/sh
# SPDX-License-Identifier: MIT
# What one types after ./run.sh and ./test.sh is done or refused at once: --help tells what they do, an option or a word that is no program is
# refused in a line, with 2, and nothing is installed, built or configured for it. doors.sh ROOT
set -eu
cd "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r run.sh test.sh .ci "$folder"
cd "$folder"
PATH_OF=$folder/bin
mkdir bin
for name in cmake apt-get sudo ctest; do # none of them may be called
    printf '#!/bin/sh\necho called >>"%s/called"\nexit 1\n' "$folder" >"bin/$name"
    chmod +x "bin/$name"
done
failed=0

# expect CODE LINES WORDS CALL...: its exit code, how many lines it says, and words that stand in them.
expect() {
    code=$1 lines=$2 words=$3
    shift 3
    got=0
    PATH=$PATH_OF:$PATH timeout 20 "$@" >told 2>&1 || got=$?
    [ "$got" = "$code" ] && [ "$(wc -l <told)" -le "$lines" ] && grep -q -e "$words" told && [ ! -e called ] && return 0
    printf 'doors: %s: expected %s, at most %s lines with "%s", nothing called; found %s:\n' "$*" "$code" "$lines" "$words" "$got"
    cat told
    failed=1
    rm -f called
}
expect 0 8 'PROGRAM' ./run.sh --help
expect 0 8 'PROGRAM' ./run.sh -h
expect 0 8 'PROGRAM' ./run.sh physvib-mixer --help
expect 2 1 'expected programs' ./run.sh --seconds 3
expect 2 1 'expected programs' ./run.sh fysvib
expect 2 1 'expected programs' ./run.sh physvib drop
expect 0 8 'every test' ./test.sh --help
expect 2 1 'ctest --preset release -R Api' ./test.sh Api
exit $failed
