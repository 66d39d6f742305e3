// SPDX-License-Identifier: MIT
import type { Clip } from 'physvib';

interface Place { x: number; y: number }
interface Tone { frequencyHz?: number; /** 0 to 1 (0.5). */ level?: number }

/** Places are metres of the field; left out: the middle of the actuators. */
export type Stimulus =
    | { message: 'strike'; frequencyHz: number; decayPerSecond?: number; level?: number; seconds?: number; place?: Place }
    | ({ message: 'pattern'; actuators: string; pulseSeconds?: number; gapSeconds?: number } & Tone)
    | ({ message: 'phantom'; seconds?: number; place?: Place } & Tone)
    | ({ message: 'path'; from: Place; to: Place; seconds?: number } & Tone)
    | { message: 'clip'; clip: Clip };

/** jsPsych's: { type: PhysVibPlugin, output, stimulus, ... }. */
export default class PhysVibPlugin {
    static info: object;
    constructor(jsPsych: any);
    trial(element: HTMLElement, trial: any): void;
}
