// SPDX-License-Identifier: MIT
// PhysVib with its code inside, for bundlers that cannot include files (esbuild, Rollup), single files, or pages without a server. build-package.sh inserts files at braces.
import { load as loadCode } from './physvib.js';

export * from './physvib.js';

const code = '{physvib.wasm}', worklet = '{worklet.js}';
const bytesOf = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));

/** `files`: where files.wasm is, which few pages need. The worklet comes from a blob: a content security policy has to allow `blob:` in script-src, or play() is
 * told where worklet.js is. */
export async function load({ files } = {}) { return loadCode(bytesOf(code), { files, worklet: new TextDecoder().decode(bytesOf(worklet)) }); }
