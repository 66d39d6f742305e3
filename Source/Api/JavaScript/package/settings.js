// SPDX-License-Identifier: MIT
// A renderer's settings in memory: layouts and panning laws by their names.
/** Renderer settings in memory, `use(at)`; a layout is a name or { extentWidth, extentHeight, places: [{ x, y, z, part }] }; z and part may be left out. */
export function withSettings(module, { layout, law, limiter, ...settings }, use) {
    return module.filled('renderer_settings', { ...settings, law: lawOf(module, law), limiter: limiter === undefined ? undefined : Boolean(limiter) }, (at, size) => {
        const place = at + module.placeOf('renderer_settings', 'layout');
        if (typeof layout === 'string') module.withText(layout, name => module.call('layout_preset', name, place));
        else if (layout !== undefined) putLayout(module, place, layout);
        return use(at, size);
    });
}

function putLayout(module, at, { extentWidth, extentHeight, places }) {
    module.put('layout', at, { extentWidth, extentHeight, x: places.map(place => place.x), y: places.map(place => place.y), count: places.length,
        z: places.map(place => place.z ?? 0), part: places.map(place => place.part ?? 0) });
}

export function layoutAt(module, at) {
    const { extentWidth, extentHeight, x, y, z, part, count } = module.get('layout', at);
    const inSpace = j => ({ ...(z[j] !== 0 && { z: z[j] }), ...(part[j] !== 0 && { part: part[j] }) });
    return { extentWidth, extentHeight, places: Array.from({ length: count }, (_, j) => ({ x: x[j], y: y[j], ...inSpace(j) })) };
}

export function lawsOf(module) {
    const laws = [];
    for (let at; (at = module.run('physvib_law_name', laws.length)) !== 0;) laws.push(module.text(at));
    return laws;
}
function lawOf(module, law) {
    if (typeof law !== 'string') return law;
    const known = lawsOf(module).indexOf(law);
    return known < 0 ? law : known; // a word that is none is refused as such
}

/** How many channels settings in memory ask for. */
export function channelsOf(module, at) {
    const { channels } = module.get('renderer_settings', at);
    return channels || module.get('layout', at + module.placeOf('renderer_settings', 'layout')).count;
}
