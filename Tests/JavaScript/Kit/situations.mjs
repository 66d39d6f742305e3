// SPDX-License-Identifier: MIT
// Situations that public bug reports brought up, and what must be felt in each. Of one: `bodies` (metres, y upwards; those with `isSource` feel), `acts` (seconds and
// what happens then, to engine and bodies), `felt` (each hit of a source, in order: `at`, seconds, and `newtonSeconds` from the closed form; left out, the
// engine's own velocities say), or `felt: []` and what explain() then `says`. `own`: there is no closed form, each impact of the engine's own motion is felt.
// `steps`: lengths of steps, of their number.
export const g = 9.81, radius = 0.1;
export const secondsOf = metres => Math.sqrt(2 * metres / g), speedOf = metres => Math.sqrt(2 * g * metres);
const kg = 0.3, floor = { type: 'fixed', x: 0, y: -0.5, half: [30, 0.5] };
const ball = (y, more) => ({ isSource: true, radius, massKg: kg, x: 0, y: y + radius, ...more }), box = (y, more) => ({ isSource: true, half: [0.2, 0.2], massKg: 1, x: 0, y: y + 0.2, ...more });
const other = more => ({ radius, massKg: kg, x: 5, y: 0, ...more });
const landing = (metres, massKg = kg, restitution = 0) => ({ at: secondsOf(metres), newtonSeconds: massKg * speedOf(metres) * (1 + restitution) });
const falls = (name, metres, more) => ({ group: 'falls', name, bodies: { floor, ball: ball(metres) }, felt: [landing(metres)], seconds: secondsOf(metres) + 0.4, ...more });
const fallsAfter = (name, act, felt = landing(1), more) => ({ group: 'changes in flight', name, bodies: { floor, ball: ball(1) }, acts: [[0.1, act]], felt: felt ? [felt] : [], seconds: 1, ...more });
/** Rests, is put far away, and comes back. */
const respawn = (from, deep, speed) => ({ group: 'put somewhere', name: `from ${from} m ${1e3 * deep} mm into the floor, ${speed} m/s`, bodies: { floor, ball: ball(from) }, seconds: 0.6,
    acts: [[0.2, (e, { ball }) => { e.put(ball, 6, radius - deep); e.fling(ball, 0, -speed); }]], from: 0.2, own: true, most: 1 });
const against = gap => ({ group: 'put somewhere', name: `put ${gap >= 0 ? `${1e3 * gap} mm beside` : `${-1e3 * gap} mm into`} another, 5 m/s`, gravity: 0, bodies: { one: ball(-radius), two: ball(-radius, { x: 5 }) }, seconds: 0.5,
    acts: [[0.2, (e, { two }) => { e.put(two, 2 * radius + gap, 0); e.fling(two, -5, 0); }]], both: true, felt: [0, 1].map(() => ({ at: 0.2 + Math.max(0, gap) / 5, newtonSeconds: kg * 5 / 2 })) });
const rests = (name, act, more) => ({ group: 'at rest', name, bodies: { floor, box: box(0) }, acts: [[0.5, act]], from: 0.3, felt: [], seconds: 1.5, ...more });
const platform = { type: 'kinematic', x: 0, y: -0.5, half: [2, 0.5] };

export const situations = [
    falls('0.8 m', 0.8), falls('0.3 m', 0.3), falls('1.9 m', 1.9), falls('2.8 m', 2.8), falls('0.62 m', 0.62), falls('1.13 m', 1.13), falls('20 mm', 0.02, { seconds: 0.3 }),
    falls('0.9 m, 30 steps/s', 0.9, { rate: 30 }), falls('0.9 m, 120 steps/s', 0.9, { rate: 120 }), falls('0.9 m, 240 steps/s', 0.9, { rate: 240 }),
    falls('steps of 4 to 30 ms', 1.2, { steps: k => [0.004, 0.03, 0.011, 0.017, 0.025, 0.008][k % 6] }), falls('steps of 0 s between', 1.2, { steps: k => (k % 3 ? 0 : 1 / 60) }),
    falls('slow motion', 0.5, { steps: () => 1 / 600 }), falls('a hitch of 0.1 s', 1, { steps: k => (k === 10 ? 0.1 : 1 / 60) }), falls('restitution 0.5', 1.2, { bodies: { floor: { ...floor, restitution: 0.5 }, ball: ball(1.2, { restitution: 0.5 }) }, felt: [landing(1.2, kg, 0.5)], most: 3 }),
    falls('a bar on its end', 1, { bodies: { ledge: { type: 'fixed', x: -0.95, y: -0.5, half: [0.1, 0.5] }, bar: { isSource: true, half: [1, 0.1], massKg: 2, x: 0, y: 1.1 } }, felt: [{ at: secondsOf(1), newtonSeconds: 2 * speedOf(1) / (1 + 0.85 ** 2 / ((4 + 0.04) / 12)) }], seconds: 0.6, most: 1, turns: true }),
    falls('a bar that cannot turn on its end', 1, { bodies: { ledge: { type: 'fixed', x: -0.95, y: -0.5, half: [0.1, 0.5] }, bar: { isSource: true, half: [1, 0.1], massKg: 2, x: 0, y: 1.1, lockTurn: true } }, felt: [landing(1, 2)] }),
    falls('a source that is fixed is struck', 1, { bodies: { floor: { ...floor, isSource: true }, ball: { ...ball(1), isSource: false } } }),
    falls('two attachments', 1, { twice: true }), falls('10 km from the origin', 1, { x: 1e4 }), falls('a wall at 20 m/s', 1, { gravity: 0, bodies: { wall: { type: 'fixed', x: 5.05, y: 0, half: [0.05, 2] }, ball: ball(-radius, { vx: 20, bullet: true }) }, felt: [{ at: 4.9 / 20, newtonSeconds: 20 * kg }] }),
    falls('a wall at 100 m/s', 1, { gravity: 0, bodies: { wall: { type: 'fixed', x: 10.25, y: 0, half: [0.25, 2] }, ball: ball(-radius, { vx: 100, bullet: true }) }, felt: [{ at: 0.099, newtonSeconds: 100 * kg }], seconds: 0.4 }),

    respawn(100, 0.005, 0.2), respawn(10, 0.005, 0.5), respawn(10, 0.005, 3), respawn(100, 0, 2), against(0.03), against(0), against(-0.02),
    { group: 'put somewhere', name: 'put aside in the air', bodies: { floor, ball: ball(1) }, acts: [[0.2, (e, { ball }) => { const { y } = e.get(ball); e.put(ball, 3, y); }]], felt: [landing(1)], seconds: 1 },
    { group: 'put somewhere', name: 'taken up from rest, falls again', bodies: { floor, ball: ball(0) }, acts: [[0.5, (e, { ball }) => { e.put(ball, 0, 0.5 + radius); e.rest(ball); }]], from: 0.4, felt: [{ at: 0.5 + secondsOf(0.5), newtonSeconds: kg * speedOf(0.5) }], seconds: 1.2 },
    { group: 'put somewhere', name: 'held in place each step', bodies: { floor, ball: ball(0.5) }, each: (e, { ball }) => { e.put(ball, 0, 0.6); e.fling(ball, 0, 0); }, felt: [], says: /No contact|nothing has touched/, seconds: 0.5 },
    { group: 'put somewhere', name: 'made while the world runs', bodies: { floor }, acts: [[0.3, (e, all) => { all.ball = e.make(ball(0.8)); }]], felt: [{ ...landing(0.8), at: 0.3 + secondsOf(0.8) }], seconds: 1 },
    { group: 'put somewhere', name: 'all shifted by hand', bodies: { floor, ball: ball(0) }, acts: [[0.5, (e, { floor, ball }) => { for (const body of [floor, ball]) { const { x, y } = e.get(body); e.put(body, x - 3, y - 2); } }]], from: 0.3, felt: [], own: true, seconds: 1 },

    fallsAfter('let go: fixed, then dynamic', (e, { ball }) => { e.type(ball, 'dynamic'); e.rest(ball); }, { ...landing(1), at: 0.1 + secondsOf(1) }, { bodies: { floor, ball: ball(1, { type: 'fixed', later: kg }) } }),
    fallsAfter('let go: kinematic, then dynamic', (e, { ball }) => { e.type(ball, 'dynamic'); e.rest(ball); }, { ...landing(1), at: 0.1 + secondsOf(1) }, { bodies: { floor, ball: ball(1, { type: 'kinematic', later: kg }) } }),
    fallsAfter('made fixed in the air', (e, { ball }) => e.type(ball, 'fixed'), null, { says: /immovable|No contact/ }),
    fallsAfter('20 times lighter', (e, { ball }) => e.mass(ball, kg / 20), landing(1, kg / 20)), fallsAfter('20 times heavier', (e, { ball }) => e.mass(ball, 20 * kg), landing(1, 20 * kg)),
    fallsAfter('a bar that is locked in flight', (e, { bar }) => e.lockTurn(bar), landing(1, 2), { bodies: { ledge: { type: 'fixed', x: -0.95, y: -0.5, half: [0.1, 0.5] }, bar: { isSource: true, half: [1, 0.1], massKg: 2, x: 0, y: 1.1 } }, seconds: 0.6 }),
    fallsAfter('gravity scale 0: floats', (e, { ball }) => { e.gravityScale(ball, 0); e.fling(ball, 0, 0); }, null, { says: /No contact/ }),
    fallsAfter('gravity scale 2', (e, { ball }) => { e.gravityScale(ball, 2); e.fling(ball, 0, 0); e.put(ball, 0, 1 + radius); }, { own: true }, { scale: 2 }),
    fallsAfter('gravity turns over: a ceiling', (e, { ball }) => e.gravity(-g), { own: true }, { bodies: { floor, ceiling: { type: 'fixed', x: 0, y: 2.5, half: [3, 0.5] }, ball: ball(1) }, seconds: 1.2, most: 1 }),
    fallsAfter('its filter lets it pass', (e, { ball }) => e.passes(ball, true), null, { says: /filter|No contact|source/, needs: ['passes'] }), fallsAfter('made a sensor', (e, { ball }) => e.sensor(ball, true), null, { says: /sensor|No contact|source/ }),
    fallsAfter('disabled', (e, { ball }) => e.enable(ball, false), null, { says: /disabled/ }), fallsAfter('grown to twice its radius', (e, { ball }) => e.grow(ball, 2 * radius), { own: true }),
    { group: 'changes in flight', name: 'a sensor becomes solid', bodies: { floor, ball: ball(1, { sensor: true }) }, acts: [[0.2, (e, { ball }) => e.sensor(ball, false)]], felt: [landing(1)], seconds: 1 },
    { group: 'changes in flight', name: 'passes a platform from below, lands on it', bodies: { floor: { ...platform, type: 'fixed', y: 0.5, half: [2, 0.1] }, ball: ball(-0.2 - radius, { vy: 5 }) }, each: (e, { ball }) => { const { y, vy } = e.get(ball); e.passes(ball, vy > 0 || y < 0.7); }, felt: [{ own: true }], seconds: 1.4, needs: ['passes'] },

    rests('nothing happens', () => {}, { says: /rest|slower|No contact|Nothing|no hit/i }), rests('pushed down by its velocity: no impact', (e, { box }) => e.fling(box, 0, -2)), rests('put to sleep', (e, { box }) => e.sleep(box), { says: /asleep|slower|rest/ }),
    rests('a filter takes the floor away', (e, { box }) => e.passes(box, true), { needs: ['passes'] }), rests('the floor is removed', (e, { floor }) => e.remove(floor), { seconds: 1 }), rests('the floor is replaced', (e, all) => { e.remove(all.floor); all.floor = e.make(floor); }, { own: true }),
    rests('20 times heavier', (e, { box }) => e.mass(box, 20)), rests('made fixed, and free again', (e, { box }) => e.type(box, 'fixed'), { acts: [[0.5, (e, { box }) => e.type(box, 'fixed')], [0.7, (e, { box }) => e.type(box, 'dynamic')]], own: true }),
    rests('jumps, and lands', (e, { box }) => e.fling(box, 0, 3), { own: true, most: 1, seconds: 1.8 }), rests('slides until it stands', (e, { box }) => e.fling(box, 2, 0), { own: true, mayMiss: true }),
    rests('the fixed floor is put 90 mm lower', (e, { floor }) => e.put(floor, 0, -0.59), { own: true, most: 1 }), rests('the fixed floor is put 50 mm higher', (e, { floor }) => e.put(floor, 0, -0.45), { own: true }),
    { group: 'at rest', name: 'a stack of three lands and rests', bodies: { floor, one: box(0.02), two: { ...box(0.52), isSource: false }, three: { ...box(1.02), isSource: false } }, from: 0, own: true, seconds: 2, atLeast: 1, most: 4, loose: true },
    { group: 'at rest', name: 'the middle of a stack is removed', bodies: { floor, one: { ...box(0), isSource: false }, two: { ...box(0.4), isSource: false }, three: box(0.8) }, acts: [[0.5, (e, { two }) => e.remove(two)]], from: 0.4, own: true, atLeast: 1, most: 2, seconds: 1.2 },

    { group: 'platforms', name: 'rises at 2 m/s', bodies: { platform: { ...platform, vy: 2 }, ball: ball(1.5, { }) }, felt: [{ at: (-2 + Math.sqrt(4 + 2 * g * 1.5)) / g, newtonSeconds: kg * Math.sqrt(4 + 2 * g * 1.5) }], seconds: 0.6 },
    { group: 'platforms', name: 'falls at 3 m/s', bodies: { platform: { ...platform, vy: -3 }, ball: ball(1, { vy: -4 }) }, felt: [{ own: true }], seconds: 0.7 },
    { group: 'platforms', name: 'a lift of 0.5 m/s is ridden', bodies: { platform, box: box(0) }, acts: [[0.5, (e, { platform, box }) => { e.moves(platform, 0, 0.5); e.fling(box, 0, 0.5); }]], from: 0.6, own: true, felt: [], seconds: 2 },
    { group: 'platforms', name: 'a lift starts with 1 m/s under what rests on it: no impact', bodies: { platform, box: box(0) }, acts: [[0.5, (e, { platform }) => e.moves(platform, 0, 1)]], from: 0.4, own: true, mayMiss: true, seconds: 1 },
    { group: 'platforms', name: 'a lift of 2 m/s stops', bodies: { platform: { ...platform, vy: 2 }, box: box(0, { vy: 2 }) }, acts: [[0.5, (e, { platform }) => e.moves(platform, 0, 0)]], from: 0.5, own: true, most: 1, atLeast: 1, seconds: 1.3 },
    { group: 'platforms', name: 'a belt is ridden', bodies: { platform: { ...platform, half: [30, 0.5] }, box: box(0) }, acts: [[0.5, (e, { platform }) => e.moves(platform, 1, 0)]], from: 0.4, own: true, felt: [], seconds: 1.5 },
    { group: 'platforms', name: 'put by its place each step, strikes a ball', gravity: 0, bodies: { ram: { type: 'kinematic', x: -1, y: 0, half: [0.2, 0.2] }, ball: ball(-radius) }, each(e, { ram }, time, seconds) { e.moveTo(ram, -1 + 2 * Math.max(0, time + seconds - 0.3), 0, seconds); }, felt: [{ at: 0.3 + 0.7 / 2, newtonSeconds: 2 * kg }], seconds: 1 },
    { group: 'platforms', name: 'slammed by its place in one step', gravity: 0, bodies: { ram: { type: 'kinematic', x: -0.31, y: 0, half: [0.2, 0.2] }, ball: ball(-radius) }, acts: [[0, (e, { ram }) => e.moveTo(ram, -0.31, 0, 1 / 60)], [0.3, (e, { ram }) => e.moveTo(ram, -0.25, 0, 1 / 60)]], felt: [{ at: 0.3 + 0.01 / 3.6, newtonSeconds: 3.6 * kg }], seconds: 0.6 },
    { group: 'platforms', name: 'kinematic into fixed', gravity: 0, bodies: { wall: { type: 'fixed', x: 1, y: 0, half: [0.2, 1] }, ram: { isSource: true, type: 'kinematic', x: 0, y: 0, half: [0.2, 0.2], vx: 2 } }, acts: [[0, (e, { ram }) => e.touchesAll?.(ram)]], felt: [], says: /mass of 0|immovable/, seconds: 0.6 },
    { group: 'platforms', name: 'a kinematic source is struck', bodies: { platform: { ...platform, isSource: true }, ball: { ...ball(1), isSource: false } }, felt: [landing(1)], seconds: 0.7, ofOther: 'ball' },

    { group: 'several bodies', name: 'two balls head on', gravity: 0, bodies: { one: ball(-radius, { vx: 2 }), two: other({ x: 1, vx: -1 }) }, felt: [{ at: 0.8 / 3, newtonSeconds: kg * 3 / 2 }], seconds: 0.5 },
    { group: 'several bodies', name: 'a sleeping ball is struck', bodies: { floor: { ...floor, friction: 0 }, one: ball(0, { friction: 0 }), two: { radius, massKg: kg, x: -2, y: radius, friction: 0 } }, acts: [[0.3, (e, { one }) => e.sleep(one)], [0.5, (e, { two }) => e.fling(two, 4, 0)]], from: 0.45, felt: [{ at: 0.95, newtonSeconds: kg * 4 / 2 }], seconds: 1.1, needs: ['sleep'] },
    { group: 'several bodies', name: 'falls on a box that sleeps', bodies: { floor, crate: { half: [0.3, 0.3], massKg: 5, x: 0, y: 0.3 }, ball: ball(2) }, acts: [[0.1, (e, { crate }) => e.sleep(crate)]], felt: [{ own: true }], most: 2, seconds: 0.8, needs: ['sleep'] },
    { group: 'several bodies', name: 'a ball falls on a box on a table that feels', bodies: { floor, table: { isSource: true, half: [0.6, 0.4], massKg: 8, x: 0, y: 0.4 }, crate: { half: [0.2, 0.2], massKg: 1, x: 0, y: 1 }, ball: { radius, massKg: kg, x: 0, y: 2.3 + radius } }, from: 0.3, felt: [{ at: secondsOf(1.1), any: true }], atLeast: 1, most: 2, seconds: 0.8, ms: 20 },
    { group: 'several bodies', name: 'the first of a row is struck', gravity: 0, bodies: { one: other({ x: 0, vx: 3 }), two: other({ x: 1 }), three: ball(-radius, { x: 1.2001 }) }, felt: [{ own: true }], atLeast: 1, most: 2, seconds: 0.6 },
    { group: 'several bodies', name: 'a pole topples', bodies: { floor, pole: { isSource: true, half: [0.025, 0.5], massKg: 0.5, x: 0, y: 0.51, angle: -0.1, friction: 0.8 } }, own: true, atLeast: 1, most: 4, loose: true, seconds: 3, turns: true },
    { group: 'several bodies', name: 'two in a joint fall', bodies: { floor, one: ball(0.8), two: { radius, massKg: kg, x: 0.4, y: 0.8 + radius } }, acts: [[0, (e, { one, two }) => e.pin(one, two, 0.2, 0.9)]], felt: [{ ...landing(0.8) }], atLeast: 1, most: 2, seconds: 0.6, needs: ['pin'] },
    { group: 'several bodies', name: 'slides over seams of tiles', bodies: { ...Object.fromEntries(Array.from({ length: 12 }, (_, i) => [`tile${i}`, { type: 'fixed', x: i - 1, y: -0.5, half: [0.5, 0.5] }])), ball: ball(0) }, acts: [[0.3, (e, { ball }) => e.fling(ball, 4, 0)]], from: 0.2, own: true, felt: [], mayMiss: true, seconds: 1.5 },
    { group: 'several bodies', name: 'rolls against a wall', bodies: { floor: { ...floor, friction: 0 }, wall: { type: 'fixed', x: 2.1, y: 1, half: [0.1, 1], friction: 0 }, ball: ball(0, { vx: 3, friction: 0 }) }, from: 0.1, felt: [{ at: 1.9 / 3, newtonSeconds: 3 * kg }], seconds: 0.9 },
    { group: 'several bodies', name: 'dominance: strikes one of a higher group', gravity: 0, bodies: { ball: ball(-radius, { x: -1, vx: 3 }), one: other({ x: 0 }) }, acts: [[0, (e, { one }) => e.dominates(one, 10)]], felt: [{ at: 0.8 / 3, newtonSeconds: 3 * kg }], seconds: 0.6, needs: ['dominates'] },
    { group: 'several bodies', name: 'locked along x, struck aslant', gravity: 0, bodies: { one: other({ x: -1 - radius * Math.SQRT2, y: -1 - radius * Math.SQRT2, vx: 3, vy: 3, massKg: 30, friction: 0 }), ball: ball(-radius, { friction: 0 }) }, acts: [[0, (e, { ball }) => e.lockX(ball)]], felt: [{ own: true }], alongNormal: Math.SQRT1_2, seconds: 0.6, needs: ['lockX'] },

    { group: 'lives', name: 'what it struck is removed a step later', bodies: { floor, crate: { half: [0.3, 0.3], type: 'fixed', x: 0, y: 0.3 }, ball: ball(1) }, acts: [[secondsOf(0.4) + 1 / 60, (e, { crate }) => e.remove(crate)]], felt: [{ at: secondsOf(0.4), newtonSeconds: kg * speedOf(0.4) }], first: true, seconds: 0.9 },
    { group: 'lives', name: 'removed in the step behind its hit', bodies: { floor, ball: ball(0.5) }, acts: [[secondsOf(0.5) + 1 / 60, (e, { ball }) => e.remove(ball)]], felt: [landing(0.5)], seconds: 0.8 },
    { group: 'lives', name: 'one in its place is not felt', bodies: { floor, ball: ball(1) }, acts: [[0.2, (e, all) => { e.remove(all.ball); all.next = e.make({ ...ball(1), isSource: false }); }]], felt: [], says: /left it|no longer|source/, seconds: 1 },
    { group: 'lives', name: 'a pool: 200 lives, each felt once', bodies: { floor }, acts: Array.from({ length: 200 }, (_, i) => [0.05 * i, (e, all) => { if (i > 12) e.remove(all[`ball${i - 13}`]); all[`ball${i}`] = e.make(ball(0.3, { x: (i % 13) - 6 })); }]), count: 200, felt: [], seconds: 11 },
    { group: 'lives', name: 'a velocity that is none, of another body', bodies: { floor, bad: { ...ball(3, { x: 10 }), isSource: false }, ball: ball(0.8) }, acts: [[0.1, (e, { bad }) => e.fling(bad, NaN, NaN)]], felt: [landing(0.8)], seconds: 0.7, mayBreak: true },
    { group: 'lives', name: 'restitution 1: each bounce', bodies: { floor: { ...floor, restitution: 1 }, ball: ball(0.5, { restitution: 1 }) }, own: true, atLeast: 4, most: 8, seconds: 2.5 },
    { group: 'lives', name: 'no source', bodies: { floor, ball: { ...ball(0.5), isSource: false } }, felt: [], says: /source/, seconds: 0.6 },
    { group: 'lives', name: 'pixels taken for metres', pixels: true, gravity: 981, bodies: { floor: { type: 'fixed', x: 0, y: -50, half: [3000, 50] }, ball: { isSource: true, radius: 10, massKg: kg, x: 0, y: 100 } }, says: /pixels/, felt: [{ any: true }], atLeast: 0, most: 2, seconds: 1.5 },
];
