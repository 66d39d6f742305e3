// SPDX-License-Identifier: MIT
// One instance of the WebAssembly module: memory, texts, structures, and errors as exceptions. Works with WebAssembly alone, since an AudioWorklet has
// neither TextDecoder nor fetch.
import { names, words } from './names.js';

const unknown = -1.0e300; // PHYSVIB_UNKNOWN

/** What was wrong, in the library's own line. `code` is one of PHYSVIB_ERROR_... */
export class PhysVibError extends Error {
    constructor(code, line) {
        super(line);
        this.name = 'PhysVibError';
        this.code = code;
    }
}

const wrong = line => new PhysVibError(-2, line); // PHYSVIB_ERROR_ARGUMENT
const decode = bytes => (globalThis.TextDecoder ? new TextDecoder().decode(bytes)
    : decodeURIComponent(Array.from(bytes, byte => `%${byte.toString(16).padStart(2, '0')}`).join('')));
const encode = text => (globalThis.TextEncoder ? new TextEncoder().encode(text)
    : Uint8Array.from(unescape(encodeURIComponent(text)), letter => letter.charCodeAt(0)));

const numberOf = (name, value) => {
    const known = words[name]?.get(value);
    if (known !== undefined) return known;
    if (typeof value === 'boolean') return Number(value);
    if (typeof value === 'number' && !Number.isNaN(value)) return value;
    throw wrong(`${name}: expected ${words[name] ? [...words[name].keys()].join(', ') : 'a number'}, found ${String(value)}`);
};

const bytesOf = ({ kind }) => (kind === 'i' ? 4 : 8);

export class Module {
    #memory; #view; #broken = null; #structures = new Map();

    /** `compiled`: a WebAssembly.Module of physvib.wasm. */
    constructor(compiled) {
        this.compiled = compiled;
        const fail = at => { throw this.#broken = new PhysVibError(-8, this.text(at)); }; // an exception of C++: there is no way back into it
        const system = new Proxy({}, { get: () => () => 52 }); // of a system that has nothing: "not supported"
        const instance = new WebAssembly.Instance(compiled, { physvib: { fail }, wasi_snapshot_preview1: system });
        this.lib = instance.exports;
        this.#memory = this.lib.memory;
        this.lib._initialize();
        this.#readMembers();
    }

    #readMembers() {
        const of = new Map(), entryBytes = 16;
        for (let at = this.lib.js_members(), members = new Map(); this.view.getUint32(at, true) !== 0; at += entryBytes) {
            const [name, place, kind, count] = [0, 4, 8, 12].map(i => this.view.getUint32(at + i, true)), text = this.text(name);
            if (kind !== 0) {
                members.set(text, { at: place, kind: String.fromCharCode(kind), count });
                continue;
            }
            of.set(text, { size: place, members });
            members = new Map();
        }
        for (const [structure, { size, members }] of of) {
            const table = new Map();
            for (const [c, js] of Object.entries(names[structure])) table.set(js, members.get(c));
            this.#structures.set(structure, { size, members: table });
        }
    }

    /** A view ends when memory grows: ask for it at each use. */
    get view() {
        if (this.#view?.buffer !== this.#memory.buffer) this.#view = new DataView(this.#memory.buffer);
        return this.#view;
    }
    bytes(at, count) { return new Uint8Array(this.#memory.buffer, at, count); }
    floats(at, count) { return new Float32Array(this.#memory.buffer, at, count); }
    doubles(at, count) { return new Float64Array(this.#memory.buffer, at, count); }
    get memoryBytes() { return this.#memory.buffer.byteLength; }

    text(at) {
        const all = new Uint8Array(this.#memory.buffer);
        return decode(all.slice(at, all.indexOf(0, at)));
    }

    /** A function of the module, whatever it returns. */
    run(name, ...values) {
        if (this.#broken) throw new PhysVibError(-8, `this instance has ended: ${this.#broken.message}`);
        try {
            return this.lib[name](...values);
        } catch (error) {
            this.#broken ??= error;
            throw error instanceof PhysVibError ? error : new PhysVibError(-8, `internal: ${error.message}`);
        }
    }

    /** One that returns a code or a count: an error is thrown. */
    check(name, ...values) {
        const result = this.run(name, ...values);
        if (result < 0) this.refuse(Number(result));
        return result;
    }
    /** Throws what was wrong with the last call. */
    refuse(code = -2) { throw new PhysVibError(code, this.text(this.lib.physvib_error())); }
    call(name, ...values) { return this.check(`physvib_${name}`, ...values); }

    room(bytes) {
        const at = this.run('malloc', Math.max(1, bytes)) >>> 0;
        if (at === 0) throw new PhysVibError(-5, 'memory: expected more of it');
        return at;
    }
    free(at) { if (!this.#broken) this.lib.free(at); }

    /** What `use(at)` returns, of so many bytes of memory that it may use meanwhile. */
    borrow(bytes, use) {
        const at = this.room(bytes);
        try { return use(at); } finally { this.free(at); }
    }
    withBytes(bytes, use) {
        return this.borrow(bytes.length + 1, at => {
            const room = this.bytes(at, bytes.length + 1);
            room.set(bytes);
            room[bytes.length] = 0;
            return use(at, bytes.length);
        });
    }
    withText(text, use) { return this.withBytes(encode(String(text)), use); }

    sizeOf(structure) { return this.#structures.get(`physvib_${structure}`).size; }
    placeOf(structure, name) { return this.#structures.get(`physvib_${structure}`).members.get(name).at; }

    /** Those of `values` that are there; null is PHYSVIB_UNKNOWN. */
    put(structure, at, values) {
        const { members } = this.#structures.get(`physvib_${structure}`);
        for (const name in values) {
            const value = values[name], member = members.get(name);
            if (value === undefined) continue;
            if (member === undefined) throw wrong(`${name}: expected one of ${[...members.keys()].join(', ')}`);
            if (member.count === 1) this.#write(name, member, at + member.at, value);
            else this.#writeAll(name, member, at + member.at, value);
        }
    }
    #writeAll(name, member, at, values) {
        if (typeof values?.length !== 'number' || values.length > member.count) throw wrong(`${name}: expected at most ${member.count} numbers`);
        for (let i = 0; i < values.length; ++i) this.#write(name, member, at + bytesOf(member) * i, values[i]);
    }
    #write(name, { kind }, at, value) {
        if (kind === 'd') return this.view.setFloat64(at, value === null ? unknown : numberOf(name, value), true);
        const number = name === 'part' && typeof value === 'string' ? this.partOf(value) : numberOf(name, value);
        if (kind === 'l') {
            if (!Number.isFinite(number)) throw wrong(`${name}: expected whole nanoseconds, found ${number}`);
            return this.view.setBigInt64(at, BigInt(Math.round(number)), true);
        }
        if (!Number.isInteger(number) || Math.abs(number) > 0x7fffffff) throw wrong(`${name}: expected a whole number, found ${number}`);
        return this.view.setInt32(at, number, true);
    }

    get(structure, at) {
        const values = {}, { view } = this;
        for (const [name, { at: place, kind, count }] of this.#structures.get(`physvib_${structure}`).members) {
            const from = at + place;
            if (count > 1 && kind === 'i') values[name] = Array.from({ length: count }, (_, i) => view.getInt32(from + 4 * i, true));
            else if (count > 1) values[name] = Array.from(this.doubles(from, count));
            else if (kind === 'd') values[name] = view.getFloat64(from, true);
            else if (kind === 'l') values[name] = Number(view.getBigInt64(from, true));
            else if (kind === 'i') values[name] = view.getInt32(from, true);
        }
        return values;
    }

    /** The number of a part of a body by its name; '': none. */
    partOf(name) { return name === '' ? 0 : this.withText(name, text => this.call('part', text)); }

    /** `use(at)` of a structure as its _init has it, with `values`. */
    filled(structure, values, use) {
        const size = this.sizeOf(structure);
        return this.borrow(size, at => {
            this.call(`${structure}_init`, at, size);
            this.put(structure, at, values);
            return use(at, size);
        });
    }

    /** Structures of zeros that say their size. */
    begin(structure, at, count = 1) {
        const size = this.sizeOf(structure);
        this.bytes(at, count * size).fill(0);
        for (let i = 0; i < count; ++i) this.view.setUint32(at + i * size, size, true);
    }

    handleOf(create) {
        return this.borrow(4, at => {
            create(at);
            return this.view.getUint32(at, true);
        });
    }

    withEvents(events, use) {
        const size = this.sizeOf('event');
        return this.borrow(events.length * size, at => {
            this.begin('event', at, events.length);
            for (let i = 0; i < events.length; ++i) {
                this.put('event', at + i * size, events[i]);
                if (events[i].fixture === undefined) this.put('event', at + i * size, { fixture: -1 });
                if (events[i].other === undefined) this.put('event', at + i * size, { other: -1 });
            }
            return use(at, events.length);
        });
    }
    eventsAt(at, count) {
        const events = [], size = this.sizeOf('event');
        for (let i = 0; i < count; ++i) {
            const event = this.get('event', at + i * size);
            event.kind = ['hit', 'roll', 'slide'][event.kind];
            events.push(event);
        }
        return events;
    }
}
