// SPDX-License-Identifier: MIT
// The event of one impact, without a world.
import { tables } from './materials.js';
import { PhysVibError } from './module.js';

const vibrating = tables.flatMap(table => table.materials).filter(material => material.frequency_hz > 0);

/** The names of the built-in materials that vibrate. */
export const materials = vibrating.map(material => material.name);

/** Values of setBody for a built-in material. */
export function material(name) {
    const found = vibrating.find(one => one.name === name);
    if (!found) throw new PhysVibError(-2, `material: expected one that vibrates (${materials.join(', ')}), found "${String(name)}"`);
    return { frequencyHz: found.frequency_hz, decayPerSecond: found.decay_per_s ?? 0, grain: found.grain_m ?? 0, roughness: found.roughness ?? 1,
        rolling: found.rolling ?? 0.2, isRidged: found.grain_pattern === 'regular' };
}

/** An event at time 0; the default vibration is that of physvib_event_of. */
export function impactOf({ x = 0, y = 0, strength = 0.5, material: name } = {}) {
    if (!(strength >= 0 && strength <= 1)) throw new PhysVibError(-2, `strength: expected 0 to 1, found ${String(strength)}`);
    const { frequencyHz, decayPerSecond } = name === undefined ? { frequencyHz: 200, decayPerSecond: 30 } : material(name);
    return { timeNs: 0, frequencyHz, decayPerSecond, amplitude: strength, x, y, fixture: -1, other: -1 };
}
