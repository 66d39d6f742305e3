// SPDX-License-Identifier: MIT
// Every frame at the pins of the emulated Pico is the frame that this computer's compiler makes of what was sent:
// frames.mjs IMAGE CHANNELS EXPECTED_PROGRAM full|low FRAMES.raw [NAME]. The file holds 16-bit samples, all channels of a
// frame beside each other.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { Board } from './board.mjs';
const [image, channelText, program, ceiling, file, name] = process.argv.slice(2);
const channels = +channelText, bytes = readFileSync(file), began = Date.now();
const frameBytes = 2 * channels, packetBytes = 48 * frameBytes, packets = Math.floor(bytes.length / packetBytes);
const sent = bytes.subarray(0, packets * packetBytes);
const expected = execFileSync(program, [channelText, ceiling], { input: sent, maxBuffer: 1 << 30 });

const board = new Board(image, channels, { lowCeiling: ceiling === 'low' });
board.enumerate();
if (!board.select(1)) throw new Error('alternate setting 1 is refused');
board.frames = [];
board.busy = 0;
const start = board.now;
let notTaken = 0;
for (let k = 0; k < packets; ++k) {
    const next = start + (k + 1) * 1e6;
    board.sof();
    if (!board.packet(sent.subarray(k * packetBytes, (k + 1) * packetBytes))) ++notTaken;
    board.run((next - board.now) / 1e6);
}
const share = board.busy / (((board.now - start) / 1e9) * 76.8e6);
const counters = board.ask('counters');
board.run(10);

// The first frame that is not silence, in both; from there on they are equal.
const value = (n, j) => expected.readInt16LE(n * frameBytes + 2 * j), total = expected.length / frameBytes;
const isSilent = (frame) => frame.every((v) => v === 0);
let first = 0;
while (first < total && Array.from({ length: channels }, (_, j) => value(first, j)).every((v) => v === 0)) ++first;
const firstAtPins = board.frames.findIndex(({ frame }) => !isSilent(frame));
let equal = 0, compared = 0;
for (let n = first; n < total - 240; ++n, ++compared) // the last 5 ms are the ramp to silence
    if (board.frames[firstAtPins - first + n].frame.every((v, j) => v === value(n, j))) ++equal;
const onset = (board.frames[firstAtPins].at - start) / 1e3 - first / 0.048;
const silentAfter = [...board.frames].reverse().find(({ frame }) => !isSilent(frame)).at - (start + (packets - 1) * 1e6);
console.log(`${name ?? 'frames'}: ${channels} channels, ${packets} packets, ${equal} of ${compared} frames equal at the pins; first frame ` +
    `${onset.toFixed(0)} us after its packet; silent ${(silentAfter / 1e6).toFixed(2)} ms after the last; processor ${(share * 100).toFixed(0)} %, ` +
    `longest interrupts: output ${board.worst.dma}, USB ${board.worst.usb} of 76800 cycles; feedback ${(board.feedback / 65536).toFixed(3)}; ` +
    `${((Date.now() - began) / 1e3).toFixed(0)} s`);
console.log(`  ${counters}`);
if (equal !== compared || compared < 4000 || notTaken > 0 || silentAfter > 5e6 || !counters.startsWith('playing underruns 0 overruns 0 missing_packets 0 wrong_sizes 0'))
    throw new Error(`not all frames are equal, or a packet was not taken (${notTaken}), or silence came late`);
