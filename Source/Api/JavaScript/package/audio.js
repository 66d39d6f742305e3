// SPDX-License-Identifier: MIT
// On the device of a page: a renderer in an AudioWorklet, each actuator on its own output where there are as many, else a stereo monitor.
import { Clock, followed } from './clock.js';
import { expectLibrary, expectThat, naming } from './explanation.js';
import { impactOf } from './impact.js';
import { PhysVibError } from './physvib.js';

const nsPerSecond = 1e9;
const firstLevel = 0.25; // 12 dB below full scale: hands and ears may be attached

const expectLevel = level => expectThat(level >= 0 && level <= 1, 'level', '0 to 1', level);

class Output {
    #physvib; #context; #node; #mix; #level; #gain; #muted = new Set(); #pans = []; #clock; #size; #ends = new Set(); #arrivals = [];
    /** Frames by which samples lag the events' times: the limiter's look-ahead. */
    latencyFrames = 0;
    /** What the audio thread has done, four times a second. */
    status = { liveModes: 0, pending: 0, frames: 0, played: 0, late: 0, rejected: 0, refused: 0 };
    /** Frames that the browser left out, while its audio thread stood still: they are over, and nothing is late for them. */
    skipped = 0;
    /** What ended the audio thread, told once on the console; null: nothing did. */
    error = null;

    constructor(physvib, context, { worklet, latency, level = firstLevel, ...settings }) {
        expectLevel(level);
        const { bytes, channels } = naming('latency, level, worklet', () => physvib.settingsBytes({ ...settings, rate: context.sampleRate }));
        this.#physvib = physvib;
        this.#context = context;
        this.#clock = new Clock(latency);
        this.settings = settings;
        this.channels = channels;
        this.#size = physvib.sizes;
        this.#node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [Math.min(32, channels)],
            processorOptions: { module: physvib.module, settings: bytes, channels, eventBytes: this.#size.event, statusBytes: this.#size.renderer_status } });
        this.opened = new Promise((done, failed) => {
            this.#node.onprocessorerror = () => failed(this.#ended('it stopped'));
            this.#node.port.onmessage = ({ data }) => {
                if (data.error !== undefined) failed(this.#ended(data.error));
                else if (data.status) {
                    Object.assign(this.status, physvib.statusOf(data.status));
                    this.skipped = data.skipped;
                }
                else if (data.hasArrived) this.#arrivals.shift().done();
                else if (data.isOpen) {
                    this.latencyFrames = data.latencyFrames;
                    done(this);
                }
                else failed(new PhysVibError(-2, 'settings: expected some that can be rendered'));
            };
        });
        this.#mix = new GainNode(context, { channelCount: Math.min(32, channels), channelCountMode: 'explicit', channelInterpretation: 'discrete' });
        this.#node.connect(this.#mix);
        this.#level = new GainNode(context, { gain: this.#gain = level });
        this.#connect(settings.layout ?? 'phone4');
    }

    // Nothing is felt from then on, and nobody waits for it.
    #ended(why) {
        if (this.error === null) {
            this.error = new PhysVibError(-8, `audio: the audio thread has ended (${why}): close this output, and play anew`);
            console.error(`PhysVib: ${this.error.message}`);
            for (const { failed } of this.#arrivals.splice(0)) failed(this.error);
        }
        return this.error;
    }

    /** Whether each actuator has an output of its own. */
    get isDirect() { return this.#context.destination.maxChannelCount >= this.channels && this.channels > 2; }
    /** From a collision to its vibration, in seconds, before the device's own latency. */
    get latency() { return this.#clock.latencyNs / nsPerSecond; }
    get context() { return this.#context; }
    get physvib() { return this.#physvib; }
    /** How often a game stood still for longer than the latency, or changed its pace, and was aligned anew. */
    get moves() { return this.#clock.moves; }
    /** What it plays, a channel per actuator, before level and monitor: to be recorded, or connected elsewhere. */
    get node() { return this.#node; }

    #connect(layout) {
        const { destination } = this.#context, { isDirect } = this, width = isDirect ? this.channels : 2, { places, extentWidth } = typeof layout === 'string' ? this.#physvib.layout(layout) : layout;
        if (destination.maxChannelCount > 0 && 'channelCount' in destination) {
            destination.channelCount = Math.min(width, destination.maxChannelCount);
            destination.channelInterpretation = 'discrete';
        }
        Object.assign(this.#level, { channelCount: width, channelCountMode: 'explicit', channelInterpretation: isDirect ? 'discrete' : 'speakers' });
        this.#level.connect(destination);
        if (isDirect) return this.#mix.connect(this.#level);
        const split = new ChannelSplitterNode(this.#context, { numberOfOutputs: this.channels });
        this.#mix.connect(split);
        this.#pans = [split];
        places.forEach(({ x }, j) => {
            const pan = new StereoPannerNode(this.#context, { pan: Math.max(-1, Math.min(1, 2 * x / extentWidth - 1)) });
            split.connect(pan, j).connect(this.#level);
            this.#pans.push(pan);
        });
    }

    /** For World.explain. */
    get facts() {
        const { late, rejected } = this.status, mutedChannels = [...this.#muted].reduce((all, j) => all + 2 ** j, 0);
        return { channels: this.channels, level: this.#gain, mutedChannels, late, rejected, settings: this.settings };
    }
    hint() {
        const { state } = this.#context;
        return this.error?.message ?? { suspended: 'The AudioContext is suspended: call resume() in a click.', interrupted: 'The AudioContext is interrupted: call resume() in a click.', closed: 'The AudioContext is closed: play anew.' }[state];
    }

    #now() { return this.#context.currentTime * nsPerSecond; }
    #tell(message) { this.#node.port.postMessage(message); }

    /** What `haptics` (of attach) feels from now on. What it returns ends that. */
    follow(haptics) {
        // A context that is suspended stands still: what happens meanwhile is not felt later.
        const end = followed(haptics, this.#clock, () => (['suspended', 'interrupted'].includes(this.#context.state) ? undefined : this.#now()), events => this.strike(events, 0));
        const leave = () => {
            this.#ends.delete(leave);
            haptics.outputs?.delete(this);
            end();
        };
        haptics.outputs?.add(this);
        this.#ends.add(leave);
        return leave;
    }

    /** Events, `laterNs` after the times they have: as a rule, the context's time in ns. Late ones are played at once, and counted. */
    strike(events, laterNs = this.#now()) {
        const bytes = this.#physvib.eventBytes(events.map(event => ({ ...event, timeNs: Math.max(0, event.timeNs + laterNs) })));
        this.#tell({ events: bytes });
    }

    /** Resolves when what was struck so far is on the audio thread: wait for it before an OfflineAudioContext renders, which may be faster than messages. */
    arrived() {
        return new Promise((done, failed) => {
            if (this.error) return failed(this.error);
            this.#arrivals.push({ done, failed });
            this.#tell({ isAsked: true });
        });
    }

    /** One impact now: { x, y, strength, material }. */
    impact(hit) { this.strike([impactOf(hit)]); }

    /** Samples of yours, a channel per actuator, at the context's rate, from that time of the context (s) on. */
    playSamples(channels, seconds = this.#context.currentTime) {
        if (channels.length !== this.channels) throw new PhysVibError(-2, `samples: expected ${this.channels} channels, found ${channels.length}`);
        const buffer = new AudioBuffer({ numberOfChannels: channels.length, length: channels[0].length, sampleRate: this.#context.sampleRate });
        channels.forEach((channel, j) => buffer.copyToChannel(channel, j));
        const source = new AudioBufferSourceNode(this.#context, { buffer });
        source.connect(this.#mix);
        source.start(seconds);
        return source;
    }

    /** Of one channel, or of all, at once: gains glide for 10 ms. */
    setGain(channel, gain) { this.#tell({ call: 'set_gain', timeNs: this.#now(), values: [channel, gain] }); }
    setMute(channel, isMuted) {
        this.#muted[isMuted ? 'add' : 'delete'](channel);
        this.#tell({ call: 'set_mute', timeNs: this.#now(), values: [channel, isMuted ? 1 : 0] });
    }
    setLevel(gain) {
        expectLevel(gain);
        this.#level.gain.setTargetAtTime(this.#gain = gain, this.#context.currentTime, 0.0015);
    }
    setLayout(settings) {
        const { bytes } = this.#physvib.settingsBytes({ ...this.settings, ...settings });
        Object.assign(this.settings, settings);
        this.#tell({ call: 'set_layout', timeNs: this.#now(), settings: bytes });
    }
    /** All that rings, and what has happened so far, is felt no more. */
    silence() { this.#tell({ call: 'silence', timeNs: this.#now(), values: [this.#now() + this.#clock.latencyNs] }); }

    close() {
        for (const end of this.#ends) end();
        this.#ends.clear();
        this.#tell({ close: true });
        for (const node of [this.#node, this.#mix, this.#level, ...this.#pans]) node.disconnect();
    }
}

const modules = new WeakMap(), besides = new Map(); // of contexts; and addresses of texts

function addressOf(text) {
    if (!besides.has(text)) besides.set(text, URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
    return besides.get(text);
}

// Once for each context: a second module of the same name is refused, and the audio thread stands still while it is read.
function added(context, physvib, place) {
    if (!modules.has(context)) {
        const address = place ?? (physvib.worklet ? addressOf(physvib.worklet) : new URL('./worklet.js', import.meta.url));
        modules.set(context, context.audioWorklet.addModule(address).catch(error => {
            modules.delete(context);
            throw new PhysVibError(-4, `${address}: expected the audio worklet's worklet.js (${error.message}): put the package's file there, or tell play() where it is (option worklet)`);
        }));
    }
    return modules.get(context);
}

/** `context`: an AudioContext, made or resumed by a click. `options`: those of a renderer, latency (s), level, worklet (where worklet.js is). */
export async function play(physvib, context, options = {}) {
    expectLibrary('play', physvib);
    if (!context.audioWorklet) {
        throw new PhysVibError(-3, globalThis.isSecureContext === false ? 'audio: this page came by http; browsers give sound of this kind to https and to localhost'
            : 'audio: expected a browser with AudioWorklet');
    }
    await added(context, physvib, options.worklet);
    return new Output(physvib, context, options).opened;
}
