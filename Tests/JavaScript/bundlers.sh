#!/bin/sh
# SPDX-License-Identifier: MIT
# The JavaScript package through five bundlers, an import map and another host, in Chromium, Firefox and WebKitGTK, under a strict content security policy: page,
# both modules, audio worklet and worker, each with the samples of render. Needs npm, and build-package.sh before. usage: Tests/JavaScript/bundlers.sh [BROWSER...]
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_browser_packages
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo '{ "private": true }' >"$work/package.json"
(cd "$work" && npm install --silent --no-audit --no-fund "$OLDPWD"/build/web/physvib-*.tgz vite@8 webpack@5 webpack-cli@7 parcel@2 esbuild@0.28 rollup@4 @rollup/plugin-node-resolve@16)
node Tests/JavaScript/bundlers.mjs "$work" "$@"
