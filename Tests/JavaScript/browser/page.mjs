// SPDX-License-Identifier: MIT
// Within the page: what a visitor does, and what the page's own thread renders without a device. browsers.mjs puts it into index.html.
import { assert, run, test } from './node.mjs';

const complaints = [], $ = id => document.getElementById(id), later = ms => new Promise(done => setTimeout(done, ms));
addEventListener('error', event => complaints.push(event.message));
addEventListener('unhandledrejection', ({ reason }) => complaints.push(String(reason?.message ?? reason)));
/** Until that holds, for 20 s at most. */
async function until(holds, what) {
    for (const began = performance.now(); !holds(); await later(20)) if (performance.now() - began > 20000) throw new Error(`there is not: ${what}`);
}
let sum = null;

test('the world moves before the click', async () => {
    await until(() => $('start')?.disabled === false, 'a page that can start');
    const { world } = await import('/page/page.js');
    await until(() => world.poses.length, 'poses');
    const before = [...world.poses];
    await until(() => world.poses.some((value, i) => Math.abs(value - before[i]) > 0.05), 'motion');
});
test('samples without a device', async () => {
    const { freshWorld, openedBy } = await import('/page/link.js'), first = await openedBy({ ...freshWorld(), scene: 'marbles', seed: 3 }, []), rate = 48000, seconds = 5;
    const context = new OfflineAudioContext(8, rate * seconds, rate), code = await (await fetch('physvib.wasm')).arrayBuffer();
    await context.audioWorklet.addModule('worklet.js');
    const node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [8], processorOptions: { code, first } });
    node.connect(context.destination);
    await later(500); // WebKit renders before the thread has its code
    const samples = await context.startRendering(), hash = first.places.map((_, j) => samples.getChannelData(j).reduce((all, sample) => (all * 31 + Math.round(sample * 1e9)) | 0, 0));
    assert.ok(hash.some(part => part !== 0), 'silence');
    sum = hash.join();
});
test('sound begins with the click, and hits are told', async () => {
    const { connect } = AudioWorkletNode.prototype;
    const heard = new Promise((done, failed) => {
        AudioWorkletNode.prototype.connect = function (...to) {
            this.watched ??= this.port.addEventListener('message', ({ data }) => data.blocks?.some(level => level !== 0) && done()) ?? true;
            return connect.apply(this, to);
        };
        setTimeout(() => failed(new Error('nothing is heard within 20 s')), 20000);
    });
    $('start').click();
    await heard;
    await until(() => $('sentence').textContent.includes('Hz'), 'a hit that is told');
});
test('a bad scene is refused, and the world goes on', async () => {
    const { world } = await import('/page/page.js'), transfer = new DataTransfer();
    transfer.items.add(new File(['{ "physvib_scene": 1 '], 'bad.json'));
    $('file').files = transfer.files;
    $('file').dispatchEvent(new Event('change'));
    await until(() => !$('fault').hidden, 'a refusal');
    assert.match(document.querySelector('#fault p').textContent, /^bad\.json/);
    $('again').click();
    await until(() => world.poses.length, 'a world');
});
test('nothing on the console', () => assert.deepEqual(complaints, []));

run().then(told => parent.postMessage({ ...told, sum }, '*'));
