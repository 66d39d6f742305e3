#!/bin/sh
# SPDX-License-Identifier: MIT
# The first build, of run.sh, stays small: files to compile, packages, megabytes to fetch; and so do the packages of test.sh. usage: first-build.sh FOLDER
# What is counted are packages beyond a bare Debian 12, for test.sh those beyond the first build's; apt only tells what it would do.
# Another Debian has other packages (13: 370 for test.sh): there that count is told, and not judged.
set -eu
folder=$1
cd "$(dirname "$0")/../.."
. .ci/packages.sh
most_objects=35 # explanations, and laws of rows, of space and of rows in it, came to the first 30
most_packages=120
most_megabytes=120
most_test_packages=355 # R, which tests the tests of studies, has three

fail() {
    echo "$*" >&2
    exit 1
}
rm -rf "$folder"
cmake --preset first -B "$folder" >"$folder.log" 2>&1 || { cat "$folder.log" >&2 && fail "the first build cannot be configured"; }
objects=$(grep -c '"file"' "$folder/compile_commands.json")
echo "files that are compiled: $objects of at most $most_objects"
[ "$objects" -le $most_objects ] || fail "run.sh compiles $objects files before anybody sees a picture: at most $most_objects"
asked=$(sed -nE 's/^(JUCE|GTest|benchmark|Eigen3|AUBIO|SERIALPORT|SAMPLERATE|LIBLO)_(DIR|FOUND|INCLUDE_DIR|INCLUDEDIR).*/\1/p' "$folder/CMakeCache.txt" | sort -u | tr '\n' ' ')
[ -z "$asked" ] || fail "the first build asks for what it does not need: $asked"

# An empty machine of apt's own: nothing is installed there.
mkdir -p "$folder/apt/archives/partial"
: >"$folder/apt/status"
# fetched [PACKAGE...]: how many packages a machine gets with these, and their bytes.
fetched() {
    apt-get install -y --no-install-recommends --print-uris -o Dir::State::status="$folder/apt/status" -o Dir::State::extended_states="$folder/apt/extended" \
        -o Dir::Cache::archives="$folder/apt/archives" '?essential' apt "$@" | awk "/^'/ { count++; sum += \$3 } END { print count + 0, sum + 0 }"
}
bare=$(fetched 2>/dev/null || echo 0 0)
if [ "${bare% *}" -eq 0 ]; then
    echo "packages: not counted, apt has no lists here"
    exit 0
fi
# shellcheck disable=SC2046,SC2086 # lists of words
whole=$(fetched $(called $physvib_first_packages))
count=$((${whole% *} - ${bare% *}))
megabytes=$(((${whole#* } - ${bare#* } + 999999) / 1000000))
echo "packages: $count of at most $most_packages, $megabytes MB of at most $most_megabytes"
[ $count -le $most_packages ] || fail "run.sh installs $count packages: at most $most_packages"
[ $megabytes -le $most_megabytes ] || fail "run.sh fetches $megabytes MB: at most $most_megabytes"
# shellcheck disable=SC2046,SC2086 # lists of words
tests=$(fetched $(called $physvib_first_packages $(with_juce_unpacked $physvib_test_packages)))
count=$((${tests% *} - ${whole% *}))
echo "packages of test.sh beyond them: $count of at most $most_test_packages"
[ $count -le $most_test_packages ] || ! grep -q bookworm /etc/os-release || fail "test.sh installs $count packages beyond those of run.sh: at most $most_test_packages"
