// SPDX-License-Identifier: MIT
// The web page over http, of which browsers make no secure context: one sentence, and no error of JavaScript.
import assert from 'node:assert/strict';
import { Sound, silentBecause } from '../../Standalone/Web/Page/sound.js';

globalThis.isSecureContext = false;
assert.match(silentBecause(), /came by http.*serve\.py/);
await assert.rejects(new Sound(() => {}).start(null, {}), error => error.message === silentBecause());
console.log('http: one sentence');
