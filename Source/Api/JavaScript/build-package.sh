#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the JavaScript packages physvib and jspsych-physvib: build/web/physvib-VERSION.tgz and the like, which `npm install` takes. What compiles it comes from Debian; npm
# (Node 20 or newer), which packs it, from you.
# usage: Source/Api/JavaScript/build-package.sh; PHYSVIB_HOMEPAGE, PHYSVIB_REPOSITORY, PHYSVIB_BUGS and PHYSVIB_AUTHOR are fields of package.json
set -eu
cd "$(dirname "$0")/../../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_web_packages
command -v npm >/dev/null || { say "expected npm, of Node 20 or newer, which Debian 12 does not have: https://nodejs.org"; exit 1; }

work=build/web/javascript
mkdir -p "$work"
say "building the package (log: $work/build.log)"
if ! { cmake -S Source/Api/JavaScript -B "$work" -G Ninja --toolchain "$PWD/Standalone/Web/toolchain.cmake" -DCMAKE_BUILD_TYPE=None &&
    cmake --build "$work" ${PHYSVIB_WEB_JOBS:+-j "$PHYSVIB_WEB_JOBS"}; } >"$work/build.log" 2>&1; then
    cat "$work/build.log" >&2
    exit 1
fi
Source/Api/JavaScript/shrink.sh "$work/physvib.wasm" "$work/package/physvib.wasm" "-O2 -s 1" # it renders; 10 KB less, compressed
Source/Api/JavaScript/shrink.sh "$work/files.wasm" "$work/package/files.wasm" # 13 KB
node - "$work/package" <<'END'
const { readdirSync, readFileSync, writeFileSync } = require('node:fs'), folder = process.argv[2];
// Comments, and three of four spaces at the beginning of lines, stay in the sources and in the types: no page needs them.
const text = readFileSync('Source/Api/JavaScript/package/inline.js', 'utf8'), bare = from => from.replace(/^ *\/\/(?! SPDX).*\n/gm, '').replace(/^ *\/\*\*[^]*?\*\/\n/gm, '').replace(/([;{},)\]]) +\/\/ .*$/gm, '$1')
    .replace(/^( {4})+/gm, found => found.slice(0, found.length / 4));
for (const file of readdirSync(folder)) if (file.endsWith('.js')) writeFileSync(`${folder}/${file}`, bare(readFileSync(`${folder}/${file}`, 'utf8')));
// Addresses that npm shows: those that are given.
const { PHYSVIB_HOMEPAGE: homepage, PHYSVIB_BUGS: bugs, PHYSVIB_REPOSITORY: url, PHYSVIB_AUTHOR: author } = process.env;
for (const file of [`${folder}/package.json`, `${folder}/../jspsych/package.json`]) {
    const fields = { ...JSON.parse(readFileSync(file, 'utf8')), ...(author && { author }), ...(homepage && { homepage }), ...(bugs && { bugs }), ...(url && { repository: { type: 'git', url } }) };
    writeFileSync(file, `${JSON.stringify(fields, null, 2)}\n`);
}
writeFileSync(`${folder}/inline.js`, bare(text).replace(/'{(.*?)}'/g, (_, name) => `'${readFileSync(`${folder}/${name}`).toString('base64')}'`));
END
python3 Standalone/Packaging/sbom.py --licences npm >"$work/package/THIRD-PARTY.txt"
rm -f build/web/*.tgz
mkdir -p "$work/again"
for package in package jspsych; do
    cp LICENSES/MIT.txt "$work/$package/LICENSE"
    (cd "$work/$package" && npm pack --silent --pack-destination ../.. >/dev/null)
    touch "$work/$package"/* # and again: who builds it from the same sources gets the same bytes
    (cd "$work/$package" && npm pack --silent --pack-destination ../again >/dev/null)
done
for file in build/web/*.tgz; do cmp "$file" "$work/again/$(basename "$file")" || { say "expected npm pack to give the same bytes twice"; exit 1; }; done
# What a page loads that reads no clips; inline.js is instead of physvib.wasm, no page loads types; feel.js and what few engines need come when they are called.
later='--exclude=THIRD-PARTY.txt --exclude=feel.js --exclude=reader.js --exclude=cannon.js --exclude=havok.js --exclude=jolt.js --exclude=mujoco.js --exclude=react.js --exclude=xr.js'
# shellcheck disable=SC2086 # a list of words
bytes=$(tar -C "$work/package" --exclude=files.wasm --exclude=inline.js --exclude='*.d.ts' $later -cz . | wc -c)
file=$(ls build/web/physvib-*.tgz)
say "$file: $(wc -c <"$file") bytes; without files.wasm, feel.js and others that are loaded when they are asked for, inline.js and types: $bytes"
