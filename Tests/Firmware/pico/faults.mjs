// SPDX-License-Identifier: MIT
// What can go wrong between a host and the emulated Pico: never a hang, never a sample above the ceiling or a torn
// frame, silence within 5 ms. faults.mjs IMAGE CHANNELS [REQUESTS (10000)] [TOGGLES (1000)]
import { Board, setup } from './board.mjs';
const [image, channelText, requests = '10000', toggles = '1000'] = process.argv.slice(2);
const channels = +channelText;
const level = 800, loud = () => new Array(channels).fill(level); // as much as the guard lets stay
const say = (text) => console.log(`${channels} channels: ${text}`);
const check = (isTrue, what) => { if (!isTrue) throw new Error(what); };
const counters = (board) => Object.fromEntries([...board.ask('counters').matchAll(/([a-z_]+) (\d+)/g)].map(([, name, n]) => [name, +n]));
// Random numbers that are the same every time.
let seed = 1;
const random = (n) => (seed = (Math.imul(seed, 1103515245) + 12345) >>> 0, Math.floor((seed / 2 ** 32) * n));

function fresh(options) {
    const board = new Board(image, channels, options);
    board.enumerate();
    board.frames = []; // the first one begins in its middle
    return board;
}
function playing(board) {
    board.stream(130, loud);
    check(board.frames.at(-1).frame.every((v) => v === level), 'it does not play');
    board.frames = [];
    return board.now;
}
// How long after `since` the last frame is that is not silence, after 8 ms; also that nothing jumped.
function silence(board, since, what, mayJump = false) {
    board.run(8);
    let last = since, before = level;
    for (const { at, frame } of board.frames) {
        check(frame.every((v) => Math.abs(v) <= level), `${what}: a sample above what was sent`);
        if (!mayJump) check(Math.abs(frame[0] - before) <= level / 40, `${what}: a step of ${Math.abs(frame[0] - before)}`);
        before = frame[0];
        if (at >= since && frame.some((v) => v !== 0)) last = at;
    }
    const ms = (last - since) / 1e6;
    check(ms <= 5, `${what}: silent after ${ms.toFixed(2)} ms`);
    check(!board.amplifierIsOn, `${what}: the amplifiers stay on`);
    say(`${what}: silent after ${ms.toFixed(2)} ms, no step above ${level / 40}`);
}

{
    const board = fresh();
    check(board.select(1), 'alternate setting 1');
    let since = playing(board);
    silence(board, since - 1e6, 'packets stop');
    since = playing(board);
    check(board.select(0), 'alternate setting 0');
    silence(board, since, 'alternate setting 0');
    check(board.select(1), 'alternate setting 1');
    since = playing(board);
    board.suspend();
    silence(board, since, 'suspend');
    board.resume();
    since = playing(board);
    check(board.ask('silence on') === 'silence on', 'silence');
    silence(board, since, 'silence on the serial port');
    check(board.ask('silence off') === 'silence off', 'silence off');
    since = playing(board);
    board.resetBus();
    silence(board, since, 'reset of the bus');
    board.enumerate();
    check(board.select(1), 'alternate setting 1 after a reset');
    playing(board);
    say(`plays again; ${board.ask('counters')}`);
}
{
    // The form of feedback that a host reads, and the same board at another host.
    const board = fresh();
    const form = (asMac) => {
        board.resetBus();
        const { configuration } = board.enumerate({ asMac });
        const at = configuration.findIndex((v, k) => v === 7 && configuration[k + 1] === 5 && configuration[k + 2] === 0x81);
        board.control(setup(0x80, 6, asMac ? 0x0200 : 0x0302, 0, 255)); // what is asked for later says nothing
        board.select(1);
        playing(board);
        const least = board.feedback % 2 ** (8 * board.feedbackBytes) / (asMac ? 2 ** 14 : 2 ** 16);
        check(Math.abs(least - 48) < 1, `feedback: ${least} frames`);
        return `${configuration[at + 4]} ${board.feedbackBytes}`;
    };
    const forms = [form(false), form(true), form(false)].join(', ');
    check(forms === '4 4, 3 3, 4 4', `bytes of feedback, promised and sent: ${forms}`);
    say('feedback of 3 bytes for a host that asks for a text first, of 4 for others');
}
{
    // Late by up to 0.9 ms, missing now and then, doubled, of any size.
    const board = fresh();
    board.select(1);
    playing(board);
    let sent = 0;
    for (let k = 0; k < 1500; ++k) {
        const next = board.now + 1e6, kind = random(40);
        board.sof();
        board.run(kind < 20 ? random(900) / 1e3 : 0);
        const size = kind === 39 ? random(49 * 2 * channels) : kind === 36 ? 0 : 48 * 2 * channels;
        const bytes = board.pack(Array.from({ length: 49 }, loud)).subarray(0, size);
        if (kind !== 38 && board.packet(bytes)) ++sent;
        if (kind === 37) board.run(0.1), board.packet(bytes);
        if (next > board.now) board.run((next - board.now) / 1e6);
    }
    for (const { frame } of board.frames)
        check(frame.every((v) => v >= 0 && v <= level && v === frame[0]), `torn: ${frame}`);
    check(board.isWaitingForPacket, 'a packet of no bytes ended the stream');
    const c = counters(board);
    check(c.wrong_sizes > 0 && c.missing_packets > 0 && c.restarts === 0, 'wrong sizes or missing packets are not counted');
    board.run(20);
    playing(board);
    say(`late, missing, doubled and odd packets: no torn frame; underruns ${c.underruns}, overruns ${c.overruns}, missing packets ${c.missing_packets}, wrong sizes ${c.wrong_sizes}; plays again`);
}
{
    // The stream turns its sign exactly where packets are missing: a step of 1600 would be the click.
    const board = fresh();
    board.select(1);
    playing(board);
    board.sof();
    board.run(1);
    board.stream(20, () => new Array(channels).fill(-level));
    let before = board.frames[0].frame[0], most = 0;
    for (const { frame } of board.frames) most = Math.max(most, Math.abs(frame[0] - before)), (before = frame[0]);
    check(before === -level && most <= (2 * level) / 64 + 1, `a missing packet: a step of ${most}`);
    const c = counters(board);
    check(c.missing_packets === 1 && c.underruns === 0, `a missing packet: ${JSON.stringify(c)}`);
    say(`a missing packet fades: no step above ${most}, counted`);
}
{
    const board = fresh();
    board.select(1);
    const most = () => Math.max(...board.frames.flatMap(({ frame }) => frame).map(Math.abs));
    const square = (n) => new Array(channels).fill(n % 48 < 24 ? 20000 : -20000);
    board.stream(150, square);
    board.frames = [];
    board.stream(5, square);
    check(most() === 20000, `full scale with GP9 tied: ${most()}`);
    board.tieCeiling(false);
    board.stream(2, square); // a tile, and what the pins hold
    board.frames = [];
    board.stream(20, square);
    check(most() === 5000, `GP9's wire falls out: ${most()} after 2 ms`);
    board.tieCeiling(true);
    board.frames = [];
    board.stream(95, square);
    check(most() === 5000, `GP9 is tied again: ${most()} within 95 ms`);
    board.stream(150, square);
    board.frames = [];
    board.stream(2, square);
    check(most() === 20000, `GP9 is tied again: ${most()}`);
    say("GP9's wire falls out: a quarter of it within 2 ms; tied again: as before, not sooner than 95 ms");
}
// Waits that never come true: the chip restarts, and plays then.
for (const [what, isNewChip, spoil, wait] of [
    ["the output's queue never fills", false, (board) => Object.defineProperty(board.pio.machines[0], 'fifoStat', { get: () => 0 }), () => {}],
    ['an endpoint is never aborted', true, (board) => {
        const write = board.usb.writeUint32.bind(board.usb);
        board.usb.writeUint32 = (offset, value) => { if (offset !== 0x60) write(offset, value); };
    }, (board) => { board.enumerate(); board.select(1); playing(board); board.select(0); }],
]) {
    const board = new Board(image, channels, { isNewChip });
    spoil(board);
    wait(board);
    check(board.until(() => board.restarts > 0, 100), `${what}: it waits for ever`);
    check(!board.amplifierIsOn, `${what}: the amplifiers are on`);
    board.enumerate();
    board.frames = [];
    board.select(1);
    playing(board);
    check(board.select(0), 'alternate setting 0');
    board.run(8);
    check(board.select(1), 'alternate setting 1');
    playing(board);
    check(counters(board).restarts === 1, `${what}: the restart is not counted`);
    say(`${what}: restarts, counts it, plays`);
}
{
    const board = fresh();
    for (let k = 0; k < +toggles; ++k) {
        check(board.select(1), `alternate setting 1, time ${k}`);
        if (k % 10 === 0) board.stream(5, loud);
        check(board.select(0), `alternate setting 0, time ${k}`);
    }
    check(board.select(1), 'alternate setting 1');
    playing(board);
    say(`alternate settings toggled ${toggles} times: plays; ${board.ask('counters')}`);
}
{
    const board = fresh();
    const descriptors = (b) => [[0x0100, 18], [0x0200, 320], [0x0301, 64], [0x0302, 64]].map(([value, n]) => b.control(setup(0x80, 6, value, 0, n))).join(' ');
    const before = descriptors(board);
    const types = [0x00, 0x80, 0x01, 0x81, 0x02, 0x82, 0x21, 0xa1, 0x22, 0xa2, 0x40, 0xc0];
    // Half are any bytes; half are what a host may ask, with one field altered in every second one.
    const known = [[0x80, 6, 0x0100, 0, 18], [0x80, 6, 0x0200, 0, 320], [0x80, 6, 0x0302, 0x0409, 64], [0x80, 0, 0, 0, 2], [0x82, 0, 0, 1, 2], [0x80, 8, 0, 0, 1],
        [0x81, 10, 0, 1, 1], [0, 9, 1, 0, 0], [0, 9, 0, 0, 0], [1, 11, 0, 1, 0], [1, 11, 1, 1, 0], [2, 1, 0, 1, 0], [2, 3, 0, 0x81, 0], [0xa1, 1, 0x0100, 0x0400, 4],
        [0xa1, 2, 0x0100, 0x0400, 14], [0xa1, 1, 0x0200, 0x0400, 1], [0x21, 1, 0x0100, 0x0400, 4], [0xa1, 2, 0x0201, 0x0200, 8], [0xa1, 1, 0x0102, 0x0200, 1],
        [0x21, 1, 0x0203, 0x0200, 2], [0x21, 1, 0x0100, 0x0200, 1], [0xa1, 0x21, 0, 2, 7], [0x21, 0x20, 0, 2, 7], [0x21, 0x22, 3, 2, 0]];
    const any = (few) => (random(2) ? random(few) : random(256));
    const request = () => {
        if (random(2))
            return [random(8) ? types[random(types.length)] : random(256), any(14), any(16) | (any(6) << 8), any(5) | (any(5) << 8), random(3) ? random(20) : random(300)];
        const words = [...known[random(known.length)]];
        if (random(2)) words[random(5)] ^= 1 << random(10);
        return words.map((word, k) => (k < 2 ? word & 255 : word));
    };
    let refused = 0, above = 0;
    for (let k = 0; k < +requests; ++k) {
        const words = request(), length = words[4];
        if (board.control(setup(...words), Uint8Array.from({ length }, () => random(256))) === null) ++refused;
        if (k % 10 === 0) board.control(setup(0, 9, 1, 0, 0)); // one of them may have left it without a configuration
        if (k % 100 === 0) board.select(1), board.stream(2, loud);
        for (const { frame } of board.frames) if (!frame.every((v) => v >= 0 && v <= level)) ++above;
        board.frames = [];
    }
    check(above === 0, `${above} frames above what was sent`);
    check(refused > requests / 5 && refused < (4 * requests) / 5, `${refused} of ${requests} requests are refused`);
    board.run(10);
    board.resetBus();
    board.enumerate();
    for (let channel = 0; channel <= channels; ++channel) {
        check(board.control(setup(0x21, 1, 0x0100 | channel, 0x0200, 1), new Uint8Array(1)) !== null, 'mute');
        check(board.control(setup(0x21, 1, 0x0200 | channel, 0x0200, 2), new Uint8Array(2)) !== null, 'volume');
    }
    board.ask('silence off');
    board.select(1);
    playing(board);
    check(counters(board).restarts === 0, 'the watchdog restarted it');
    check(descriptors(board) === before, 'a request has changed a descriptor');
    say(`${requests} random control requests: ${refused} refused, ${requests - refused} answered, none hangs, no sample above; plays again`);
}
{
    const board = fresh();
    const volume = board.control(setup(0xa1, 2, 0x0201, 0x0200, 8));
    check(volume !== null && volume.length === 8, 'range of the volume');
    const clock = board.control(setup(0xa1, 1, 0x0100, 0x0400, 4));
    check(clock !== null && new DataView(clock.buffer).getUint32(0, true) === 48000, 'clock');
    board.select(1);
    playing(board);
    check(board.control(setup(0x21, 1, 0x0202, 0x0200, 2), Uint8Array.from([0x00, 0xf4])) !== null, 'volume of channel 2'); // -12 dB
    board.stream(30, loud);
    const { frame } = board.frames.at(-1);
    check(Math.abs(frame[1] / frame[0] - 10 ** (-12 / 20)) < 0.002, `volume: ${frame}`);
    say('volume of one channel: -12 dB at its pins, the others stay');
}
{
    const board = fresh({ lowCeiling: true });
    board.select(1);
    board.stream(300, () => Array.from({ length: channels }, () => random(65536) - 32768));
    const most = Math.max(...board.frames.flatMap(({ frame }) => frame).filter((v) => !Number.isNaN(v)).map(Math.abs));
    check(most <= 8191 && most > 7000, `noise with a low ceiling: ${most}`);
    say(`noise at full scale with the ceiling at 8191: at most ${most}`);
}
// An endless loop in the place of code in RAM.
const hang = (board, address) => board.mcu.sramView.setUint16((address & ~1) - 0x20000000, 0xe7fe, true);
{
    const board = fresh();
    board.select(1);
    const since = playing(board);
    check(board.until(() => board.mcu.core.waiting, 1), 'the main loop does not sleep');
    hang(board, board.mcu.core.PC);
    silence(board, since, 'the main loop hangs');
    check(board.until(() => board.restarts > 0, 200), 'the watchdog does not act');
    say(`and restarts ${((board.now - since) / 1e6).toFixed(0)} ms after it`);
    board.enumerate();
    board.select(1);
    playing(board);
    check(counters(board).restarts === 1, 'the restart is not counted');
    say('plays again, and has counted the restart');
    // What the host turned down and does not turn down again, and silence, hold across the next two.
    check(board.control(setup(0x21, 1, 0x0200, 0x0200, 2), Uint8Array.from([0x00, 0xe2])) !== null, 'volume'); // -30 dB
    check(board.control(setup(0x21, 1, 0x0102, 0x0200, 1), Uint8Array.from([1])) !== null, 'mute of channel 2');
    const again = () => {
        check(board.until(() => board.mcu.core.waiting, 1), 'the main loop does not sleep');
        hang(board, board.mcu.core.PC);
        const before = board.restarts;
        check(board.until(() => board.restarts > before, 200), 'the watchdog does not act');
        board.enumerate();
        board.select(1);
        board.stream(130, loud);
        return board.frames.at(-1).frame;
    };
    const quiet = again();
    check(quiet.every((v, j) => v === (j === 1 ? 0 : Math.floor(level * 10 ** (-30 / 20)))), `-30 dB and a mute before a restart: ${quiet}`);
    board.ask('silence on');
    check(again().every((v) => v === 0) && board.ask('counters').startsWith('silenced'), 'silence before a restart is lifted by it');
    board.ask('silence off');
    board.stream(130, loud);
    check(board.frames.at(-1).frame.join() === quiet.join(), `silence off: ${board.frames.at(-1).frame}`);
    board.resetBus();
    board.past = board.now;
    board.powerOn(); // without power they are gone
    board.enumerate();
    board.select(1);
    playing(board);
    say('volume, mute and silence hold across a restart by the watchdog; without power they end');
}
{
    const board = fresh();
    board.select(1);
    const since = playing(board);
    check(board.until(() => board.exception === 16 + 11, 1), 'no interrupt of the output');
    hang(board, board.mcu.core.PC);
    check(board.until(() => board.restarts > 0, 20), 'the watchdog does not act');
    const ms = (board.now - since) / 1e6;
    check(ms <= 5 && !board.amplifierIsOn, `the watchdog acts after ${ms.toFixed(2)} ms`);
    say(`the output's interrupt hangs: the watchdog restarts the chip after ${ms.toFixed(2)} ms`);
}
