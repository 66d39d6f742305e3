// SPDX-License-Identifier: MIT
// The web page over http, of which browsers make no secure context: one sentence, and no error of JavaScript.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const folder = mkdtempSync(join(tmpdir(), 'physvib-')), root = join(import.meta.dirname, '../..'); // the page's files stand beside the package's, as build-web.sh has them
for (const from of ['Source/Api/JavaScript/package', 'Standalone/Web/Page']) cpSync(join(root, from), folder, { recursive: true });
const { Sound, silentBecause } = await import(join(folder, 'sound.js'));

globalThis.isSecureContext = false;
assert.match(silentBecause(), /came by http.*serve\.py/);
await assert.rejects(new Sound(() => {}).start(null, {}), error => error.message === silentBecause());
console.log('http: one sentence');
rmSync(folder, { recursive: true });
