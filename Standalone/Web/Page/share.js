// SPDX-License-Identifier: MIT
// Shares the current world as a link and a QR code.
import { linkOf } from './link.js';
import { Module } from './module.js';

const $ = id => document.getElementById(id);
const quietModules = 4, modulePixels = 4; // around a QR code, and of each of its modules

/// Draws a QR code in black and white on a canvas; false if the text is too long.
export function drawCode(compiled, text, canvas) {
    const module = new Module(compiled), side = module.withText(text, at => module.run('qrSide', at)); // an instance that is thrown away
    if (side === 0) return false;
    const context = canvas.getContext('2d');
    canvas.width = canvas.height = (side + 2 * quietModules) * modulePixels;
    context.fillStyle = '#fff';
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.fillStyle = '#000';
    for (let y = 0; y < side; ++y)
        for (let x = 0; x < side; ++x) if (module.run('qrModule', x, y)) context.fillRect((x + quietModules) * modulePixels, (y + quietModules) * modulePixels, modulePixels, modulePixels);
    return true;
}

/// Copies the link and displays it.
export async function share(compiled, world) {
    const link = `${location.origin}${location.pathname}#${await linkOf(world)}`;
    history.replaceState(null, '', link);
    $('link').value = link;
    const isCopied = await (navigator.clipboard?.writeText(link).then(() => true, () => false) ?? false);
    $('copied').textContent = isCopied ? 'Copied.' : 'Copy it from here:';
    const isOwn = /^(localhost|127\.[\d.]+|\[::1\])$/.test(location.hostname), fits = !isOwn && drawCode(compiled, link, $('code')); // such an address works on this computer only
    $('code').hidden = !fits;
    $('codeNote').textContent = fits ? 'Or go on with a phone:' : isOwn ? 'No phone can open this address, which only this computer has: Standalone/Web/serve.py serves the page to phones.' : 'This scene is too large for a QR code; the link holds all of it.';
    $('share').showModal();
    $('link').select();
}
