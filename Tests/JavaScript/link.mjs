// SPDX-License-Identifier: MIT
// The web page's links: what is written is read again, and what is no link ends in one line. link.mjs [SCENE.json]: a scene that a link holds whole.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { freshWorld, linkOf, openedBy, worldOf } from '../../Standalone/Web/Page/link.js';

const text = readFileSync(process.argv[2] ?? new URL('../../Source/Scene/Scenes/shake-the-box.json', import.meta.url), 'utf8');
const full = () => ({ ...freshWorld(), scene: 'my scene & more.json', text, seed: 4294967295, byHand: true, places: [[0, 1], [0.123, 0.5], [1, 0.999]], law: 'log-outer',
    variables: new Map([['height', '2'], ['a=b', 'c=d & e']]), materials: new Map([[0, [205.3, 31.25]], [3, [20, 0.5]]]) });

test('a world comes back as it was, whatever is in it', async () => {
    assert.deepEqual(await worldOf(await linkOf(full())), { ...full(), variables: new Map([['height', '2'], ['a', 'b=c=d & e']]) }); // no variable has = in its name
    assert.deepEqual(await worldOf(await linkOf(freshWorld())), freshWorld());
    assert.equal(await linkOf(freshWorld()), 'scene=shake-the-box');
    assert.deepEqual(await worldOf(''), freshWorld());
    assert.deepEqual(await worldOf('scene=marbles&seed=3'), { ...freshWorld(), scene: 'marbles', seed: 3 }); // as older links have it
});

test('an event list takes its field along, and nothing else does', async () => {
    const list = { ...freshWorld(), scene: 'hits.csv', text: 'time_s', field: [6.4, 3.6] };
    assert.deepEqual(await worldOf(await linkOf(list)), list);
    assert.doesNotMatch(await linkOf({ ...list, scene: 'hits.json' }), /field/);
});

test('a whole scene is small enough for a QR code', async () => {
    const link = await linkOf({ ...full(), variables: new Map() });
    assert.ok(link.length < 2900, `${link.length} characters of ${text.length}`);
});

test('what a player opens of it', () => {
    const opened = openedBy(full(), ['linear', 'log', 'log-outer', 'energy']);
    assert.ok(!opened.isName && opened.law === 2 && opened.bytes.length === Buffer.byteLength(text) && opened.materials.length === 2);
    assert.equal(openedBy(freshWorld(), ['linear']).law, -1);
});

for (const [words, line] of [['seed=-1', /seed: expected 0 to/], ['seed=1.5', /seed/], ['seed=1e3', /seed/], ['at=0,0 2,0', /at: expected places/], ['at=0', /at/], ['at=' + Array(9).fill('0,0').join('+'), /at: expected 1 to 8/],
    ['field=1', /field: expected two lengths/], ['field=0,1', /field/], ['sound=0,200', /sound/], ['sound=a,1,1', /sound/], ['sound=0.5,1,1', /sound/], ['sound=4294967296,100,30', /sound/], ['scene=drop%00x', /scene: expected a name/], ['set=height', /set: expected NAME=VALUE/], ['file=%%%', /file: expected a whole file/], ['file=AAAA', /file/]])
    test(`${words.slice(0, 30)} is refused`, async () => assert.rejects(worldOf(words), line));

test('what is larger than a link may hold is refused on both sides, with its reason', async () => {
    const line = { message: 'link: file: expected at most 1 MB, which a link can hold: send the file itself' }, most = 1 << 20;
    await assert.rejects(linkOf({ ...freshWorld(), scene: 'list.csv', text: ' '.repeat(most + 1) }), line);
    await assert.rejects(linkOf({ ...freshWorld(), text: '\u00e9'.repeat(most / 2 + 1) }), line); // bytes, not letters
    const link = await linkOf({ ...freshWorld(), text: ' '.repeat(most) });
    assert.equal((await worldOf(link)).text.length, most);
    const bomb = new Blob([new Uint8Array(4 * most)]).stream().pipeThrough(new CompressionStream('deflate-raw')), code = Buffer.from(await new Response(bomb).arrayBuffer()).toString('base64url');
    assert.ok(code.length < 10000);
    await assert.rejects(worldOf(`file=${code}`), line);
});

test('anything else is a world or an error of one line', async () => {
    let seed = 1;
    const random = below => (seed = (seed * 48271) % 2147483647) % below;
    const link = await linkOf(full()), signs = '0123456789,. -+=&%;#/\\aset\u0000é';
    for (let i = 0; i < 2000; ++i) {
        const letters = [...link];
        for (let n = 1 + random(4); n > 0; --n) letters.splice(random(letters.length), random(3), signs[random(signs.length)]);
        try {
            const { places, seed: read, materials } = await worldOf(letters.join(''));
            assert.ok(places.length >= 1 && places.length <= 8 && places.flat().every(share => share >= 0 && share <= 1) && Number.isInteger(read) && [...materials.values()].flat().every(Number.isFinite));
        } catch (error) {
            assert.ok(error.message.startsWith('link: ') && !error.message.includes('\n'), error.stack);
        }
    }
});
