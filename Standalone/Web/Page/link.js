// SPDX-License-Identifier: MIT
// Encodes a complete world in a URL that gives the same samples in every browser. It follows the #, so servers do not receive it. Defaults are omitted.
export const mostEnchanters = 8;
export const corners = [[0, 1], [1, 1], [0, 0], [1, 0]];
export const firstScene = 'shake-the-box';
const mostBytes = 1 << 20; // of a scene in a link, unpacked
const mostVariables = 64, mostMaterials = 256;

export const freshWorld = () => ({ scene: firstScene, text: null, field: [0.12, 0.06], seed: 1, byHand: false, places: corners.map(place => [...place]), law: '', variables: new Map(), materials: new Map() });

/// Rounds to three decimals, in links and in the world alike.
export const rounded = value => Math.round(value * 1000) / 1000;
/// Rounds to four significant digits: frequencies and decays.
export const fourDigits = value => Number(value.toPrecision(4));

const toBase64 = bytes => btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join('')).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
const fromBase64 = text => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), letter => letter.charCodeAt(0));
const through = (bytes, stream) => new Blob([bytes]).stream().pipeThrough(stream);

const tooLarge = new Error('link: file: expected at most 1 MB, which a link can hold: send the file itself');
function expectFits(text) {
    if (new TextEncoder().encode(text).length > mostBytes) throw tooLarge;
    return text;
}
async function packed(text) { return toBase64(new Uint8Array(await new Response(through(new TextEncoder().encode(text), new CompressionStream('deflate-raw'))).arrayBuffer())); }
async function unpacked(code) {
    const parts = [], reader = through(fromBase64(code), new DecompressionStream('deflate-raw')).getReader();
    for (let bytes = 0; ;) {
        const { done, value } = await reader.read();
        if (done) return new TextDecoder().decode(new Uint8Array(await new Blob(parts).arrayBuffer()));
        if ((bytes += value.length) > mostBytes) throw tooLarge;
        parts.push(value);
    }
}

/// True for an event list. Lists of older versions and other programs have no field size, m.
export const isList = world => world.text !== null && world.scene.endsWith('.csv');

/// The URL part after the # for this world.
export async function linkOf(world) {
    const words = new URLSearchParams({ scene: world.scene });
    if (world.text !== null) words.set('file', await packed(expectFits(world.text)));
    if (isList(world)) words.set('field', world.field.join(','));
    if (world.seed !== 1) words.set('seed', world.seed);
    if (world.byHand) words.set('by', 'hand');
    for (const [name, value] of world.variables) words.append('set', `${name}=${value}`);
    if (JSON.stringify(world.places) !== JSON.stringify(corners)) words.set('at', world.places.map(place => place.map(rounded).join(',')).join(' '));
    if (world.law) words.set('law', world.law);
    for (const [index, sound] of world.materials) words.append('sound', [index, ...sound].join(','));
    return words.toString().replaceAll('%2C', ',').replaceAll('%3D', '=');
}

const wrong = (what, expected, found) => new Error(`link: ${what}: expected ${expected}, found ${JSON.stringify(String(found).slice(0, 40))}`);
const numbersOf = (text, count, what, expected, isGood) => {
    const numbers = text.split(',').map(word => (/^-?\d+(\.\d+)?$/.test(word) ? Number(word) : NaN));
    if (numbers.length !== count || !numbers.every(isGood)) throw wrong(what, expected, text);
    return numbers;
};

/// Parses a link (the part after the #, or, in older links, after the ?). Throws an Error with a one-line message if it is invalid.
export async function worldOf(text) {
    const words = new URLSearchParams(text), world = freshWorld();
    world.scene = (words.get('scene') || firstScene).slice(0, 200);
    if (/[\0-\x1f]/.test(world.scene)) throw wrong('scene', 'a name', world.scene);
    if (words.has('file')) {
        try { world.text = await unpacked(words.get('file')); } catch (error) { throw error === tooLarge ? error : new Error('link: file: expected a whole file; was the link cut off?'); }
    }
    if (words.has('field')) world.field = numbersOf(words.get('field'), 2, 'field', 'two lengths, m', value => value > 0 && value <= 1e6);
    if (words.has('seed')) [world.seed] = numbersOf(words.get('seed'), 1, 'seed', '0 to 4294967295', value => Number.isInteger(value) && value >= 0 && value < 2 ** 32);
    world.byHand = words.get('by') === 'hand';
    for (const pair of words.getAll('set').slice(0, mostVariables)) {
        const at = pair.indexOf('=');
        if (at < 1) throw wrong('set', 'NAME=VALUE', pair);
        world.variables.set(pair.slice(0, at), pair.slice(at + 1));
    }
    if (words.has('at')) {
        const places = words.get('at').split(' ');
        if (places.length > mostEnchanters) throw wrong('at', `1 to ${mostEnchanters} places`, places.length);
        world.places = places.map(place => numbersOf(place, 2, 'at', 'places of two numbers, 0 to 1', value => value >= 0 && value <= 1).map(rounded));
    }
    world.law = words.get('law') ?? '';
    for (const sound of words.getAll('sound').slice(0, mostMaterials)) {
        const [index, ...values] = numbersOf(sound, 3, 'sound', 'NUMBER,HZ,DECAY', value => value >= 0);
        if (!Number.isInteger(index) || index >= mostMaterials) throw wrong('sound', 'NUMBER,HZ,DECAY', sound);
        world.materials.set(index, values);
    }
    return world;
}

/// The arguments with which a player opens a world.
export const openedBy = (world, laws) => ({ name: world.scene, isName: world.text === null, bytes: new TextEncoder().encode(world.text ?? world.scene), byHand: world.byHand, seed: world.seed, field: world.field,
    variables: [...world.variables], materials: [...world.materials], places: world.places, law: laws.indexOf(world.law) });
