// SPDX-License-Identifier: MIT
// The kit: situations of Kit/situations.mjs in each engine: kit.mjs FOLDER [ENGINE...|NAME=COMMAND...] [--only WORDS] [--table] [--page PAGE]. FOLDER: where npm has installed physvib and the engines.
// Right: as the closed form, or the engine's own velocities, say: onset within 0.5 ms, strength within 2 %. Own: felt as the engine moved, which is not what paper
// says. Not there: the engine, or its driver, has no such thing. Prints a table; 1 if anything is wrong that is
// not `open`, or open no more.
import { readFileSync } from 'node:fs';
import { load } from './installed.mjs';
import { drivers as ours } from './Kit/drivers.mjs';
import { native } from './Kit/native.mjs';
import { g, situations } from './Kit/situations.mjs';

const [folder, ...words] = process.argv.slice(2), at = words.indexOf('--only'), only = at < 0 ? '' : words.splice(at, 2)[1], pageAt = words.indexOf('--page'), page = pageAt < 0 ? '' : words.splice(pageAt, 2)[1], isTable = words.includes('--table'), names = words.filter(word => !word.startsWith('--'));
const commands = names.filter(name => name.includes('=')).map(name => name.split('=')), drivers = commands.length > 0 ? Object.fromEntries(commands.map(([name, command]) => [name, native(name, command)])) : ours;
const physvib = commands.length > 0 ? null : await (await load(folder, 'physvib')).load(), source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 }, closeMs = 0.5, closeShare = 0.02;

class NotThere extends Error {}

/** How far two shapes are apart, and the normal; null: of boxes that are turned. */
function gapOf(a, b) {
    const dx = b.x - a.x, dy = b.y - a.y;
    if (a.radius && b.radius) { const length = Math.hypot(dx, dy); return { gap: length - a.radius - b.radius, nx: dx / length, ny: dy / length }; }
    if ((!a.radius && Math.abs(a.angle) > 1e-3) || (!b.radius && Math.abs(b.angle) > 1e-3)) return null;
    const size = ({ radius, half }) => (radius ? [radius, radius] : half), [aw, ah] = size(a), [bw, bh] = size(b), outX = Math.abs(dx) - aw - bw, outY = Math.abs(dy) - ah - bh;
    return outX > outY ? { gap: outX, nx: Math.sign(dx), ny: 0 } : { gap: outY, nx: 0, ny: Math.sign(dy) };
}

/** What one engine does in one situation. */
async function play(make, situation) {
    const rate = situation.rate ?? 60, gravity = situation.gravity ?? g, driver = await make(folder, physvib, { gravity }), haptics = driver.attach(), second = situation.twice && !driver.isClosed && !driver.isSingle ? driver.attach() : null;
    const all = {}, kinds = new Map(), ids = new Map(), motions = [], lengthOf = situation.steps ?? (() => 1 / rate);
    const scales = new Map(), rise = massKg => (massKg > 0 ? gravity * Math.min(driver.halfSeconds ?? Infinity, driver.halfStep * lengthOf(0)) / 2 : 0);
    const e = new Proxy(driver, { get(target, name) {
        if (name === 'touchesAll') return target.touchesAll;
        if (name === 'rest') return body => target.fling(body, 0, rise(1));
        if (name === 'make') return of => made(of);
        if (!(name in target)) throw new NotThere(name);
        if (name === 'gravityScale') return (body, scale) => { scales.set(body, scale); target.gravityScale(body, scale); };
        if (name === 'grow') return (body, radius) => { kinds.get(body).radius = radius; target.grow(body, radius); };
        return target[name];
    } });
    function made({ isSource, later, ...of }) {
        const isMoving = (of.type ?? 'dynamic') === 'dynamic', values = { ...of, x: of.x + (situation.x ?? 0), massKg: of.massKg ?? later, vy: (of.vy ?? 0) + (isMoving ? rise(1) : 0) };
        if (of.sensor && !('sensor' in driver)) throw new NotThere('sensor');
        if (driver.hasNoKinematic && of.type === 'kinematic') throw new NotThere('kinematic');
        if (driver.isClosed && motions.length > 0) throw new NotThere('make');
        if (of.angle && driver.isUnturned) throw new NotThere('angle');
        const body = driver.create(values);
        kinds.set(body, { ...of });
        if (isSource) { ids.set(haptics.set(body, source), body); second?.set(body, source); }
        return body;
    }
    if (situation.needs?.some(verb => !(verb in driver)) || (situation.turns && driver.isUnturned)) throw new NotThere(situation.needs);
    for (const [name, of] of Object.entries(situation.bodies)) all[name] = made(of);
    const acts = [...situation.acts ?? []];
    let time = 0;
    for (let k = 0; time < situation.seconds; ++k) {
        const seconds = lengthOf(k);
        while (acts.length > 0 && acts[0][0] <= time + 1e-9) acts.shift()[1](e, all);
        situation.each?.(e, all, time, seconds);
        const there = new Map(Object.values(all).map(body => { try { return [body, { ...kinds.get(body), ...driver.get(body) }]; } catch { return [body, null]; } }));
        driver.step(seconds, haptics);
        const step = { time, seconds, before: there, after: new Map() };
        for (const body of there.keys()) try { step.after.set(body, driver.get(body)); } catch { /* gone */ }
        motions.push(step);
        time += seconds;
    }
    const said = haptics.explain(), events = haptics.take(true).filter(({ kind }) => kind === 'hit').map(event => ({ ...event, at: event.timeNs * 1e-9, body: ids.get(event.fixture) }));
    const felt = all => all.filter(({ kind }) => kind === 'hit').map(({ timeNs, impulse }) => `${timeNs} ${impulse}`).join(), other = second && felt(second.take(true));
    const error = haptics.error ?? (second && !driver.isSteppedByOne && other !== felt(events) ? new Error(`of two that are attached one feels ${felt(events)}, the other ${other}`) : null);
    haptics.free();
    second?.free();
    driver.end?.();
    return { events, said, motions, all, gravity, scales, error, driver, kinds, isTwice: Boolean(second) };
}

/** Impacts of a body's own motion: when, and how strong, between what gravity's share of the step makes of it. */
function ownImpacts({ motions, gravity, scales, driver }, body, others) {
    const found = [];
    for (const [k, { time, seconds, before, after }] of motions.entries()) {
        const a = before.get(body), b = after.get(body);
        if (!a || !b || !(b.massKg > 0) || seconds === 0) continue;
        const pull = gravity * (scales.get(body) ?? 1) * seconds, dx = b.vx - a.vx, dy = b.vy - a.vy, least = Math.max(0.15, 1.5 * Math.abs(pull));
        if (!(Math.hypot(dx, dy + pull) > least)) continue;
        const last = found.at(-1), strengths = [Math.hypot(dx, dy), Math.hypot(dx, dy + pull)].map(change => b.massKg * change);
        // What an engine adds to push overlaps apart is no blow: that is how fast they came.
        if (driver.pushesApart) for (const other of others) {
            const o = before.get(other), moved = o?.massKg > 0 ? o : after.get(other); // what is kinematic may have its velocity in the step alone
            const came = o && moved && other !== body ? ((moved.vx - a.vx) * dx + (moved.vy - a.vy) * dy) / Math.hypot(dx, dy) : 0;
            if (came > 0.02 && !(gapOf(a, o)?.gap > came * seconds + 0.02)) strengths.push(came / (1 / b.massKg + (o.massKg > 0 ? 1 / o.massKg : 0)));
        }
        // A push that lasts some steps is one.
        if (last && k - last.k <= 1) { last.k = k; last.sumX += dx; last.sumY += dy + pull; last.most = Math.max(last.most, b.massKg * Math.hypot(last.sumX, last.sumY), strengths[1]); continue; }
        found.push({ k, at: time, end: time + seconds, seconds: Math.max(seconds, motions[k - 1]?.seconds ?? 0), least: Math.min(...strengths), most: Math.max(...strengths), sumX: dx, sumY: dy + pull, onset: onsetOf(motions, k, body, others, gravity, driver.halfStep < 0, [dx, dy + pull]) });
    }
    return found;
}
/** When surfaces met, by the engine's own places before the step that they met in. */
function onsetOf(motions, k, body, others, gravity, movesFirst, [dx, dy]) {
    let best = null;
    for (let i = k; i >= Math.max(0, k - 2); --i) {
        const { time, seconds, before } = motions[i], a = before.get(body);
        for (const other of others) {
            const b = before.get(other), near = other !== body && a && b ? gapOf(a, b) : null;
            if (near === null || !(near.gap > 0) || Math.abs(near.nx * dx + near.ny * dy) < 0.5 * Math.hypot(dx, dy)) continue; // pushed by another
            const isFalling = ({ massKg, vy }) => massKg > 0 && Math.abs(vy) > 0.02, fall = ((isFalling(a) ? -1 : 0) - (isFalling(b) ? -1 : 0)) * gravity * near.ny, // what is carried does not fall
                  closing = (a.vx - b.vx) * near.nx + (a.vy - b.vy) * near.ny, root = closing ** 2 + 2 * fall * near.gap;
            const after = root > 0 && closing + Math.sqrt(root) > 0 ? 2 * near.gap / (closing + Math.sqrt(root)) : Infinity, gained = movesFirst ? 0 : fall * seconds, straight = closing + gained > 0 ? near.gap / (closing + gained) : Infinity;
            if (Math.min(after, straight) <= 1.5 * seconds && (best === null || i === best.i)) best = { i, from: Math.min(best?.from ?? Infinity, time + Math.min(after, straight)), to: Math.min(best?.to ?? Infinity, time + Math.max(after, straight)) };
        }
        if (best) return best;
    }
    return null;
}

const percent = share => `${share >= 0 ? '+' : ''}${(100 * share).toFixed(1)} %`;
/** { is: 'right' | 'own' | 'wrong', why } */
function judge(run, situation) {
    const from = situation.from ?? 0, hits = run.events.filter(event => event.at > from - 0.02).sort((a, b) => a.at - b.at), why = [], others = Object.values(run.all);
    if (run.error) return { is: 'wrong', why: `haptics ended: ${run.error.message}` };
    let isOwn = false;
    const list = hits.map(hit => `${(1e3 * hit.at).toFixed(1)} ms ${hit.impulse.toFixed(3)} N s`).join(', ') || 'nothing';
    const ownOf = hit => { const body = situation.ofOther ? run.all[situation.ofOther] : hit.body; return ownImpacts(run, body, others); };
    const strengthOf = (hit, own) => { const share = situation.alongNormal ?? 1; return hit.impulse * share > (1 - closeShare) * own.least && hit.impulse * share < (1 + closeShare) * own.most; };
    if (situation.count !== undefined && hits.length !== situation.count) why.push(`${hits.length} of ${situation.count} hits`);
    const sources = [...new Set(Object.keys(situation.bodies).filter(name => situation.bodies[name].isSource))].map(name => run.all[name]);
    const expected = situation.felt ?? [];
    if (situation.mayBreak && hits.length === 0 && ownImpacts(run, sources[0], others).length === 0) return { is: 'not there' };
    if (situation.count === undefined) {
        const owns = sources.flatMap(body => ownImpacts(run, situation.ofOther ? run.all[situation.ofOther] : body, others)).filter(own => own.end > from);
        const isByOwn = situation.own || expected.some(({ own }) => own);
        if (isByOwn) {
            if (!situation.loose) for (const hit of hits) {
                const own = ownOf(hit).find(each => hit.at > each.at - each.seconds - 1e-3 * closeMs && hit.at < motionsEnd(run, each) + 1e-3 * closeMs && strengthOf(hit, each));
                if (!own) why.push(`felt ${(1e3 * hit.at).toFixed(1)} ms ${hit.impulse.toFixed(3)} N s, its own: ${owns.map(told).join(', ') || 'none'}`);
                else if (Math.abs(offOnset(hit, own)) > 1e-3 * closeMs && !isPut(situation, own)) why.push(`${(1e3 * offOnset(hit, own)).toFixed(1)} ms from its own onset`);
            }
            if (!situation.loose && !situation.mayMiss) for (const own of owns) if (own.least > 2 * (0.15 * massOf(run, sources[0]) + 0) && !run.events.some(hit => hit.at > own.at - own.seconds - 1e-3 && hit.at < motionsEnd(run, own) + 1e-3)) why.push(`not felt: its own ${told(own)}; felt ${list}`);
            const least = situation.atLeast ?? 0, most = situation.most ?? (situation.felt?.length ? Math.max(1, situation.felt.length) : Infinity);
            if (hits.length < least || hits.length > most) why.push(`${hits.length} hits (${list}), due ${least} to ${most}`);
            if (situation.felt?.length === 0 && hits.length > 0) isOwn = true;
        } else {
            const least = situation.atLeast ?? expected.length, most = situation.most ?? expected.length;
            // More than are due: each one an impact of its own motion, as of an engine that throws out what overlaps.
            const areOwn = !situation.first && hits.length > most && new Set(hits.map(hit => owns.find(each => hit.at > each.at - each.seconds - 1e-3 && hit.at < motionsEnd(run, each) + 1e-3 && strengthOf(hit, each)))).size === hits.length && owns.length >= hits.length;
            isOwn ||= areOwn;
            if (!situation.first && !areOwn && (hits.length < least || hits.length > most)) why.push(`${hits.length} hits (${list}), due ${least === most ? least : `${least} to ${most}`}${owns.length ? `; its own: ${owns.map(told).join(', ')}` : ''}`);
            for (const [i, due] of expected.entries()) {
                const hit = hits[i];
                if (!hit) { if (i < least) why.push('not felt'); continue; }
                if (due.any) { const pushed = due.least && hit.impulse >= 1.3 * due.least && ownOf(hit).some(own => strengthOf(hit, own)); isOwn ||= pushed; if (due.least && !pushed && !(hit.impulse > 0.98 * due.least && hit.impulse < 1.3 * due.least)) why.push(`${hit.impulse.toFixed(3)} N s, due ${due.least.toFixed(3)}`); if (due.at !== undefined && Math.abs(hit.at - due.at) > 1e-3 * (situation.ms ?? closeMs)) why.push(`at ${(1e3 * hit.at).toFixed(1)} ms, due ${(1e3 * due.at).toFixed(1)}`); continue; }
                const late = hit.at - due.at, off = hit.impulse / due.newtonSeconds - 1, own = ownOf(hit).find(each => hit.at > each.at - each.seconds - 1e-3 && hit.at < motionsEnd(run, each) + 1e-3);
                const isOnTime = Math.abs(late) <= 1e-3 * closeMs, isOwnTime = own && Math.abs(offOnset(hit, own)) <= 1e-3 * closeMs, isStrong = Math.abs(off) <= closeShare, isOwnStrong = own && strengthOf(hit, own);
                if (!isOnTime && !isOwnTime) why.push(`${(1e3 * late).toFixed(2)} ms from paper${own?.onset ? `, ${(1e3 * offOnset(hit, own)).toFixed(2)} ms from its own` : ''}`);
                if (!isStrong && !isOwnStrong) why.push(`${percent(off)} of paper${own ? `, felt ${hit.impulse.toFixed(3)}, its own ${told(own)}` : ', no impact of its own there'}`);
                isOwn ||= !isOnTime || !isStrong;
            }
        }
    }
    if (situation.says && hits.length === 0 && !situation.says.test(run.said)) why.push(`explained: ${run.said}`);
    if (situation.pixels && !situation.says.test(run.said)) why.push(`explained: ${run.said}`);
    return why.length > 0 ? { is: 'wrong', why: why.join('; ') } : { is: isOwn ? 'own' : 'right' };
}
/** An engine's path within a step is a parabola, or straight. */
const offOnset = ({ at }, { onset }) => (onset === null || (at > onset.from && at < onset.to) ? 0 : Math.abs(at - onset.from) < Math.abs(at - onset.to) ? at - onset.from : at - onset.to);
const told = own => `${(1e3 * own.at).toFixed(1)} ms ${own.least.toFixed(3)}${own.most > 1.005 * own.least ? ` to ${own.most.toFixed(3)}` : ''} N s`;
const motionsEnd = ({ motions }, { k }) => motions[k].time + motions[k].seconds;
const massOf = ({ motions }, body) => motions.map(({ after }) => after.get(body)?.massKg ?? 0).find(massKg => massKg > 0) ?? 0;
const isPut = (situation, own) => (situation.acts ?? []).some(([time]) => own.at - time < 2 * own.seconds && own.at >= time - 1e-6);

const table = new Map(), wrong = [], open = [], counts = {};
for (const [name, make] of Object.entries(drivers)) {
    if (names.length > 0 && commands.length === 0 && !names.includes(name)) continue;
    counts[name] = { right: 0, own: 0, 'not there': 0, wrong: 0 };
    for (const situation of situations) {
        const title = `${situation.group}: ${situation.name}`;
        if (!title.includes(only)) continue;
        let verdict;
        try {
            verdict = judge(await play(make, situation), situation);
        } catch (error) {
            verdict = error instanceof NotThere || situation.mayBreak ? { is: 'not there' } : { is: 'wrong', why: String(error?.stack ?? error).split('\n').slice(0, 3).join(' ') };
        }
        ++counts[name][verdict.is];
        (table.get(title) ?? table.set(title, {}).get(title))[name] = verdict.is;
        const isOpen = situation.open?.split(' ').includes(name) ?? false;
        if (verdict.is === 'wrong' && isOpen) open.push(`${name}: ${title}: ${verdict.why}`);
        else if (verdict.is === 'wrong') wrong.push(`${name}: ${title}: ${verdict.why}`);
        else if (isOpen) wrong.push(`${name}: ${title}: is open no more`);
    }
}
const columns = Object.keys(counts), shown = { right: 'right', own: 'own', 'not there': '-', wrong: 'WRONG' };
if (isTable) {
    console.log(`| situation | ${columns.join(' | ')} |\n| --- |${' --- |'.repeat(columns.length)}`);
    for (const [title, row] of table) console.log(`| ${title} | ${columns.map(name => shown[row[name]]).join(' | ')} |`);
}
// As PAGE has it.
const titles = { matter: 'Matter 0.20', planck: 'Planck 1.4', rapier2d: 'Rapier 2D 0.21', rapier3d: 'Rapier 3D 0.21', box2d3: 'Box2D 3 (wasm 5.2)', velocities: '`physvib/velocities`', cannon: 'cannon-es 0.20', havok: 'Havok 1.3', babylon: 'Babylon 9', jolt: 'Jolt 1.1', mujoco: 'MuJoCo 3.14', box2d: '[In C](engines.md): Box2D 2.4', chipmunk: 'Chipmunk 7', bullet: 'Bullet 3', ode: 'ODE 0.16', love: 'LÖVE 11', pymunk: 'pymunk 7.3', 'mujoco@2': 'MuJoCo 2.2', 'box2d3@v3.1.1': 'Box2D 3.1' };
const rows = Object.entries(counts).map(([name, of]) => `| ${titles[name] ?? name} | ${of.right} | ${of.own} | ${of.wrong} | ${of['not there']} |`);
if (page) {
    const text = readFileSync(page, 'utf8'), missing = rows.filter(row => !text.includes(row));
    for (const row of rows) console.log(row);
    for (const row of missing) wrong.push(`${page}: expected the line ${row}`);
}
for (const line of open) console.log(`open: ${line}`);
for (const line of wrong) console.log(`WRONG ${line}`);
console.log(`\n| of ${table.size} | right | the engine's own | not there | wrong |\n| --- | --- | --- | --- | --- |`);
for (const [name, of] of Object.entries(counts)) console.log(`| ${name} | ${of.right} | ${of.own} | ${of['not there']} | ${of.wrong} |`);
process.exit(wrong.length > 0 ? 1 : 0);
