// SPDX-License-Identifier: MIT
// The Pico's image in rp2040js, an emulator written by others, with what is around the chip: a USB host, and I2S
// amplifiers that read the pins. Time is simulated; nothing depends on how fast this runs.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
const { RP2040, ConsoleLogger, LogLevel } = await import(pathToFileURL(process.env.RP2040JS + '/dist/esm/index.js'));

const clockHz = 76.8e6, cyclesPerStep = 25, cycleNs = 1e9 / clockHz;
const pins = { data: [2, 3, 4, 5], bit: 6, word: 7, amplifier: 8, ceiling: 9 };
const dmaException = 16 + 11, usbException = 16 + 5;

export const setup = (type, request, value, index, length) =>
    Uint8Array.from([type, request, value & 255, value >> 8, index & 255, index >> 8, length & 255, length >> 8]);

export class Board {
    constructor(image, channels, { lowCeiling = false, isNewChip = false } = {}) {
        Object.assign(this, { channels, lines: channels / 2, image: readFileSync(image), lowCeiling, isNewChip });
        this.frames = []; // what the amplifiers have read: { at (ns), frame }
        this.worst = { dma: 0, usb: 0 };
        this.busy = 0;
        this.restarts = this.past = 0;
        this.powerOn();
    }

    // A restart by the watchdog keeps its scratch registers and nothing else.
    powerOn(scratch) {
        this.mcu = new RP2040();
        const { mcu } = this;
        mcu.clkSys = clockHz;
        mcu.logger = new ConsoleLogger(LogLevel.Error);
        mcu.logger.error = (name, text) => { throw new Error(`${name}: ${text}`); };
        mcu.flash.set(this.image, 0);
        this.bootRom();
        mcu.core.SP = 0x20041f00; // as the ROM leaves it
        mcu.core.PC = 0x10000000;
        const watchdog = mcu.peripherals[0x40058];
        if (scratch) watchdog.scratchData.set(scratch), (watchdog.reason = 1);
        watchdog.onWatchdogTrigger = () => {
            watchdog.alarm.enable = false; // the emulator's would ring again in the same instant
            this.isRestarting = true;
        };
        this.pio = mcu.pio[0];
        this.pio.run = () => {}; // stepped here, by its clock divider
        this.pio.step = () => { // the emulator's steps machines that are not enabled yet, too
            for (const machine of this.pio.machines) if (machine.enabled) machine.step();
            this.pio.checkChangedPins();
        };
        this.tieCeiling(!this.lowCeiling);
        if (this.isNewChip) mcu.peripherals[0x40000].readUint32 = (offset) => (offset === 0 ? 0x20002927 : 2); // B2, whose endpoints can be aborted
        this.poweredAt = this.now;
        this.stepCycles = 0;
        this.host();
        this.amplifiers();
    }

    // The ROM is not in the package. The image asks it only for functions of the flash, which do nothing here.
    bootRom() {
        const rom = new DataView(this.mcu.bootrom.buffer);
        rom.setUint16(0x14, 0x30, true);
        rom.setUint16(0x18, 0x41, true);
        [0x4800, 0x4770, 0x0049, 0x0000, 0x4770].forEach((code, k) => rom.setUint16(0x40 + 2 * k, code, true)); // ldr r0, =0x49; bx lr; bx lr
    }

    // The wire from GP9 to ground.
    tieCeiling(isTied) { this.mcu.gpio[pins.ceiling].setInputValue(!isTied); }
    get now() { return this.past + this.mcu.clock.nanos; } // ns since power-on
    pin(number) { return this.mcu.gpio[number].value; }
    get amplifierIsOn() { return this.pin(pins.amplifier) === 1; }

    step() {
        const { mcu } = this, { core, clock } = mcu;
        let cycles = 1;
        if (core.waiting) {
            cycles = cyclesPerStep - this.stepCycles;
        } else {
            cycles = core.executeInstruction();
            this.count(core.IPSR, cycles);
        }
        clock.tick(cycles * cycleNs);
        this.stepCycles += cycles;
        for (; this.stepCycles >= cyclesPerStep; this.stepCycles -= cyclesPerStep) this.pio.step();
        if (!this.isRestarting) return;
        this.isRestarting = false;
        ++this.restarts;
        this.past = this.now;
        this.powerOn(mcu.peripherals[0x40058].scratchData);
    }
    count(exception, cycles) {
        this.busy += cycles;
        if (exception !== this.exception) {
            if (this.exception === dmaException) this.worst.dma = Math.max(this.worst.dma, this.spent);
            if (this.exception === usbException) this.worst.usb = Math.max(this.worst.usb, this.spent);
            this.exception = exception;
            this.spent = 0;
        }
        this.spent += cycles;
    }
    run(ms) { this.until(() => false, ms); }
    // False: it has not come true within that time.
    until(isTrue, ms) {
        const end = this.now + ms * 1e6;
        while (this.now < end) {
            if (isTrue()) return true;
            for (let k = 0; k < 20; ++k) this.step();
        }
        return isTrue();
    }

    amplifiers() {
        const { mcu } = this, { gpio } = mcu;
        let words = new Array(this.lines).fill(0), bits = 0, wordClock = 0, frame = new Array(this.channels).fill(0);
        gpio[pins.bit].addListener((state, before) => {
            if (state !== 1 || before === 1) return;
            for (let line = 0; line < this.lines; ++line)
                words[line] = ((words[line] << 1) | (gpio[pins.data[line]].value === 1 ? 1 : 0)) & 0xffff;
            ++bits;
            const side = gpio[pins.word].value;
            if (side === wordClock) return;
            // The word clock has changed: this was the last bit of the channel before.
            const whole = bits === 16;
            words.forEach((word, line) => { frame[2 * line + wordClock] = whole ? (word << 16) >> 16 : NaN; });
            if (wordClock === 1) {
                this.frames.push({ at: this.now, frame });
                frame = new Array(this.channels).fill(0);
            }
            wordClock = side;
            bits = 0;
        });
    }

    host() {
        const usb = this.mcu.usbCtrl;
        this.usb = usb;
        Object.assign(this, { armed: {}, inPackets: { 0: [] }, stalled: false, wasReset: false, feedback: null });
        usb.onUSBEnabled = () => usb.resetDevice();
        usb.onResetReceived = () => { this.wasReset = true; };
        usb.onEndpointRead = (endpoint, length) => { this.armed[endpoint] = length; };
        usb.onEndpointWrite = (endpoint, data) => {
            (this.inPackets[endpoint] ??= []).push(data);
        };
        // The emulator takes what is armed at once. On the chip, the endpoints of the stream stay armed until the host comes: for
        // feedback once in a millisecond, for a packet when it sends one; or until the image disarms them.
        const available = 1 << 10, full = 1 << 15, inControl = 0x88, outControl = 0x8c;
        const control = (offset) => this.mcu.usbDPRAMView.getUint32(offset, true);
        const setControl = (offset, value) => this.mcu.usbDPRAMView.setUint32(offset, value, true);
        const ready = usb.indicateBufferReady.bind(usb), updated = usb.DPRAMUpdated.bind(usb), finish = usb.finishRead.bind(usb);
        const isEnabled = (out) => (usb.readEndpointControlReg(1, out) & (1 << 31)) !== 0;
        let feedback = null;
        const asked = this.mcu.clock.createAlarm(() => {
            if (!isEnabled(false)) return; // the chip does not answer for an endpoint that is off
            setControl(inControl, control(inControl) & ~(available | full));
            this.feedback = feedback;
            this.feedbackBytes = control(inControl) & 0x3ff;
            ready(1, false);
        });
        this.forget = () => { asked.cancel(); this.armed = {}; };
        usb.DPRAMUpdated = (offset, value) => {
            const isArmed = (value & available) !== 0;
            if (offset === inControl) {
                const at = usb.getEndpointBufferOffset(1, false);
                feedback = this.mcu.usbDPRAMView.getUint32(at, true);
                if (isArmed) asked.schedule(1e6);
                else asked.cancel();
            } else if (offset === outControl) {
                this.armed[1] = isArmed ? value & 0x3ff : undefined;
            } else {
                updated(offset, value);
            }
        };
        usb.finishRead = (endpoint, buffer) => {
            if (endpoint === 1 && !(isEnabled(true) && control(outControl) & available)) return; // disarmed meanwhile: the packet is lost
            if (endpoint === 1) setControl(outControl, control(outControl) & ~available);
            finish(endpoint, buffer);
        };
        const write = usb.writeUint32.bind(usb);
        usb.writeUint32 = (offset, value) => {
            if (offset === 0x68 && value !== 0) this.stalled = true;
            write(offset, value);
        };
    }

    // A control transfer. Null: refused, or no answer within 20 ms.
    control(packet, data = new Uint8Array(0)) {
        const length = packet[6] | (packet[7] << 8), isIn = (packet[0] & 0x80) !== 0 && length > 0;
        this.inPackets[0] = [];
        this.armed[0] = undefined;
        this.stalled = false;
        this.usb.epStallArm = 0;
        this.usb.sendSetupPacket(packet);
        const wait = (isTrue) => {
            const isAnswered = this.until(() => this.stalled || isTrue(), 20);
            if (this.stalled) this.run(0.05); // the chip refuses both directions, one after the other
            return isAnswered && !this.stalled;
        };
        if (isIn) {
            const got = [];
            for (;;) {
                if (!wait(() => this.inPackets[0].length > 0)) return null;
                const part = this.inPackets[0].shift();
                got.push(...part);
                if (part.length < 64 || got.length >= length) break;
            }
            if (!wait(() => this.armed[0] !== undefined)) return null;
            this.usb.endpointReadDone(0, new Uint8Array(0));
            this.run(0.05);
            return Uint8Array.from(got);
        }
        for (let at = 0; at < length; at += 64) {
            if (!wait(() => this.armed[0] !== undefined)) return null;
            this.armed[0] = undefined;
            this.usb.endpointReadDone(0, data.subarray(at, at + 64));
        }
        return wait(() => this.inPackets[0].length > 0) ? new Uint8Array(0) : null;
    }

    // Address, descriptors, configuration; stops with an error where a host would. macOS asks for a text first.
    enumerate({ asMac = false } = {}) {
        const need = (what, answer) => { if (answer === null) throw new Error(`refused: ${what}`); return answer; };
        if (!this.until(() => this.wasReset, 100)) throw new Error('the board does not appear on the bus');
        const device = need('device descriptor', this.control(setup(0x80, 6, 0x0100, 0, 18)));
        need('address', this.control(setup(0, 5, 7, 0, 0)));
        if (asMac) need('name', this.control(setup(0x80, 6, 0x0302, 0x0409, 255)));
        const head = need('configuration', this.control(setup(0x80, 6, 0x0200, 0, 9)));
        const configuration = need('configuration', this.control(setup(0x80, 6, 0x0200, 0, head[2] | (head[3] << 8))));
        need('set configuration', this.control(setup(0, 9, 1, 0, 0)));
        const settled = this.poweredAt + 250e6; // by then the ceiling has risen
        if (this.now < settled) this.run((settled - this.now) / 1e6);
        return { device, configuration };
    }
    // A reset of the bus: from here on no packet reaches what was armed.
    resetBus() {
        this.wasReset = false;
        this.forget();
        this.signal(1 << 19);
    }
    suspend() { this.signal(1 << 4); this.usb.sieStatus &= ~(1 << 4); }
    resume() { this.signal(1 << 11); }
    signal(bit) { this.usb.sieStatus |= bit; this.usb.sieStatusUpdated(); }
    select(alternate) { return this.control(setup(1, 11, alternate, 1, 0)) !== null; }
    // A millisecond of the bus begins; they are numbered.
    sof() { this.usb.sofFrameNumber = (this.usb.sofFrameNumber + 1) & 0x7ff; }
    get isWaitingForPacket() { return this.armed[1] !== undefined; }
    // One packet, if the board waits for one. Frames: arrays of samples.
    packet(bytes) {
        if (this.armed[1] === undefined) return false;
        this.armed[1] = undefined;
        this.usb.endpointReadDone(1, bytes, 5);
        return true;
    }
    pack(frames) {
        const bytes = new DataView(new ArrayBuffer(frames.length * this.channels * 2));
        frames.forEach((frame, k) => frame.forEach((v, j) => bytes.setInt16((k * this.channels + j) * 2, v, true)));
        return new Uint8Array(bytes.buffer);
    }
    // Packets of 48 frames, one a millisecond, from source(frame number).
    stream(ms, source, first = 0) {
        for (let k = 0; k < ms; ++k) {
            const frames = Array.from({ length: 48 }, (_, n) => source(first + 48 * k + n));
            const next = this.now + 1e6;
            this.sof();
            if (!this.packet(this.pack(frames))) this.notTaken = (this.notTaken ?? 0) + 1;
            this.run((next - this.now) / 1e6);
        }
    }
    // A line of text on the serial port, and the answer.
    ask(line) {
        this.inPackets[3] = [];
        this.usb.endpointReadDone(3, new TextEncoder().encode(line + '\n'));
        const text = () => this.inPackets[3].map((p) => new TextDecoder().decode(p)).join('');
        return this.until(() => text().endsWith('\n'), 50) ? text().trim() : null;
    }
}
