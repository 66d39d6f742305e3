// SPDX-License-Identifier: MIT
// Main module of the page: its controls, and display of the player's reports.
import { Tilt, dragOn } from './hands.js';
import { freshWorld, mostEnchanters, openedBy, rounded, worldOf } from './link.js';
import { badgeButtons, materialRows, variableRows } from './mix.js';
import { Module } from './module.js';
import { Pads } from './pads.js';
import { Preview } from './preview.js';
import { fileLinks, filesOf } from './record.js';
import { Scope } from './scope.js';
import { share } from './share.js';
import { Sound, silentBecause } from './sound.js';
import { World } from './world.js';

const $ = id => document.getElementById(id);
const decibels = value => value.toFixed(0).replace('-', '−') + ' dB';
const tellMs = 1000; // duration for which the strongest hit is displayed
const recordSeconds = 10;
const arrangements = { 'four corners': [[0, 1], [1, 1], [0, 0], [1, 0]], 'left and right': [[0, 0.5], [1, 0.5]], 'three in a row': [[0, 0.5], [0.5, 0.5], [1, 0.5]], 'one in the middle': [[0.5, 0.5]] };

export const world = new World($('world'));
const sound = new Sound(told, soundChanged), scope = new Scope($('scope')), tilt = new Tilt($('tilt'), message => engine?.tell(message));
let engine = null, code, compiled, pads, laws = []; // engine: the preview, and after Start the sound
let state = freshWorld(), key = 0, best = { at: 0 }, hasStarted = false, isWaiting = false, hasFallenBack = false; // state: all that a link holds; best: hit of the last second
const own = new Option('', ''); // a file that is no built-in scene
const asked = new Map(); // worlds that the player has not opened yet, by key

// ---- opening worlds
const opened = next => {
    asked.set(++key, next);
    return { ...openedBy(next, laws), key };
};
/// The requested world, as arguments for a player.
export const wanted = () => openedBy(state, laws);
function open(next) {
    engine.tell({ open: opened(next) });
}
function choose(next) {
    fault('');
    open(next);
}
async function openFile(file) {
    if (file) choose({ ...freshWorld(), scene: file.name, text: await file.text(), field: world.scene.field_m, places: state.places, law: state.law });
}
async function openLink() {
    try {
        const next = await worldOf(location.hash.slice(1) || location.search.slice(1));
        if (next.law && !laws.includes(next.law)) throw new Error(`link: law: expected one of ${laws.join(', ')}, found ${next.law}`);
        choose(next);
    } catch (error) {
        fault(error.message);
        if (!world.scene) open(freshWorld());
    }
}
function fault(line) {
    $('fault').firstChild.textContent = line;
    $('fault').hidden = !line;
}

// ---- reports of the player
function told(message) {
    if (message.fault) {
        fault(message.fault);
        if (!world.scene && !hasFallenBack) hasFallenBack = true, open(freshWorld()); // the world of the link was rejected
    }
    if (message.scene) show(message);
    if ('recorded' in message) recorded(message.recorded);
    if (!message.poses) return;
    world.poses = message.poses;
    world.add(message.hits);
    scope.add(message.blocks, message.count);
    pads.play(message.hits, message.seconds);
    message.hits.forEach(tellHit);
}
function show({ key: of, scene: text, variables, isPlayed }) {
    const scene = JSON.parse(text);
    state = asked.get(of) ?? state;
    for (const older of [...asked.keys()]) if (older <= of) asked.delete(older);
    world.show(scene);
    tilt.isPlayed = isPlayed;
    tilt.show(0);
    $('materials').replaceChildren(...materialRows(scene.materials, state.materials, (index, values) => {
        state.materials.set(index, values);
        engine.tell({ sound: [index, ...values] });
    }));
    $('variables').replaceChildren(...variableRows(variables, (name, value) => choose({ ...state, variables: new Map(state.variables).set(name, value) })));
    own.hidden = state.text === null;
    own.textContent = state.scene;
    $('scene').value = own.hidden ? state.scene : '';
    const isStill = scene.bodies.length === 0; // a list, a clip
    document.body.classList.toggle('still', isStill);
    if (isStill) $('sentence').textContent = `${state.scene} plays, once; Restart plays it again.`;
    $('seed').value = state.seed;
    $('byItself').checked = !state.byHand;
    $('law').value = state.law;
    document.title = `${state.scene.replaceAll('-', ' ')} · PhysVib`;
    arrange(state.places, false);
    if (pads.isOn) pads.set(true, scene.field_m);
}
function tellHit([, , hz, decay, amplitude]) {
    const time = performance.now();
    if (time - best.at < tellMs && Math.abs(amplitude) < best.amplitude) return;
    best = { at: time, amplitude: Math.abs(amplitude) };
    const material = world.scene.materials.find((m, i) => Math.abs((state.materials.get(i)?.[0] ?? m.frequency_hz) - hz) < 0.01);
    $('sentence').textContent = `${material ? material.name + ' · ' : ''}${hz.toFixed(0)} Hz · falls by 60 dB in ${(6.908 / decay).toFixed(2)} s · ${decibels(20 * Math.log10(best.amplitude))}`;
}
const noDevice = 'this machine has no sound device: nothing is heard or felt';
function tellOutput() {
    const count = world.places.length, monitor = `heard as a stereo monitor: this device has ${sound.outputs} ${sound.outputs === 1 ? 'output' : 'outputs'}`;
    const way = { running: `${sound.isDirect ? 'each actuator on its own output' : monitor} · ${sound.rate / 1000} kHz`, 'device lost': noDevice, suspended: isPressed('pause') ? 'paused' : 'the browser has stopped the sound: Restart goes on' }[sound.state];
    $('output').textContent = `${count} ${count === 1 ? 'actuator' : 'actuators'}, ${way}`;
}
function soundChanged() {
    if (hasStarted) tellOutput();
    else if (isWaiting && sound.state === 'running') goOnWithSound(), open(state);
    else if (isWaiting && sound.isLate && !$('start').disabled) start();
}

// ---- actuators
function arrange(places, isNew = true) {
    state.places = world.places = places;
    world.chosen = Math.min(world.chosen, places.length - 1);
    if (isNew) place();
    if (hasStarted) sound.connect(places), tellOutput();
    const focused = [...$('badges').children].indexOf(document.activeElement);
    $('badges').replaceChildren(...badgeButtons(places, (index, at) => arrange(world.places.map((old, j) => (j === index ? at : old))), index => { world.chosen = index; }));
    $('badges').children[focused]?.focus();
    $('attach').disabled = places.length >= mostEnchanters;
    $('detach').disabled = places.length <= 1;
}
const place = () => engine?.tell({ placed: { places: world.places, law: laws.indexOf(state.law) } });
$('preset').add(new Option('Arrangement…', ''));
for (const name of Object.keys(arrangements)) $('preset').add(new Option(name));
$('preset').onchange = () => {
    if ($('preset').value) arrange(arrangements[$('preset').value].map(at => [...at]));
    $('preset').value = '';
};
$('attach').onclick = () => arrange([...world.places, [0.5, rounded(0.5 - 0.08 * (world.places.length % 5))]]); // beside the last one
$('buzz').onclick = async () => {
    $('buzz').disabled = true;
    for (let j = 0; j < world.places.length; ++j) {
        const badge = $('badges').children[j];
        badge.setAttribute('aria-pressed', true);
        sound.buzz(j);
        await new Promise(done => setTimeout(done, 800));
        badge.removeAttribute('aria-pressed');
    }
    $('buzz').disabled = false;
};
$('outputs').onchange = () => {
    const words = $('outputs').value.split(/[\s,]+/).filter(Boolean);
    try { sound.setOutputs(words.length > 0 ? words.map(Number) : undefined, world.places), fault(''), tellOutput(); } catch (error) { fault(error.message); }
};
$('detach').onclick = () => arrange(world.places.filter((_, j) => j !== (world.chosen < 0 ? world.places.length - 1 : world.chosen)));
$('law').onchange = () => { state.law = $('law').value; place(); };
dragOn(world, message => engine?.tell(message), isDone => (isDone ? arrange(world.places.map(at => at.map(rounded))) : place()));

// ---- top bar
const gain = () => (isPressed('silence') || +$('level').value <= -60 ? 0 : 10 ** ($('level').value / 20));
const setPressed = (id, isOn) => $(id).setAttribute('aria-pressed', isOn);
const isPressed = id => $(id).getAttribute('aria-pressed') === 'true';
function setLevel() {
    sound.setLevel(gain());
    pads?.setLevel(hasStarted ? gain() : 0);
    $('levelText').textContent = +$('level').value > -60 ? decibels(+$('level').value) : 'silent';
    $('level').setAttribute('aria-valuetext', +$('level').value > -60 ? `${$('level').value} decibels` : 'silent');
}
$('level').oninput = setLevel;
$('scene').onchange = () => choose({ ...freshWorld(), scene: $('scene').value, seed: state.seed, byHand: state.byHand, places: state.places, law: state.law });
$('seed').onchange = () => choose({ ...state, seed: Math.min(2 ** 32 - 1, Math.max(0, Math.round(+$('seed').value))) });
$('open').onclick = () => $('file').click();
$('file').onchange = () => openFile($('file').files[0]).then(() => ($('file').value = ''));
$('again').onclick = () => {
    if (hasStarted && sound.state !== 'running' && !isPressed('pause')) sound.resume();
    open(state);
};
$('byItself').onchange = () => open({ ...state, byHand: !$('byItself').checked });
$('sharing').onclick = () => share(compiled, state).catch(error => fault(`link: ${error.message}`));
$('shared').onclick = () => $('share').close();
$('noFault').onclick = () => fault('');
function pause(isPaused) {
    setPressed('pause', isPaused);
    $('paused').hidden = !isPaused;
    engine.pause(isPaused);
    if (isPaused) pads.stop();
    stayAwake();
}
$('pause').onclick = () => pause(!isPressed('pause'));
function silence(isSilent) {
    setPressed('silence', isSilent);
    setLevel();
    if (isSilent) pads?.stop();
}
$('silence').onclick = () => silence(!isPressed('silence'));
$('rumble').onchange = () => pads.set($('rumble').checked, world.scene.field_m);
$('sensor').hidden = !Tilt.hasSensor;
$('sensor').onclick = async () => setPressed('sensor', await tilt.follow(!isPressed('sensor')));
$('record').onclick = () => {
    const channels = world.places.map(() => new Float32Array(recordSeconds * sound.rate));
    $('record').disabled = true;
    $('record').textContent = 'Recording…';
    sound.tell({ record: channels }, channels.map(channel => channel.buffer));
};
function recorded(recording) {
    $('record').disabled = false;
    $('record').textContent = `Record ${recordSeconds} s`;
    if (!recording) return;
    for (const link of $('recorded').querySelectorAll('a')) URL.revokeObjectURL(link.href);
    $('recorded').replaceChildren(...fileLinks(filesOf(compiled, state.scene.replace(/\.\w+$/, ''), recording, state, world.scene.field_m)));
}
document.addEventListener('keydown', event => {
    if (event.defaultPrevented || $('share').open) return;
    if (event.key === 'Escape') silence(true);
    else if (!event.target.matches('input, select')) tilt.key(event);
});
document.addEventListener('dragover', event => event.preventDefault());
document.addEventListener('drop', event => { event.preventDefault(); openFile(event.dataTransfer.files[0]); });
window.addEventListener('hashchange', openLink);

// ---- sound starts on a click only, as browsers require
let awake = null; // promise of a lock on the screen, while there is something to see
function stayAwake() {
    awake?.then(lock => lock?.release());
    awake = hasStarted && !document.hidden && !isPressed('pause') ? navigator.wakeLock?.request('screen').catch(() => null) : null;
}
document.addEventListener('visibilitychange', stayAwake);
async function start() {
    isWaiting = false;
    $('start').disabled = true;
    const leaning = Tilt.hasSensor ? tilt.follow(true) : false; // phones ask on a click only
    engine.end();
    try {
        isWaiting = !await sound.start(code, opened(state)) && sound.state !== 'running';
        if (!isWaiting) goOnWithSound();
        setPressed('sensor', await leaning);
    } catch (error) {
        fault(error.message);
    }
    if (hasStarted) return;
    $('start').disabled = false;
    if (!isPressed('pause')) engine.run();
    if (isWaiting) $('beginText').textContent = $('output').textContent = 'No sound yet: this machine has no sound device, or one that is slow. When it answers, sound begins.';
}
$('start').onclick = start;
function goOnWithSound() {
    engine.end();
    engine = sound;
    hasStarted = true;
    isWaiting = false;
    $('begin').hidden = true;
    for (const id of ['record', 'buzz', 'outputs']) $(id).disabled = false;
    setPressed('pause', false);
    $('paused').hidden = true;
    $('world').focus({ preventScroll: true });
    sound.connect(world.places);
    tellOutput();
    setLevel();
    stayAwake();
}
function draw() {
    world.draw();
    scope.draw();
    requestAnimationFrame(draw);
}
async function begin() {
    code = await (await fetch('physvib.wasm')).arrayBuffer();
    compiled = await WebAssembly.compile(code);
    pads = new Pads(new Module(compiled));
    setLevel();
    const preview = engine = new Preview(compiled, mostEnchanters, told), { scenes, laws: names } = preview.lists;
    laws = names;
    for (let i = 0; i < scenes.length; i += 2) $('scene').add(Object.assign(new Option(scenes[i].replaceAll('-', ' '), scenes[i]), { title: scenes[i + 1] }));
    $('scene').add(own);
    $('law').add(Object.assign(new Option('default', ''), { title: 'neighbours on a row, grid or belt of actuators; elsewhere linear, and surfaces that roll or slide by energy' }));
    for (const law of laws) if (law !== 'auto') $('law').add(new Option(law)); // auto is the default entry
    await openLink();
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) pause(true);
    else preview.run();
    draw();
    $('beginText').textContent = 'Collisions that can be felt. Drag something; Start adds sound and vibration, 12\u00a0dB below full scale.';
    const why = silentBecause();
    $('start').hidden = why !== '';
    if (why) $('beginText').textContent = why, $('output').textContent = 'Silent.';
    for (const id of ['scene', 'pause', 'again', 'sharing', 'start']) $(id).disabled = false;
    navigator.serviceWorker?.register('service-worker.js').catch(() => {}); // without it, the page needs the network
}
begin().catch(error => fault(`the page is not whole: ${error.message}; load it again`));
