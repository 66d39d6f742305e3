// SPDX-License-Identifier: MIT
// Colours of the page, equal to those of PhysVib's windows.
export const ground = '#0e0f12', line = '#2b2e38', text = '#e6e8ee', muted = '#959bab', now = '#f6c667', camera = '#d8c69a';
export const enchanterColours = ['#4fd1c5', '#f6ad55', '#b794f4', '#68d391', '#63b3ed', '#f687b3', '#d6d765', '#a3b1c6'];
const materialColours = ['#d14b5a', '#c98d3c', '#9fb3cb', '#a79fb5', '#b7906b', '#5a93c9', '#a9744f', '#9aa04a'];
export const materialColour = index => materialColours[index % materialColours.length];
export const letter = index => String.fromCharCode(65 + index);

/// Clears a canvas at its size on the page and the display's resolution. Returns its context, in CSS pixels.
export function fresh(canvas) {
    const scale = devicePixelRatio, width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * scale)) canvas.width = Math.round(width * scale);
    if (canvas.height !== Math.round(height * scale)) canvas.height = Math.round(height * scale);
    const context = canvas.getContext('2d');
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    return context;
}
