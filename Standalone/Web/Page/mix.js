// SPDX-License-Identifier: MIT
// Panel with the materials, variables and actuators of a world. It only reports requested changes.
import { fourDigits, rounded } from './link.js';
import { enchanterColours, letter, materialColour } from './look.js';

const made = (tag, values, ...children) => {
    const element = Object.assign(document.createElement(tag), values);
    element.append(...children);
    return element;
};

/// Rows of materials; both sliders are logarithmic, like perception. `changed(index, [hz, decay])`.
export function materialRows(materials, sounds, changed) {
    return materials.flatMap((material, index) => {
        if (!material.frequency_hz) return [];
        const [frequency, decay] = sounds.get(index) ?? [material.frequency_hz, material.decay_per_s], sound = [frequency, decay];
        const colour = made('i', {});
        colour.style.background = materialColour(index);
        const row = made('div', { className: 'material' }, colour, made('b', { textContent: material.name }),
            slider(sound, 0, 20, 1000, `${material.name}: frequency`, value => [`${value.toFixed(0)} Hz`, `${value.toFixed(0)} hertz`]),
            slider(sound, 1, 2, 500, `${material.name}: decay`, value => [`falls by 60 dB in ${(6.908 / value).toFixed(2)} s`, `falls by 60 decibels in ${(6.908 / value).toFixed(2)} seconds`]));
        row.addEventListener('input', () => changed(index, sound));
        return [row];
    });
}
function slider(sound, which, least, most, name, words) {
    const text = made('span', {}), input = made('input', { type: 'range', min: 0, max: 1, step: 0.005 });
    input.value = Math.log(sound[which] / least) / Math.log(most / least);
    input.setAttribute('aria-label', name);
    const say = () => {
        const [shown, spoken] = words(sound[which]);
        text.textContent = shown;
        input.setAttribute('aria-valuetext', spoken);
    };
    input.addEventListener('input', () => {
        sound[which] = fourDigits(least * (most / least) ** input.value);
        say();
    });
    say();
    return made('label', {}, text, input);
}

/// `lines`: name, value and choices of each variable. `chosen(name, value)`.
export function variableRows(lines, chosen) {
    return lines.split('\n\n').filter(Boolean).map(block => {
        const [name, value, ...choices] = block.split('\n'), select = made('select', {}, ...choices.map(choice => new Option(choice)));
        select.value = value;
        select.onchange = () => chosen(name, select.value);
        return made('label', { className: 'choice', textContent: name }, select);
    });
}

const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const percent = share => `${Math.round(100 * share)} %`;

/// One button per actuator, moved by arrow keys. `moved(index, place)`, `chose(index)`.
export function badgeButtons(places, moved, chose) {
    return places.map((place, index) => {
        const button = made('button', { className: 'badge', textContent: letter(index) });
        button.style.color = enchanterColours[index];
        button.setAttribute('aria-label', `Actuator ${letter(index)} at ${percent(place[0])} from the left, ${percent(place[1])} from below`);
        button.onclick = () => chose(index);
        button.onkeydown = event => {
            const way = ways[event.key], step = event.shiftKey ? 0.1 : 0.02;
            if (!way) return;
            event.preventDefault();
            moved(index, place.map((share, axis) => rounded(Math.min(1, Math.max(0, share + step * way[axis])))));
        };
        return button;
    });
}
