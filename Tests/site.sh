#!/bin/sh
# SPDX-License-Identifier: MIT
# The site as a reader meets it, beside CI: built twice to the same bytes, opened from the disk in headless Chromium at desk and phone size,
# searched. Pictures: out/site.
# usage: Tests/site.sh
set -eu
cd "$(dirname "$0")/.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_site_test_packages
site=$PWD/build/site
again=$(mktemp -d)
trap 'rm -rf "$again"' EXIT
rm -rf "$site"
Docs/Site/build-site.sh "$site"
Docs/Site/build-site.sh "$again"
diff -r "$site" "$again" >&2
say "$(find "$site" -type f | wc -l) files, the same bytes twice"
timeout 300 python3 Tests/Site/browse.py "$site" out/site
