// SPDX-License-Identifier: MIT
// The page: its knobs, and what the audio thread tells.
import { Tilt, dragOn } from './hands.js';
import { materialColour } from './look.js';
import { Rumble } from './rumble.js';
import { Scope } from './scope.js';
import { Sound, mostEnchanters } from './sound.js';
import { World } from './world.js';

const $ = id => document.getElementById(id);
const decibels = value => value.toFixed(0).replace('-', '−') + ' dB';
const tellMs = 1000; // for so long the strongest hit is told
const arrangements = { 'four corners': [[0, 1], [1, 1], [0, 0], [1, 0]], 'left and right': [[0, 0.5], [1, 0.5]], 'three in a row': [[0, 0.5], [0.5, 0.5], [1, 0.5]], 'one in the middle': [[0.5, 0.5]] };
const asked = new URLSearchParams(location.search);

export const world = new World($('world'));
const sound = new Sound(told), scope = new Scope($('scope')), rumble = new Rumble();
const tilt = new Tilt($('tilt'), message => sound.tell(message));
const seed = Number(asked.get('seed') ?? 1) >>> 0;
let current = { isName: true, name: asked.get('scene') ?? 'shake-the-box' }, next = current; // that plays; that was asked for
let best = { at: 0 }; // hit of the last second
world.places = [...arrangements['four corners']];
$('scene').add(new Option(current.name.replaceAll('-', ' ')));

// ---- what is wanted
const utf8 = new TextEncoder();
const wanted = () => ({ ...next, bytes: next.bytes ?? utf8.encode(next.name), seed, byHand: !$('byItself').checked, places: world.places });

function open(scene) {
    next = scene;
    sound.tell({ open: wanted() });
    tilt.turn(0);
}
async function openFile(file) {
    if (file) choose({ isName: false, name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
}
function choose(scene) {
    fault('');
    open(scene);
}
function fault(line) {
    $('fault').textContent = line;
    $('fault').hidden = !line;
}

// ---- what is told
function told({ fault: line, scenes, scene, isPlayed, poses, hits, blocks, count }) {
    if (line) fault(line), (next = current);
    if (scenes) list(scenes);
    if (scene) show(JSON.parse(scene), isPlayed);
    if (!poses) return;
    world.poses = poses;
    world.add(hits);
    scope.add(blocks, count);
    rumble.play(hits, gain());
    hits.forEach(tellHit);
}
function list(lines) {
    $('scene').replaceChildren();
    for (let i = 0; i < lines.length; i += 2) $('scene').add(new Option(lines[i].replaceAll('-', ' '), lines[i]));
    for (const id of ['scene', 'pause', 'again']) $(id).disabled = false;
    $('scene').value = current.isName ? current.name : '';
    if (!world.scene) open({ isName: true, name: lines[0] }); // what was asked for was refused
}
function show(scene, isPlayed) {
    current = next;
    world.show(scene);
    tilt.isPlayed = isPlayed;
    $('materials').replaceChildren(...scene.materials.flatMap((material, i) => (material.frequency_hz ? [materialRow(material, i)] : [])));
    $('scene').value = current.isName ? current.name : '';
}
function tellHit([, , hz, decay, amplitude]) {
    const time = performance.now();
    if (time - best.at < tellMs && Math.abs(amplitude) < best.amplitude) return;
    best = { at: time, amplitude: Math.abs(amplitude) };
    const material = world.scene.materials.find(m => Math.abs(m.frequency_hz - hz) < 0.01);
    $('sentence').textContent = `${material ? material.name + ' · ' : ''}${hz.toFixed(0)} Hz · τ ${decay.toFixed(0)} /s · ${decibels(20 * Math.log10(best.amplitude))}`;
}
function tellOutput() {
    const count = world.places.length, way = sound.isDirect(count) ? 'each actuator on its own output' : 'heard as a stereo monitor: this device has ' + sound.outputs + (sound.outputs === 1 ? ' output' : ' outputs');
    $('output').textContent = `${count} ${count === 1 ? 'actuator' : 'actuators'}, ${way} · ${sound.rate / 1000} kHz`;
}

// ---- materials: both sliders go by ratios, as what is felt does
function materialRow(material, index) {
    const row = document.createElement('div');
    row.className = 'material';
    row.innerHTML = '<i></i><b></b><label><span></span><input type="range" min="0" max="1" step="0.005"></label><label><span></span><input type="range" min="0" max="1" step="0.005"></label>';
    row.querySelector('i').style.background = materialColour(index);
    row.querySelector('b').textContent = material.name;
    const [frequency, decay] = [...row.querySelectorAll('label')].map(label => ({ words: label.firstChild, slider: label.lastChild }));
    bind(frequency, material, 'frequency_hz', 20, 1000, value => `${value.toFixed(0)} Hz`);
    bind(decay, material, 'decay_per_s', 2, 500, value => `falls by 60 dB in ${(6.908 / value).toFixed(2)} s`);
    row.addEventListener('input', () => sound.tell({ sound: [index, material.frequency_hz, material.decay_per_s] }));
    return row;
}
function bind({ words, slider }, material, field, least, most, text) {
    slider.value = Math.log(material[field] / least) / Math.log(most / least);
    slider.setAttribute('aria-label', material.name + ' ' + field);
    const say = () => (words.textContent = text(material[field]));
    slider.addEventListener('input', () => say((material[field] = least * (most / least) ** slider.value)));
    say();
}

// ---- enchanters
function arrange(places) {
    world.places = places;
    world.chosen = Math.min(world.chosen, places.length - 1);
    sound.tell({ places });
    if ($('begin').hidden) sound.connect(places), tellOutput();
    $('attach').disabled = places.length >= mostEnchanters;
    $('detach').disabled = places.length <= 1;
}
for (const name of Object.keys(arrangements)) $('preset').add(new Option(name));
$('preset').onchange = () => arrange([...arrangements[$('preset').value]]);
$('attach').onclick = () => arrange([...world.places, [0.5, 0.5 - 0.08 * (world.places.length % 5)]]); // beside the last one
$('detach').onclick = () => arrange(world.places.filter((_, j) => j !== (world.chosen < 0 ? world.places.length - 1 : world.chosen)));
dragOn(world, message => sound.tell(message), isDone => (isDone ? arrange(world.places) : sound.tell({ places: world.places })));

// ---- the bar
const gain = () => (isPressed('silence') || +$('level').value <= -60 ? 0 : 10 ** ($('level').value / 20));
const setPressed = (id, isOn) => $(id).setAttribute('aria-pressed', isOn);
const isPressed = id => $(id).getAttribute('aria-pressed') === 'true';
$('level').oninput = () => {
    sound.setLevel(gain());
    $('levelText').textContent = +$('level').value > -60 ? decibels(+$('level').value) : 'silent';
};
$('scene').onchange = () => choose({ isName: true, name: $('scene').value });
$('open').onclick = () => $('file').click();
$('file').onchange = () => openFile($('file').files[0]).then(() => ($('file').value = ''));
$('again').onclick = $('byItself').onchange = () => open(current);
$('pause').onclick = () => { setPressed('pause', !isPressed('pause')); sound.pause(isPressed('pause')); };
function silence(isSilent) {
    setPressed('silence', isSilent);
    sound.setLevel(gain());
}
$('silence').onclick = () => silence(!isPressed('silence'));
$('rumble').onchange = () => (rumble.isOn = $('rumble').checked);
$('sensor').hidden = !Tilt.hasSensor;
$('sensor').onclick = async () => setPressed('sensor', await tilt.followSensor());
document.addEventListener('keydown', event => {
    if (event.key === 'Escape') silence(true);
    else if (!event.target.matches('input, select')) tilt.key(event);
});
document.addEventListener('dragover', event => event.preventDefault());
document.addEventListener('drop', event => { event.preventDefault(); openFile(event.dataTransfer.files[0]); });

// ---- sound begins on a click, never before
$('start').onclick = async () => {
    $('start').disabled = true;
    try {
        await sound.start(wanted());
        $('begin').hidden = true;
        tellOutput();
        sound.setLevel(gain());
    } catch (error) {
        fault('sound does not start here: ' + error.message);
        $('start').disabled = false;
    }
};
(function draw() {
    world.draw();
    scope.draw();
    requestAnimationFrame(draw);
})();
