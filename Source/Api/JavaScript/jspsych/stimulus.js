// SPDX-License-Identifier: MIT
// Stimuli as events at seconds from their onset, with the values of PhysVib's messages (Docs/messages.md) under JavaScript's names.
const nsOf = seconds => Math.round(seconds * 1e9);
const tone = (seconds, length, place, { frequencyHz = 205, level = 0.5 }) => ({ timeNs: nsOf(seconds), durationNs: nsOf(length), frequencyHz, decayPerSecond: 0, amplitude: level, x: place.x, y: place.y, kind: 'hit' });

function strike({ frequencyHz, decayPerSecond = 0, level = 0.5, seconds = 0, place }) {
    return [{ timeNs: 0, durationNs: nsOf(seconds), frequencyHz, decayPerSecond, amplitude: level, x: place.x, y: place.y, kind: 'hit' }];
}

/** Pulses, each at one actuator: `actuators` are letters, A the layout's first. */
function pattern({ actuators, pulseSeconds = 0.25, gapSeconds = 0.1, places, ...rest }) {
    return [...actuators].map((letter, i) => {
        const place = places[letter.charCodeAt(0) - 65];
        if (place === undefined) throw new RangeError(`pattern: expected letters from A to ${String.fromCharCode(64 + places.length)}, found ${letter}`);
        return tone(i * (pulseSeconds + gapSeconds), pulseSeconds, place, rest);
    });
}

const phantom = ({ seconds = 1, place, ...rest }) => [tone(0, seconds, place, rest)];

/** Straight from `from` to `to` at one speed, in steps of whole periods, so that the tone's phase goes on; each step has the gains of its middle. */
function path({ from, to, seconds = 1, frequencyHz = 205, ...rest }) {
    const period = 1 / frequencyHz, count = Math.max(1, Math.round(seconds / period));
    return Array.from({ length: count }, (_, i) => {
        const way = (i + 0.5) / count, place = { x: from.x + way * (to.x - from.x), y: from.y + way * (to.y - from.y) };
        return tone(i * period, period, place, { frequencyHz, ...rest });
    });
}

const kinds = { strike, pattern, phantom, path };

/** Places of a layout's actuators in the field, m. */
export function placesOf(physvib, { layout = 'phone4', fieldWidth, fieldHeight }) {
    const { places, extentWidth, extentHeight } = typeof layout === 'string' ? physvib.layout(layout) : layout;
    return places.map(({ x, y }) => ({ x: x / extentWidth * (fieldWidth || extentWidth), y: y / extentHeight * (fieldHeight || extentHeight) }));
}

export function eventsOf(physvib, settings, { message, ...values }) {
    if (!(message in kinds)) throw new RangeError(`stimulus: expected a message ${Object.keys(kinds).join(', ')} or clip, found ${String(message)}`);
    const places = placesOf(physvib, settings), middle = { x: places.reduce((sum, place) => sum + place.x, 0) / places.length, y: places.reduce((sum, place) => sum + place.y, 0) / places.length };
    return kinds[message]({ places, place: middle, ...values });
}

/** Until all has decayed by 60 dB, s. */
export const lengthOf = events => Math.max(...events.map(({ timeNs, durationNs, decayPerSecond }) => timeNs * 1e-9 + (durationNs > 0 ? durationNs * 1e-9 : 6.9 / decayPerSecond)));
