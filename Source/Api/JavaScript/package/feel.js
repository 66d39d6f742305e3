// SPDX-License-Identifier: MIT
// Haptics in one call: attaches to an engine and plays on all devices that the page has, with one field.
import { play } from './audio.js';
import { attach as box2d3 } from './box2d3.js';
import { expectThat } from './explanation.js';
import { rumble } from './gamepad.js';
import { attach as matter } from './matter.js';
import { load } from './physvib.js';
import { attach as planck } from './planck.js';
import { attach as rapier2d } from './rapier2d.js';
import { attach as rapier3d } from './rapier3d.js';
import { attachVelocities } from './velocities.js';

// How each engine is recognised, and what attaches to it. The other options go to the outputs.
const kinds = [
    [engine => engine.world && engine.pairs && engine.timing, matter],
    [engine => engine.getBodyList && engine.on, planck],
    [engine => engine.narrowPhase && engine.gravity.z !== undefined, rapier3d],
    [engine => engine.narrowPhase, rapier2d],
    [(engine, { b2 }) => b2 && engine.index1 > 0, box2d3],
    [engine => engine.subsystems && engine.contacts, (...given) => import('./cannon.js').then(({ attach }) => attach(...given))], // those that few pages need
    [engine => engine.getPhysicsEngine || engine.havok, (...given) => import('./havok.js').then(({ attach }) => attach(...given))],
    [engine => engine.Jolt && engine.interface, (...given) => import('./jolt.js').then(({ attach }) => attach(...given))],
    [engine => engine.mujoco && engine.model, (...given) => import('./mujoco.js').then(({ attach }) => attach(...given))],
    [engine => typeof engine.bodies === 'function' && engine.read, attachVelocities],
];
const heardLevel = 0.1; // 20 dB below full scale, as libphysvib-live's
const gestures = ['pointerdown', 'keydown', 'touchend'], early = { capture: true };

class Felt {
    #closed = false; #begin = () => this.#open();
    /** The output, from the first user gesture on; null before, and without audio. */
    output = null;
    /** The same hits for ears, if they were asked for and the device has outputs for them: left and right by their place. */
    sound = null;
    /** Error that kept the output from starting, if any. */
    error = null;
    constructor(physvib, haptics, { context, pads, ...options }) {
        Object.assign(this, { physvib, haptics, pads });
        this.#options = options;
        this.#context = context;
        pads?.follow(haptics);
        if (context || globalThis.navigator?.userActivation?.hasBeenActive) this.#begin();
        else for (const name of gestures) globalThis.document?.addEventListener(name, this.#begin, early);
    }
    #options; #context; #isOwn = false;
    // Browsers play no audio before a click or a key.
    async #open() {
        for (const name of gestures) globalThis.document?.removeEventListener(name, this.#begin, early);
        try {
            this.#isOwn = !this.#context;
            this.#context ??= new AudioContext();
            await this.#context.resume();
            const { sound, ...options } = this.#options, output = await play(this.physvib, this.#context, options), ears = sound && this.#earsOf(sound, output, options), heard = ears ? await play(this.physvib, this.#context, ears).catch(error => this.#failed(error)) : null;
            if (this.#closed) return void [output, heard].forEach(each => each?.close());
            Object.assign(this, { output, sound: heard });
            for (const each of [output, heard]) each?.follow(this.haptics);
        } catch (error) {
            this.#failed(error);
        }
    }
    #failed(error) {
        this.error = error;
        console.error(`PhysVib: no sound, the game goes on: ${error.message}`);
        return null;
    }
    // The two outputs behind the actuators', if none are given. With two in all, the monitor is what is heard.
    #earsOf({ outputs, level = heardLevel }, { channels, isDirect, context }, { latency, worklet, fieldWidth, fieldHeight }) {
        if (!isDirect || (!outputs && context.destination.maxChannelCount < channels + 2)) return null;
        const layout = { extentWidth: fieldWidth, extentHeight: fieldHeight, places: [0, fieldWidth].map(x => ({ x, y: fieldHeight / 2 })) };
        return { outputs: outputs ?? [channels + 1, channels + 2], level, layout, law: 'energy', latency, worklet, fieldWidth, fieldHeight };
    }
    /** As haptics.set; a string is the material of a source. */
    set(body, values = {}) { return this.haptics.set(body, typeof values === 'string' ? { isSource: true, material: values } : values); }
    update(seconds) { this.haptics.update(seconds); }
    explain() { return (this.error ? `${this.error.message} ` : this.output ? '' : 'Nothing plays before the first click or key. ') + this.haptics.explain(); }
    close() {
        this.#closed = true;
        for (const name of gestures) globalThis.document?.removeEventListener(name, this.#begin, early);
        this.output?.close();
        this.sound?.close();
        this.pads?.close();
        this.haptics.free();
        if (this.#isOwn) this.#context?.close?.();
    }
}

export async function feel(engine, { physvib, pixelsPerMetre, metresPerUnit = pixelsPerMetre ? 1 / pixelsPerMetre : undefined, fieldWidth = 1, fieldHeight = fieldWidth, layout, outputs, level, sound, latency, worklet, context, profile, phone, ...settings } = {}) {
    const kind = kinds.find(([isOne]) => isOne(Object(engine), settings));
    expectThat(kind !== undefined, 'feel', "an engine's world (of Matter, Planck, Rapier, box2d3-wasm with b2, cannon-es, Babylon's scene, { havok, world, bodies }, { Jolt, interface }, { mujoco, model, data }, or { bodies, read })", engine);
    physvib ??= await load();
    const haptics = await kind[1](physvib, engine, { fullScaleImpulse: 'automatic', ...settings, fieldWidth, fieldHeight, ...(metresPerUnit && { metresPerUnit }) });
    const field = { fieldWidth, fieldHeight }, given = Object.fromEntries(Object.entries({ layout, outputs, level, sound, latency, worklet }).filter(([, value]) => value !== undefined));
    try {
        const pads = globalThis.navigator?.getGamepads ? rumble(physvib, { ...field, ...(profile && { profile }), ...(phone !== undefined && { phone }), ...(latency && { latency }) }) : null;
        return new Felt(physvib, haptics, { ...field, ...given, context, pads });
    } catch (error) {
        haptics.free();
        throw error;
    }
}
