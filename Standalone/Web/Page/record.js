// SPDX-License-Identifier: MIT
// Exports recorded playback as files with the package's own writers: samples, an event list, and formats of phones and controllers.
import { eventsText, wav, writeClip } from './files.js';

const extent = [0.12, 0.06]; // m, of the actuators' places

/// An impact of a report as an event of the package.
export const eventOf = ([x, y, frequencyHz, decayPerSecond, amplitude, duration, at, kind], since = 0) =>
    ({ x, y, frequencyHz, decayPerSecond, amplitude, durationNs: duration * 1e9, timeNs: (at - since) * 1e9, kind: ['hit', 'roll', 'slide'][kind] });

/// The files { name, bytes } of each format, or why there are none. `world`: places, law; `field`: its size, m.
export function filesOf(compiled, title, { channels, rate, hits, since }, { places, law }, [fieldWidth, fieldHeight]) {
    const events = hits.map(hit => eventOf(hit, since)), [extentWidth, extentHeight] = extent;
    const layout = { extentWidth, extentHeight, places: places.map(([x, y]) => ({ x: x * extentWidth, y: y * extentHeight })) };
    const clip = ending => writeClip(compiled, events, `${title}.${ending}`, { layout, law: law || undefined, fieldWidth, fieldHeight });
    const made = {
        WAV: () => [{ name: `${title}.wav`, bytes: wav(compiled, channels, rate) }],
        events: () => [{ name: `${title}.csv`, bytes: eventsText(compiled, events, { fieldWidth, fieldHeight }) }],
        '.haptic': () => clip('haptic'),
        '.ahap': () => clip('ahap'),
    };
    return Object.entries(made).map(([format, make]) => {
        try {
            if (format !== 'WAV' && events.length === 0) throw new Error('no hits');
            return { format, files: make() };
        } catch (error) {
            return { format, fault: error.message };
        }
    });
}

/// Download links, one group per format.
export function fileLinks(formats) {
    return formats.map(({ format, files = [], fault }) => {
        const group = document.createElement('span');
        group.append(fault ? `${format}: ${fault}` : files.length > 1 ? format : '');
        for (const { name, bytes } of files) {
            const link = Object.assign(document.createElement('a'), { download: name, href: URL.createObjectURL(new Blob([bytes])) });
            link.textContent = files.length > 1 ? name.match(/-(\w+)\.\w+$/)[1] : format;
            link.setAttribute('aria-label', `${link.textContent}: save ${name}`);
            group.append(link);
        }
        return group;
    });
}
