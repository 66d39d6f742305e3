// SPDX-License-Identifier: MIT
// The web page over http, of which browsers make no secure context: one sentence, and no error of JavaScript.
import assert from 'node:assert/strict';
import { Sound } from '../../Standalone/Web/Page/sound.js';

globalThis.isSecureContext = false;
await assert.rejects(new Sound(() => {}).start({}), /came by http.*127\.0\.0\.1:8000/);
console.log('http: one sentence');
