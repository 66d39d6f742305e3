// SPDX-License-Identifier: MIT
// Event lists, layouts, sounds and clips, by a module of its own (files.wasm). Each file is read in a new instance, so a file that is refused
// affects nothing else.
import { Module, PhysVibError } from './module.js';
import { channelsOf, layoutAt, withSettings } from './settings.js';

/** What `use(module)` returns of an instance that is thrown away; a refusal that ends it is one of `name`. */
function apart(compiled, name, use) {
    const module = new Module(compiled);
    try {
        return use(module);
    } catch (error) {
        if (error.code !== -8) throw error;
        throw new PhysVibError(-2, error.message.startsWith(name) ? error.message : `${name}: ${error.message}`);
    }
}

const textOf = module => module.bytes(module.run('js_text'), module.run('js_text_bytes')).slice();
const bytesOf = data => (typeof data === 'string' ? new TextEncoder().encode(data) : data instanceof ArrayBuffer ? new Uint8Array(data) : data);

export const parseLayout = (compiled, text) => apart(compiled, 'layout', module => module.withText(text, from => module.borrow(module.sizeOf('layout'), to => {
    module.begin('layout', to);
    module.call('layout_parse', from, to);
    return layoutAt(module, to);
})));

export const parseEvents = (compiled, text) => apart(compiled, 'events', module => module.withText(text, from => {
    const count = Number(module.call('events_parse', from, 0, 0n));
    return module.borrow(count * module.sizeOf('event'), to => {
        if (count > 0) module.begin('event', to);
        module.call('events_parse', from, to, BigInt(count));
        return Object.assign(module.eventsAt(to, count), fieldSaid(module, from));
    });
}));

/** Of the list of that text: fieldWidth and fieldHeight; nothing, if it says none. */
const fieldSaid = (module, from) => module.borrow(16, to => {
    module.call('events_parse_field', from, to, to + 8);
    const [fieldWidth, fieldHeight] = module.doubles(to, 2);
    return fieldWidth > 0 ? { fieldWidth, fieldHeight } : {};
});

export const eventsText = (compiled, events, { fieldWidth = 0, fieldHeight = 0 } = events) => apart(compiled, 'events', module => module.withEvents(events, (at, count) => {
    module.check('js_events_text', at, count, fieldWidth, fieldHeight);
    return new TextDecoder().decode(textOf(module));
}));

/** A WAVE file: 32-bit float, as `physvib_wav_save` writes it. */
export const wav = (compiled, channels, rate) => apart(compiled, 'sound', module => {
    const count = channels.length, frames = channels[0]?.length ?? 0;
    if (!(count >= 1 && count <= 64 && frames >= 1 && frames * count * 4 < 0xffffff00 && rate >= 5000 && rate <= 192000)) {
        throw new PhysVibError(-2, 'sound: expected 1 to 64 channels, 5000 to 192000 Hz, and a frame or more, of less than 4 GB');
    }
    module.run('js_wav_head', count, rate, frames);
    const head = textOf(module), file = new Uint8Array(head.length + 4 * count * frames), view = new DataView(file.buffer, head.length);
    file.set(head);
    for (let n = 0, at = 0; n < frames; ++n) for (let j = 0; j < count; ++j, at += 4) view.setFloat32(at, channels[j][n], true);
    return file;
});

export const readClip = (compiled, data, name, rate) => apart(compiled, name, module => module.withText(name, called => module.withBytes(bytesOf(data), (at, bytes) => {
    const count = module.run('js_clip_read', at, bytes, called, rate), leftOut = new TextDecoder().decode(textOf(module)), frames = module.run('js_clip_frames');
    const channels = Array.from({ length: count }, (_, j) => module.floats(module.run('js_clip_samples', j), frames).slice());
    const places = channels.map((_, j) => [0, 1].map(axis => module.run('js_clip_place', j, axis))).map(([x, y]) => (Number.isNaN(x) ? null : { x, y }));
    return { rate, channels, places, extentWidth: module.run('js_clip_place', 0, 2), extentHeight: module.run('js_clip_place', 0, 3), leftOut };
})));

/** Events as a file of that name's format; of a format with one channel, a file for each actuator that plays. */
export const writeClip = (compiled, events, name, { error = 0.004, ...settings }) => apart(compiled, name, module => module.withText(name, called => {
    withSettings(module, settings, at => module.withEvents(events, (list, count) => module.run('js_clip_of', list, count, at, error)));
    const write = (channel, to) => (module.run('js_clip_write', called, channel) ? [{ name: to, bytes: textOf(module) }] : []);
    if (!module.run('js_clip_is_mono', called)) return write(-1, name);
    const count = withSettings(module, settings, at => channelsOf(module, at)), dot = name.lastIndexOf('.');
    if (count === 1) return write(0, name);
    return Array.from({ length: count }, (_, j) => write(j, `${name.slice(0, dot)}-${module.text(module.run('js_clip_label', j))}${name.slice(dot)}`)).flat();
}));
