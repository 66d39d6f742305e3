// SPDX-License-Identifier: MIT
// PhysVib: contacts of any physics engine in, vibration on several actuators out. Units are SI; times are nanoseconds, as Numbers.
import * as files from './files.js';
import { material, materials } from './impact.js';
import { Module, PhysVibError } from './module.js';
import { Pad } from './pad.js';
import { Renderer } from './renderer.js';
import { channelsOf, lawsOf, layoutAt, withSettings } from './settings.js';
import { World } from './world.js';

export { PhysVibError, material, materials };

/** The library: one instance of the WebAssembly, one thread. Worlds and renderers go when they are freed, or collected. */
export class PhysVib {
    #module; #files; #worklet; #forgotten = new FinalizationRegistry(free => { try { free(); } catch { /* an instance that has ended */ } });

    /** `compiled`: a WebAssembly.Module of physvib.wasm, for example another instance's `module`. `files`: where files.wasm is, its bytes or module; `worklet`: the
     * text of worklet.js. Left out, both lie beside this file. */
    constructor(compiled, files, worklet) {
        this.#module = new Module(compiled);
        this.#files = files;
        this.#worklet = worklet;
    }

    /** Compiled, for workers and worklets: `new PhysVib(module)`. */
    get module() { return this.#module.compiled; }
    get version() { return this.#module.text(this.#module.run('physvib_version')); }
    get laws() { return lawsOf(this.#module); }
    get memoryBytes() { return this.#module.memoryBytes; }
    /** The text of worklet.js, or undefined: it is a file. */
    get worklet() { return this.#worklet; }

    #registry = (object, free) => {
        const token = {};
        this.#forgotten.register(object, free, token);
        return () => {
            if (this.#forgotten.unregister(token)) free();
        };
    };

    world(settings) { return new World(this.#module, this.#registry, settings); }
    renderer(settings) { return new Renderer(this.#module, this.#registry, settings); }
    /** Two motors of a game controller; physvib/gamepad plays them. */
    pad(profile, settings) { return new Pad(this.#module, this.#registry, profile, settings); }

    /** Events, in the order of their times, to samples: a Float32Array per channel. */
    render(events, { seconds, ...settings }) {
        const module = this.#module, { fieldWidth, fieldHeight } = events; // of parseEvents
        return withSettings(module, { fieldWidth, fieldHeight, ...settings }, at => {
            const frames = Math.round(seconds * module.get('renderer_settings', at).rate), channels = channelsOf(module, at);
            if (!(frames >= 0)) throw new PhysVibError(-2, 'seconds: expected a number from 0 on');
            return module.withEvents(events, (list, count) => module.borrow(4 * channels * frames, to => {
                module.call('render', at, list, BigInt(count), BigInt(frames), to);
                return Array.from({ length: channels }, (_, j) => module.floats(to + 4 * j * frames, frames).slice());
            }));
        });
    }

    /** What each actuator gets of a hit at a place of the field. */
    gains(x, y, settings = {}) {
        const module = this.#module;
        return withSettings(module, settings, at => module.borrow(64 * 8, to => Array.from(module.doubles(to, module.check('js_gains', at, x, y, to)))));
    }

    /** A preset by its name. */
    layout(name) {
        const module = this.#module;
        return module.borrow(module.sizeOf('layout'), at => {
            module.begin('layout', at);
            module.withText(name, text => module.call('layout_preset', text, at));
            return layoutAt(module, at);
        });
    }
    // Loaded when it is needed first.
    async #filesModule() { return this.#files = await compile(await this.#files ?? placeOf(filesBeside, 'files.wasm'), 'files.wasm'); }
    async parseLayout(text) { return files.parseLayout(await this.#filesModule(), text); }
    async parseEvents(text) { return files.parseEvents(await this.#filesModule(), text); }
    async eventsText(events, field) { return files.eventsText(await this.#filesModule(), events, field); }
    async wav(channels, rate = 48000) { return files.wav(await this.#filesModule(), channels, rate); }
    async readClip(data, name, { rate = 48000 } = {}) { return files.readClip(await this.#filesModule(), data, name, rate); }
    async writeClip(events, name, settings = {}) { return files.writeClip(await this.#filesModule(), events, name, settings); }

    playOutNs(rate, blockFrames, stepsPerSecond, longestGapSeconds = 0) {
        return Number(this.#module.call('play_out_ns', rate, blockFrames, stepsPerSecond, longestGapSeconds));
    }
    /** Settings as the audio worklet hands them to its own instance. */
    settingsBytes(settings) { return withSettings(this.#module, settings, (at, size) => ({ bytes: this.#module.bytes(at, size).slice(), channels: channelsOf(this.#module, at) })); }
    /** Of structures that worklets are sent, in bytes; and where in an event its time is. */
    get sizes() { return { event: this.#module.sizeOf('event'), timeAt: this.#module.placeOf('event', 'timeNs'), renderer_status: this.#module.sizeOf('renderer_status') }; }
    statusOf(bytes) { return this.#module.withBytes(bytes, at => this.#module.get('renderer_status', at)); }
    eventBytes(events) { return this.#module.withEvents(events, at => this.#module.bytes(at, events.length * this.#module.sizeOf('event')).slice()); }
}

const advice = name => `put the package's ${name} there, tell load() where it is, or import physvib/inline, which has the code inside`;
const refusal = (where, name, found) => new PhysVibError(-4, `${where}: expected the WebAssembly ${name}, ${found}: ${advice(name)}`);

// Bundlers look for `new URL('./name', import.meta.url)` in these very words, and take the file along. A script that is no module has no such address.
const codeBeside = () => new URL('./physvib.wasm', import.meta.url);
const filesBeside = () => new URL('./files.wasm', import.meta.url);
function placeOf(beside, name) {
    try { return beside(); } catch { throw refusal('import.meta.url', name, 'this script has no address'); }
}

// An address that is not whole is relative to the page, or to the script of a worker; in Node to the working folder.
function addressOf(text, name) {
    const folder = () => globalThis.process?.getBuiltinModule?.('node:url').pathToFileURL('./');
    try { return new URL(text, globalThis.document?.baseURI ?? globalThis.location?.href ?? folder()); } catch { throw refusal(text, name, 'found no address'); }
}

// Bytes of an address, or of a Response that the page has fetched.
async function bytesOf(source, name) {
    const fs = source instanceof URL && source.protocol === 'file:' && globalThis.process?.getBuiltinModule?.('node:fs/promises'); // Node's fetch takes no files
    if (fs) return fs.readFile(source).catch(error => { throw refusal(source, name, error.message); });
    const answer = source instanceof URL ? await fetch(source).catch(error => { throw refusal(source, name, `could not be fetched (${error.message})`); }) : source;
    const where = answer.url || source;
    if (!answer.ok) throw refusal(where, name, `the server answers ${answer.status}`);
    const bytes = new Uint8Array(await answer.arrayBuffer());
    if (![0x00, 0x61, 0x73, 0x6d].every((byte, i) => bytes[i] === byte)) throw refusal(where, name, `found ${answer.headers?.get('content-type') ?? 'something else'}`);
    return bytes;
}

async function compile(given, name) {
    if (given instanceof WebAssembly.Module) return given;
    const source = typeof given === 'string' ? addressOf(given, name) : await given;
    return WebAssembly.compile(source instanceof ArrayBuffer || ArrayBuffer.isView(source) ? source : await bytesOf(source, name)); // whatever type a server gives it
}

/** `source`, `files`: where physvib.wasm and files.wasm are, if not beside this file; bytes, a Response, or a WebAssembly.Module. `worklet`: the text of worklet.js. */
export async function load(source, { files, worklet } = {}) { return new PhysVib(await compile(source ?? placeOf(codeBeside, 'physvib.wasm'), 'physvib.wasm'), files, worklet); }
