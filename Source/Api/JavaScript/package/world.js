// SPDX-License-Identifier: MIT
// World, which turns reported motions and contacts into events.
import { inWords, naming, notes } from './explanation.js';
import { PhysVibError } from './module.js';
import { Renderer } from './renderer.js';
import { withSettings } from './settings.js';

const eventsAtOnce = 64;

export class World {
    #module; #name; #contact; #contactBytes; #room; #journal = { at: 0, length: 0 }; #forget;

    constructor(module, registry, { fieldHeight, ...settings } = {}) {
        this.#module = module;
        this.fieldWidth = settings.fieldWidth ?? 1;
        this.fieldHeight = fieldHeight ?? this.fieldWidth;
        this.#name = naming('fieldHeight', () => module.filled('world_settings', settings, at => module.handleOf(to => module.call('world_create', at, to))));
        this.#contactBytes = module.sizeOf('contact');
        const name = this.#name, journal = this.#journal, contact = this.#contact = module.room(this.#contactBytes), room = this.#room = module.room(eventsAtOnce * module.sizeOf('event'));
        this.#forget = registry(this, () => {
            module.call('world_free', name);
            module.free(contact);
            module.free(room);
            if (journal.at) module.free(journal.at);
        });
    }

    configure({ fieldHeight, ...settings }) {
        this.#module.filled('world_settings', settings, at => this.#module.call('world_configure', this.#name, at));
        this.fieldWidth = settings.fieldWidth ?? 1;
        this.fieldHeight = fieldHeight ?? this.fieldWidth;
    }

    setBody(body, values = {}) { this.#module.filled('body', values, at => this.#module.call('world_set_body', this.#name, body, at)); }
    setMass(body, massKg) { this.#module.call('world_set_mass', this.#name, body, massKg); }
    deviceOf(body) { return this.#module.call('world_device', this.#name, body); }
    removeBody(body) { this.#module.call('world_remove_body', this.#name, body); }
    move(body, x, y, vx, vy, spin = 0) { this.#module.call('world_move', this.#name, body, x, y, vx, vy, spin); }
    moved(body, vx, vy, spin = 0) { this.#module.call('world_moved', this.#name, body, vx, vy, spin); }
    moveInSpace(body, centre, velocity, spin = [0, 0, 0], inverseInertia = null) {
        this.#withNumbers([centre, velocity, spin], inverseInertia, at => this.#module.call('world_move_in_space', this.#name, body, ...at));
    }
    movedInSpace(body, velocity, spin = [0, 0, 0]) {
        this.#withNumbers([velocity, spin], null, at => this.#module.call('world_moved_in_space', this.#name, body, ...at.slice(0, 2)));
    }
    pair(surface, other, { frequencyHz, decayPerSecond, gain = 1 }) { this.#module.call('world_pair', this.#name, surface, other, frequencyHz, decayPerSecond, gain); }

    beginStep(seconds, gravity = 9.81) { this.#module.call('world_begin_step', this.#name, seconds, gravity); }
    endStep() { this.#module.call('world_end_step', this.#name); }
    step(seconds, gravity, contacts) {
        this.beginStep(seconds, gravity);
        try { contacts?.(); } finally { this.endStep(); }
    }

    /** `use` of the places in memory of vectors and of a matrix; null: none. */
    #withNumbers(vectors, matrix, use) {
        const module = this.#module, lists = [...vectors.map(vector => [vector, 3]), [matrix, 6]];
        module.borrow(8 * 15, from => {
            const places = [];
            let at = from;
            for (const [list, count] of lists) {
                if (list === null) { places.push(0); continue; }
                if (list?.length !== count) throw new PhysVibError(-2, `motion: expected lists of ${count} numbers`);
                module.doubles(at, count).set(list);
                places.push(at);
                at += 8 * count;
            }
            use(places);
        });
    }

    #tell(call, a, b, contact) {
        this.#module.call('contact_init', this.#contact, this.#contactBytes);
        this.#module.put('contact', this.#contact, contact);
        this.#module.put('contact', this.#contact, { a, b });
        this.#module.call(call, this.#name, this.#contact);
    }
    touch(a, b, contact = {}) { this.#tell('world_touch', a, b, contact); }
    begin(a, b, contact = {}) { this.#tell('world_begin', a, b, contact); }
    push(a, b, contact = {}) { this.#tell('world_push', a, b, contact); }
    end(a, b) { this.#module.call('world_end', this.#name, a, b); }

    /** Reports a Journal's entries of this step and skips invalid ones; returns the first of these, { body, line }, or null. */
    observe(numbers) {
        const { length } = numbers, module = this.#module;
        if (length > this.#journal.length) {
            if (this.#journal.at) module.free(this.#journal.at);
            Object.assign(this.#journal, { at: 0, length: 0 });
            Object.assign(this.#journal, { at: module.room(8 * 2 * length), length: 2 * length });
        }
        module.doubles(this.#journal.at, length).set(numbers);
        const body = module.check('js_observe', this.#name, this.#journal.at, length) - 1;
        return body < 0 ? null : { body, line: module.text(module.run('js_text')) };
    }

    get timeNs() { return Number(this.#module.call('world_time_ns', this.#name)); }
    take(atOnce = false) {
        const all = [];
        for (;;) {
            this.#module.begin('event', this.#room);
            const count = Number(this.#module.call('world_take', this.#name, this.#room, BigInt(eventsAtOnce), atOnce ? 1 : 0));
            all.push(...this.#module.eventsAt(this.#room, count));
            if (count < eventsAtOnce) return all;
        }
    }
    send(renderer, laterNs = 0, atOnce = false) { return Number(this.#module.call('world_send', this.#name, renderer.name, BigInt(Math.round(laterNs)), atOnce ? 1 : 0)); }

    get drops() { return Number(this.#module.call('world_drops', this.#name)); }
    get thinned() { return Number(this.#module.call('world_thinned', this.#name)); }
    get counts() {
        return this.#module.filled('world_counts', {}, at => {
            this.#module.call('world_get_counts', this.#name, at);
            return this.#module.get('world_counts', at);
        });
    }
    /** `output`: a renderer that plays the events, one of physvib/audio, or what is known of another. */
    explain(output) {
        const most = 512, module = this.#module, { settings, ...facts } = output?.facts ?? output ?? {}, hint = output?.hint?.();
        return module.borrow(most, at => {
            const tell = renderer => module.filled('output_facts', { ...facts, renderer }, told => module.call('world_explain_output', this.#name, told, at, most));
            if (output === undefined) module.call('world_explain', this.#name, at, most);
            else if (output instanceof Renderer) module.call('renderer_explain', output.name, this.#name, at, most);
            else if (settings) withSettings(module, settings, tell);
            else tell();
            const said = inWords(module.text(at));
            return (hint ? `${hint} ` : '') + (output?.measured?.(said) ?? said);
        });
    }
    note(body, note) { this.#module.call('world_note', this.#name, body, notes.indexOf(note)); }

    free() { this.#forget(); }
}
