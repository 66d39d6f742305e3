// SPDX-License-Identifier: MIT
// The emulated Pico as a device that another machine's Linux uses: a USB/IP server with one device.
// usbip.mjs IMAGE CHANNELS EXPECTED_PROGRAM QMP_SOCKET PORT. It ends when the client closes the connection, and says how many
// frames of all that Linux sent were equal at the pins.
//
// The emulator takes about twice the time that it plays. So QEMU, which runs that Linux, stands still while the board works
// (QMP's stop and cont): its clocks stand too, and no driver waits longer than it would for a real board.
import { execFileSync } from 'node:child_process';
import net from 'node:net';
import { Board, setup } from './board.mjs';
const [image, channelText, program, qmpPath, port] = process.argv.slice(2);
const channels = +channelText, frameBytes = 2 * channels;
const submit = 1, unlink = 2, submitted = 3, unlinked = 4; // USB/IP's commands and answers
const connectionReset = -104, pipe = -32;                  // Linux' error numbers

const board = new Board(image, channels);
const { device } = board.enumerate();
board.control(setup(0, 9, 0, 0, 0)); // Linux configures it again
const sent = [];
const volumes = new Map(); // lowest that Linux has set, by channel; 256ths of a decibel
let outs = [], ins = [], connection = null, packets = 0, started = 0;

const qmp = net.connect(qmpPath);
qmp.on('data', () => {});
qmp.write('{"execute": "qmp_capabilities"}\n');
const guest = (command) => qmp.write(`{"execute": "${command}"}\n`);

function importReply() {
    const reply = Buffer.alloc(320);
    reply.writeUInt16BE(0x0111, 0);
    reply.writeUInt16BE(3, 2);
    reply.write('/sys/devices/board', 8);
    reply.write('1-1', 264);
    [1, 2, 2].forEach((word, k) => reply.writeUInt32BE(word, 296 + 4 * k)); // bus, device, full speed
    reply.writeUInt16BE(device[8] | (device[9] << 8), 308);
    reply.writeUInt16BE(device[10] | (device[11] << 8), 310);
    reply.writeUInt16BE(device[12] | (device[13] << 8), 312);
    device.slice(4, 7).forEach((byte, k) => (reply[314 + k] = byte));
    reply[318] = 1;
    reply[319] = 5; // interfaces, as nobody reads
    return reply;
}

function answer(request, status, data, actual, descriptors = Buffer.alloc(0)) {
    const head = Buffer.alloc(48);
    head.writeUInt32BE(submitted, 0);
    head.writeUInt32BE(request.number, 4);
    head.writeInt32BE(status, 20);
    head.writeUInt32BE(actual, 24);
    head.writeUInt32BE(descriptors.length / 16, 32);
    connection?.write(Buffer.concat([head, data, descriptors]));
}

function control(request) {
    const { setup: words, isIn, data } = request;
    if (words[0] === 0 && words[1] === 5) return answer(request, 0, Buffer.alloc(0), 0); // it has its address
    const got = board.control(Uint8Array.from(words), Uint8Array.from(data));
    const [type, code, channel, selector, , unit] = words;
    if (got !== null && type === 0x21 && code === 1 && selector === 2 && unit === 2)
        volumes.set(channel, Math.min(volumes.get(channel) ?? 0, data.readInt16LE(0)));
    if (got === null) return answer(request, pipe, Buffer.alloc(0), 0);
    answer(request, 0, isIn ? Buffer.from(got) : Buffer.alloc(0), isIn ? got.length : data.length);
}

// One packet of a request, and one millisecond. True: the request is complete.
const take = (request, packet) => {
    const at = 16 * request.next;
    request.descriptors.writeInt32BE(0, at + 12); // what Linux left there counts as an error
    packet(at, request.descriptors.readUInt32BE(at), request.descriptors.readUInt32BE(at + 4));
    return ++request.next === request.count;
};
let clock = 0; // of the bus, ns; control transfers hold it up
function millisecond() {
    clock = Math.max(clock, board.now) + 1e6;
    board.sof();
    const out = outs[0];
    const isDone = take(out, (at, offset, length) => {
        const bytes = out.data.subarray(offset, offset + length);
        if (packets++ === 0) started = board.frames.length;
        if (!board.packet(Uint8Array.from(bytes))) throw new Error(`packet ${packets} was not taken`);
        sent.push(Buffer.from(bytes));
        out.descriptors.writeUInt32BE(length, at + 8);
    });
    board.run((clock - board.now) / 1e6);
    if (isDone) outs.shift(), answer(out, 0, Buffer.alloc(0), out.data.length, out.descriptors);
    const feedback = ins[0];
    if (!feedback) return;
    const isTold = take(feedback, (at) => {
        const value = Buffer.alloc(4);
        value.writeUInt32LE(board.feedback ?? 48 << 16);
        feedback.told.push(value);
        feedback.descriptors.writeUInt32BE(value.length, at + 8);
    });
    if (isTold) ins.shift(), answer(feedback, 0, Buffer.concat(feedback.told), 4 * feedback.count, feedback.descriptors);
}

// The board's time goes on while Linux has packets for it, and during control transfers.
let isDue = false;
function work() {
    isDue = false;
    if (outs.length === 0) return;
    guest('stop');
    while (outs.length > 0) millisecond();
    guest('cont');
}

function receive(head, data, descriptors) {
    const command = head.readUInt32BE(0), number = head.readUInt32BE(4), endpoint = head.readUInt32BE(16), isIn = head.readUInt32BE(12) === 1;
    if (command === unlink) {
        const which = head.readUInt32BE(20), isWaiting = [...outs, ...ins].some((r) => r.number === which);
        outs = outs.filter((r) => r.number !== which);
        ins = ins.filter((r) => r.number !== which);
        const reply = Buffer.alloc(48);
        reply.writeUInt32BE(unlinked, 0);
        reply.writeUInt32BE(number, 4);
        reply.writeInt32BE(isWaiting ? connectionReset : 0, 20);
        return connection.write(reply);
    }
    const request = { number, isIn, data, descriptors, setup: [...head.subarray(40, 48)], count: descriptors.length / 16, next: 0, told: [] };
    if (endpoint === 0) return control(request);
    if (endpoint !== 1) return; // the serial port: never answered
    (isIn ? ins : outs).push(request);
    if (!isDue) isDue = true, setTimeout(work, 3); // more may be on its way
}

function report() {
    const all = Buffer.concat(sent);
    const tile = 16 * frameBytes, whole = all.subarray(0, all.length - (all.length % tile));
    const expected = execFileSync(program, [channelText, 'full'], { input: whole, maxBuffer: 1 << 30 });
    const value = (n, j) => expected.readInt16LE(n * frameBytes + 2 * j), total = expected.length / frameBytes;
    const isSilent = (n) => Array.from({ length: channels }, (_, j) => value(n, j)).every((v) => v === 0);
    let first = 0, last = total - 1;
    while (first < total && isSilent(first)) ++first;
    while (last > first && isSilent(last)) --last;
    const pins = board.frames.slice(started).map(({ frame }) => frame), firstAtPins = pins.findIndex((frame) => frame.some((v) => v !== 0));
    let equal = 0;
    for (let n = first; n <= last; ++n)
        if (pins[firstAtPins - first + n]?.every((v, j) => v === value(n, j))) ++equal;
    console.log(`${channels} channels: ${packets} packets, ${all.length / frameBytes} frames from Linux, ${last - first + 1} from the first to the last that is not silent: ${equal} equal at the pins`);
    console.log(`  ${board.ask('counters')}`);
    console.log(`volumes set: ${[...volumes].filter(([channel]) => channel > 0).sort().map(([channel, v]) => `${channel} ${v / 256} dB`).join(', ')}`);
    process.exit(last > first && equal === last - first + 1 ? 0 : 1);
}

net.createServer((socket) => {
    let waiting = Buffer.alloc(0);
    connection = socket;
    socket.setNoDelay(true);
    socket.on('error', () => {});
    socket.on('close', report);
    let isImported = false;
    socket.on('data', (bytes) => {
        waiting = Buffer.concat([waiting, bytes]);
        if (!isImported && waiting.length >= 40) {
            waiting = waiting.subarray(40);
            isImported = true;
            socket.write(importReply());
        }
        while (isImported && waiting.length >= 48) {
            const isSubmit = waiting.readUInt32BE(0) === submit, isIn = waiting.readUInt32BE(12) === 1;
            const data = isSubmit && !isIn ? waiting.readUInt32BE(24) : 0, count = isSubmit ? Math.max(0, waiting.readInt32BE(32)) : 0;
            const total = 48 + data + 16 * count;
            if (waiting.length < total) return;
            const part = (from, to) => Buffer.from(waiting.subarray(from, to));
            receive(part(0, 48), part(48, 48 + data), part(48 + data, total));
            waiting = waiting.subarray(total);
        }
    });
}).listen(+port, '127.0.0.1', () => console.log('listening'));
