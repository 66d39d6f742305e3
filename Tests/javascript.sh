#!/bin/sh
# SPDX-License-Identifier: MIT
# The JavaScript package as its user gets it, beside CI: built, packed, installed in an empty folder, held against the native program; then with the
# engines from npm, beside native Box2D, in Node and in headless Chromium. Needs Node 20 or newer with npm, and some minutes for the compiler.
# usage: Tests/javascript.sh [BUILD/bin/physvib]: what else it needs of that build is built
set -eu
cd "$(dirname "$0")/.."
physvib=$(realpath "${1:-build/release/bin/physvib}")
. .ci/packages.sh
Source/Api/JavaScript/build-package.sh
# What a page loads that reads no clips; inline.js is instead of physvib.wasm, no page loads types; feel.js and what few engines need come when they are called.
later='--exclude=THIRD-PARTY.txt --exclude=feel.js --exclude=reader.js --exclude=cannon.js --exclude=havok.js --exclude=jolt.js --exclude=mujoco.js --exclude=react.js --exclude=xr.js'
# shellcheck disable=SC2086 # a list of words
bytes=$(tar -C build/web/javascript/package --exclude=files.wasm --exclude=inline.js --exclude='*.d.ts' $later -cz . | wc -c)
[ "$bytes" -lt 162500 ] || { say "the package: expected less than 162.5 KB compressed, found $bytes bytes"; exit 1; }
python3 Standalone/Packaging/sbom.py --opened build/web/*.tgz
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
package=$(ls "$PWD"/build/web/physvib-*.tgz)
jspsych=$(ls "$PWD"/build/web/jspsych-physvib-*.tgz)
cd "$work"
echo '{ "private": true }' >package.json
npm install --silent --no-audit --no-fund "$package"
cd "$OLDPWD"
for test in package pads audio silent; do node "Tests/JavaScript/$test.mjs" "$work" "$physvib"; done
for test in insecure link clock; do node "Tests/JavaScript/$test.mjs"; done
say "taking the engines from npm"
(cd "$work" && npm install --silent --no-audit --no-fund "$jspsych" matter-js@0.20 planck@1 @dimforge/rapier2d-compat@0.21 @dimforge/rapier3d-compat@0.21 box2d3-wasm@5.2 cannon-es@0.20 @babylonjs/havok@1 @babylonjs/core@9 jolt-physics@1 @mujoco/mujoco@3 react@19 @react-three/fiber@9 @react-three/rapier@2 @react-three/test-renderer@9 iwer@2 phaser@4 excalibur@0.32 kaplay@3001 melonjs@18 three@0.187 jspsych@8 typescript@5)
node Tests/JavaScript/jspsych.mjs "$work"
node Tests/JavaScript/bodies.mjs "$work"
node Tests/JavaScript/velocities.mjs "$work"
node Tests/JavaScript/feel.mjs "$work"
node Tests/JavaScript/kit.mjs "$work" --table --page Docs/javascript.md
node Tests/JavaScript/fuzz.mjs "$work"
node Tests/JavaScript/react.mjs "$work"
node Tests/JavaScript/space-examples.mjs "$work" Source/Api/JavaScript/examples/space
node Tests/JavaScript/xr.mjs "$work"
node Tests/JavaScript/lives.mjs "$work"
node Tests/JavaScript/storm.mjs "$work"
node Tests/JavaScript/memory.mjs "$work"
node Tests/JavaScript/cost.mjs "$work" 100
node Tests/JavaScript/space.mjs "$work"
native=$(dirname "$physvib")/physvib-engine-box2d
cmake --build "$(dirname "$physvib")/.." --target physvib-engine-box2d >/dev/null
node Tests/JavaScript/worlds.mjs "$work" "$native"
python3 Tests/JavaScript/ten.py "$work" "$native"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_web_test_packages
python3 Tests/JavaScript/chromium.py "$work" Source/Api/JavaScript/examples/phaser-matter.mjs
python3 Tests/JavaScript/frameworks.py "$work" Source/Api/JavaScript/examples
node Tests/JavaScript/page.mjs "$work" Docs/javascript.md
