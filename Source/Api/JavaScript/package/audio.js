// SPDX-License-Identifier: MIT
// Output on the audio device of a page: a renderer in an AudioWorklet, each actuator on an output of its own if there are enough, else a stereo monitor.
import { Clock, followed } from './clock.js';
import { Route, Watch, buzzOf, expectOutputs, stands } from './device.js';
import { expectLibrary, expectThat, naming } from './explanation.js';
import { impactOf } from './impact.js';
import { PhysVibError } from './physvib.js';
import { Receipts } from './receipts.js';

const nsPerSecond = 1e9;
const firstLevel = 0.25; // 12 dB below full scale: hands and ears may be attached
const mostChannels = 32; // of Web Audio
const lateMs = 1000; // for so long an output says that it was late
const waitMs = 500; // what is meant for now waits as long for a context that resumes

const expectLevel = level => expectThat(level >= 0 && level <= 1, 'level', '0 to 1', level);

class Output extends EventTarget {
    #physvib; #context; #node; #mix; #level; #meter; #gain; #muted = new Set(); #route; #outputs; #watch; #receipts; #latency; #clocks = new Set(); #idle; #moves = 0; #size; #ends = new Set(); #arrivals = []; #told = 'running'; #lateAt = -Infinity;
    /** Frames by which samples lag the events' times: the limiter's look-ahead. */
    latencyFrames = 0;
    /** What the audio thread has done, four times a second. */
    status = { liveModes: 0, pending: 0, frames: 0, played: 0, late: 0, rejected: 0, refused: 0 };
    /** Frames that the browser left out, while its audio thread stood still: they are over, and nothing is late for them. */
    skipped = 0;
    /** What ended the audio thread, told once on the console; null: nothing did. */
    error = null;
    /** Hits that were meant for a time at which the context stood still: they are over. */
    dropped = 0;
    /** Called with each state event. */
    onstate = null;

    constructor(physvib, context, { worklet, latency, level = firstLevel, outputs, ...settings }) {
        super();
        expectLevel(level);
        const { bytes, channels } = naming('latency, level, outputs, worklet', () => physvib.settingsBytes({ ...settings, rate: context.sampleRate }));
        expectThat(channels <= mostChannels, 'layout', `at most ${mostChannels} actuators, the most of a browser`, channels);
        expectOutputs(outputs, channels, context);
        this.#physvib = physvib;
        this.#context = context;
        this.#latency = latency;
        this.#idle = new Clock(latency); // says the latency until somebody follows
        this.settings = settings;
        this.channels = channels;
        this.#outputs = outputs;
        this.#size = physvib.sizes;
        this.#node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [channels],
            processorOptions: { module: physvib.module, settings: bytes, channels, eventBytes: this.#size.event, timeAt: this.#size.timeAt, statusBytes: this.#size.renderer_status } });
        this.opened = new Promise((done, failed) => {
            this.#node.onprocessorerror = () => failed(this.#ended('it stopped'));
            this.#node.port.onmessage = ({ data }) => {
                if (data.error !== undefined) failed(this.#ended(data.error));
                else if (data.status) this.#note(data);
                else if (data.refused) console.error(`PhysVib: ${data.refused} was refused: expected values in their range, and fewer changes while the context stands still`);
                else if (data.hasArrived) this.#arrivals.shift().done();
                else if (data.isOpen) {
                    this.latencyFrames = data.latencyFrames;
                    done(this);
                }
                else failed(new PhysVibError(-2, 'settings: expected some that can be rendered'));
            };
        });
        const each = { channelCount: channels, channelCountMode: 'explicit', channelInterpretation: 'discrete' };
        this.#mix = new GainNode(context, each);
        this.#level = new GainNode(context, { ...each, gain: this.#gain = level });
        this.#meter = new AudioWorkletNode(context, 'physvib-meter', { ...each, outputChannelCount: [channels] });
        this.#receipts = new Receipts(channels, context.sampleRate);
        this.#meter.port.onmessage = ({ data }) => { if (!this.#watch.isMissing) this.#receipts.add(data); };
        this.#node.connect(this.#mix).connect(this.#level).connect(this.#meter);
        this.#route = new Route(context, this.#meter);
        this.#connect();
        this.#watch = new Watch(context, () => this.#changed());
        this.#told = this.#watch.state;
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

    #note({ status, skipped }) {
        const { late } = this.status;
        Object.assign(this.status, this.#physvib.statusOf(status));
        this.skipped = skipped;
        if (this.status.late > late) this.#lateAt = performance.now();
        this.#changed();
    }
    #changed() {
        const { state } = this;
        this.#route.follow();
        if (state === this.#told) return;
        this.#told = state;
        if (this.#watch.isMissing) this.#receipts.forget(this.#watch.since);
        const event = Object.assign(new Event('state'), { state });
        this.onstate?.(event);
        this.dispatchEvent(event);
    }

    /** Whether each actuator has an output of its own, as it is connected now. */
    get isDirect() { return this.#route.isDirect; }
    /** 'running', 'suspended', 'device lost', or for a second after events came late 'late'. */
    get state() {
        const { state } = this.#watch;
        return state === 'running' && performance.now() - this.#lateAt < lateMs ? 'late' : state;
    }
    /** Whether the context runs within a second, on another device where its own is gone. To be called in a click. */
    resume() { return this.#watch.resume(); }
    get #latencyNs() { return Math.max(...Array.from(this.#clocks.size > 0 ? this.#clocks : [this.#idle], ({ latencyNs }) => latencyNs)); }
    /** From a collision to its vibration, in seconds, before the device's own latency; of several worlds that follow, the longest. */
    get latency() { return this.#latencyNs / nsPerSecond; }
    get context() { return this.#context; }
    get physvib() { return this.#physvib; }
    /** How often a game stood still for longer than the latency, or changed its pace, and was aligned anew. */
    get moves() { return [...this.#clocks].reduce((sum, { moves }) => sum + moves, this.#moves); }
    /** What it plays, a channel per actuator, before level and monitor: to be recorded, or connected elsewhere. */
    get node() { return this.#node; }

    #connect() {
        const { layout = 'phone4' } = this.settings, { places, extentWidth } = typeof layout === 'string' ? this.#physvib.layout(layout) : layout;
        this.#route.connect(Array.from({ length: this.channels }, (_, j) => Math.max(-1, Math.min(1, 2 * (places[j]?.x ?? extentWidth / 2) / extentWidth - 1))), this.#outputs);
    }

    /** For World.explain. */
    get facts() {
        const { late, rejected } = this.status, mutedChannels = [...this.#muted].reduce((all, j) => all + 2 ** j, 0);
        return { channels: this.channels, level: this.#gain, mutedChannels, late, rejected, settings: this.settings };
    }
    hint() {
        const { state } = this.#watch, missed = this.dropped > 0 ? ` Hits that came while it stood still and were dropped: ${this.dropped}.` : '';
        const why = this.#context.state === 'closed' ? 'The AudioContext is closed: play anew.' : { suspended: 'The AudioContext is suspended: call resume() in a click.', 'device lost': 'The sound device is lost: connect one, and call resume() of the output in a click; if that does not help, play in another AudioContext.' }[state];
        return this.error?.message ?? (why && why + missed);
    }
    /** For World.explain, of its sentence: what left since the last one, instead of what should have. */
    measured(sentence) {
        const strongest = this.#receipts.takeStrongest(), { last } = this.#receipts, { state } = this.#watch;
        const why = this.error ? 'its audio thread has ended' : state === 'running' ? 'they are on their way, or gains are 0; ask again in a tenth of a second' : state === 'suspended' ? 'the context is suspended' : 'the device is lost';
        return sentence.replace(/, and reach the output: (if .*)$/, (_, then) => (strongest > 0 ? `, and what left the output reached ${(100 * strongest).toPrecision(2)} % of full scale: ${then}`
            : `, and nothing has left the output ${last === null ? 'since it was opened' : `since ${last.toFixed(1)} s of the context's time`}: ${why}.`));
    }
    /** What left for the device between two times of the context (s): of each actuator { frames, peak, meanSquare, running }, in whole blocks of 128 frames. */
    left(from, to) {
        expectThat(from >= 0 && to >= from, 'left', 'two times of the context, s, in order', `${from}, ${to}`);
        return this.#receipts.left(from, to);
    }

    #now() { return this.#context.currentTime * nsPerSecond; }
    #tell(message) { this.#node.port.postMessage(message); }

    /** What `haptics` (of attach) feels from now on. What it returns ends that. */
    follow(haptics) {
        // A context that is suspended stands still: what happens meanwhile is not felt later. Each world has a time of its own.
        const clock = new Clock(this.#latency), end = followed(haptics, clock, () => (stands(this.#context) ? undefined : this.#now()), events => this.strike(events, 0), count => { this.dropped += count; });
        this.#clocks.add(clock);
        const leave = () => {
            this.#ends.delete(leave);
            if (this.#clocks.delete(clock)) this.#moves += clock.moves;
            haptics.outputs?.delete(this);
            end();
        };
        haptics.outputs?.add(this);
        this.#ends.add(leave);
        return leave;
    }

    /** Events, `laterNs` after the times they have: left out, now, and dropped where the context stands still for half a second. Late ones are played at once, and counted. */
    strike(events, laterNs) {
        const nowNs = laterNs === undefined ? this.#now() : undefined, bytes = this.#physvib.eventBytes(events.map(event => ({ ...event, timeNs: Math.max(0, event.timeNs + (nowNs ?? laterNs)) })));
        const tell = () => this.#tell({ events: bytes, nowNs });
        if (nowNs === undefined) tell();
        else this.#soon(tell, events.length);
    }
    // Plays events now; they are dropped and counted if the context has stood still for half a second.
    #soon(tell, count) {
        if (!stands(this.#context)) return tell();
        const act = ({ type }) => {
            this.#context.removeEventListener('statechange', act);
            clearTimeout(timer);
            if (type === 'statechange' && !stands(this.#context)) tell();
            else this.dropped += count;
        }, timer = setTimeout(act, waitMs, {});
        this.#context.addEventListener('statechange', act);
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

    /** Samples of yours, a channel per actuator, at the context's rate, from that time of the context (s) on; without one now, as what is struck. */
    playSamples(channels, seconds) {
        if (channels.length !== this.channels) throw new PhysVibError(-2, `samples: expected ${this.channels} channels, found ${channels.length}`);
        const buffer = new AudioBuffer({ numberOfChannels: channels.length, length: channels[0].length, sampleRate: this.#context.sampleRate });
        channels.forEach((channel, j) => buffer.copyToChannel(channel, j));
        const source = new AudioBufferSourceNode(this.#context, { buffer });
        source.connect(this.#mix);
        if (seconds === undefined) this.#soon(() => source.start(), 1);
        else source.start(seconds);
        return source;
    }

    /** Which is which: 0.3 s of 200 Hz at one actuator, at half of full scale times the level; resolves when it is over. */
    async buzz(actuator) {
        this.#expectChannel(actuator);
        expectThat(this.#watch.state === 'running', 'buzz', 'a device that runs', this.#watch.state);
        const source = buzzOf(this.#context, this.channels, actuator);
        source.connect(this.#mix);
        source.start();
        return new Promise(done => { source.onended = () => done(); });
    }

    #expectChannel(channel) { expectThat(Number.isInteger(channel) && channel >= 0 && channel < this.channels, 'actuator', `0 to ${this.channels - 1}`, channel); }
    /** Of one channel, or of all, at once: gains glide for 10 ms. */
    setGain(channel, gain) {
        this.#expectChannel(channel);
        expectThat(gain >= 0 && gain <= 10000, 'gain', '0 to 10000', gain);
        this.#tell({ call: 'set_gain', timeNs: this.#now(), values: [channel, gain] });
    }
    setMute(channel, isMuted) {
        this.#expectChannel(channel);
        this.#muted[isMuted ? 'add' : 'delete'](channel);
        this.#tell({ call: 'set_mute', timeNs: this.#now(), values: [channel, isMuted ? 1 : 0] });
    }
    setLevel(gain) {
        expectLevel(gain);
        this.#level.gain.setTargetAtTime(this.#gain = gain, this.#context.currentTime, 0.0015);
    }
    setLayout(settings) {
        const all = { ...this.settings, ...settings }, { bytes, channels } = this.#physvib.settingsBytes(all);
        expectThat(channels === this.channels, 'layout', `${this.channels} actuators (for others close this output, and play anew)`, channels);
        this.#physvib.gains(0, 0, all); // refuses what the audio thread would
        Object.assign(this.settings, settings);
        this.#tell({ call: 'set_layout', timeNs: this.#now(), settings: bytes });
        if (!this.isDirect) this.#connect();
    }
    /** All that rings, and what has happened so far, is felt no more. */
    silence() { this.#tell({ call: 'silence', timeNs: this.#now(), values: [this.#now() + this.#latencyNs] }); }

    close() {
        for (const end of this.#ends) end();
        this.#ends.clear();
        this.#watch.end();
        this.#route.disconnect();
        for (const node of [this.#node, this.#meter]) node.port.postMessage({ close: true });
        for (const node of [this.#node, this.#mix, this.#level]) node.disconnect();
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
            throw new PhysVibError(-4, `${address}: expected the audio worklet's worklet.js (${error.message}): ${String(address).startsWith('blob:null') ? 'serve this page by http; a file, or a frame in a sandbox, may read none' : "put the package's file there, or tell play() where it is (option worklet)"}`);
        }));
    }
    return modules.get(context);
}

/** `context`: an AudioContext, made or resumed by a click. `options`: those of a renderer, latency (s), level, outputs (of the device, from 1), worklet (where worklet.js is). */
export async function play(physvib, context, options = {}) {
    expectLibrary('play', physvib);
    expectThat(Object(context) === context, 'play', 'an AudioContext', context);
    if (!context.audioWorklet) {
        throw new PhysVibError(-3, globalThis.isSecureContext === false ? 'audio: this page came by http; browsers give sound of this kind to https and to localhost'
            : 'audio: expected a browser with AudioWorklet');
    }
    await added(context, physvib, options.worklet);
    const output = new Output(physvib, context, options);
    return output.opened.catch(error => {
        output.close();
        throw error;
    });
}
