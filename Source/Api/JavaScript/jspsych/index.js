// SPDX-License-Identifier: MIT
// A jsPsych 8 plug-in: plays a strike, pattern, phantom, path or clip, and writes into the trial what was played, when, and with which gains.
import { ParameterType } from 'jspsych';
import { eventsOf, lengthOf } from './stimulus.js';

const info = {
    name: 'physvib',
    version: '@PHYSVIB_VERSION@',
    parameters: {
        /** Of play(physvib, context), from physvib/audio. */
        output: { type: ParameterType.COMPLEX, default: undefined },
        /** { message: 'strike', 'pattern', 'phantom', 'path' or 'clip', ... }. A clip: { message: 'clip', clip }, of physvib.readClip at the context's rate. */
        stimulus: { type: ParameterType.COMPLEX, default: undefined },
        prompt: { type: ParameterType.HTML_STRING, default: '' },
        choices: { type: ParameterType.KEYS, default: 'NO_KEYS' },
        /** From the trial's start to the stimulus' onset, ms; less than 20 may be late. */
        delay: { type: ParameterType.INT, default: 50 },
        /** From the onset on, ms; null: as long as the stimulus, or until a key if there are choices. */
        trial_duration: { type: ParameterType.INT, default: null },
        response_ends_trial: { type: ParameterType.BOOL, default: true },
    },
    data: {
        /** The stimulus, as it was asked for. */
        call: { type: ParameterType.STRING },
        /** When its first sample left, in frames and seconds of the audio context. */
        onset_frame: { type: ParameterType.INT },
        onset_s: { type: ParameterType.FLOAT },
        /** What the browser says that its device adds, s; null: it does not say. */
        output_latency_s: { type: ParameterType.FLOAT },
        /** Of each event of the stimulus, its time from the onset (s) and the gain of each channel. */
        times_s: { type: ParameterType.COMPLEX },
        gains: { type: ParameterType.COMPLEX },
        /** Whether it came too late for its onset. */
        late: { type: ParameterType.BOOL },
        /** What left for the device from its onset to its end, as measured, of each channel: { frames, peak, meanSquare, running }. Not running: not all of it left. */
        left: { type: ParameterType.COMPLEX },
        response: { type: ParameterType.STRING },
        /** From the onset, ms. */
        rt: { type: ParameterType.INT },
    },
};

export default class PhysVibPlugin {
    static info = info;
    constructor(jsPsych) { this.jsPsych = jsPsych; }

    trial(element, trial) {
        const { output, stimulus } = trial, { context, physvib, settings } = output, { currentTime: now, sampleRate: rate } = context;
        element.innerHTML = trial.prompt;
        const frame = Math.ceil((now + trial.delay / 1000) * rate), seconds = frame / rate, isClip = stimulus.message === 'clip';
        const events = isClip ? [] : eventsOf(physvib, settings, stimulus);
        if (isClip) output.playSamples(stimulus.clip.channels, seconds);
        else output.strike(events, Math.round(seconds * 1e9));
        const onset = isClip ? frame : frame + output.latencyFrames; // what the limiter looks ahead
        const { clip, ...call } = stimulus, length = isClip ? clip.channels[0].length / rate : lengthOf(events);
        const lateBefore = output.status.late, start = performance.now() + (onset / rate - now) * 1000;
        const data = {
            call: JSON.stringify(call), onset_frame: onset, onset_s: onset / rate, output_latency_s: context.outputLatency ?? null,
            times_s: events.map(event => event.timeNs * 1e-9), gains: events.map(event => physvib.gains(event.x, event.y, settings)), response: null, rt: null,
        };
        this.#wait(trial, data, start, (onset / rate - now + length) * 1000, () => {
            element.innerHTML = '';
            const known = Math.max(data.onset_s, Math.min(data.onset_s + length, context.currentTime - 0.1)); // what is newer is not yet told
            this.jsPsych.finishTrial({ ...data, late: output.status.late > lateBefore, left: output.left(data.onset_s, known) });
        });
    }

    #wait(trial, data, start, untilMs, end) {
        const { pluginAPI } = this.jsPsych, hasKeys = trial.choices !== 'NO_KEYS';
        const finish = () => {
            pluginAPI.clearAllTimeouts();
            pluginAPI.cancelAllKeyboardResponses();
            end();
        };
        if (hasKeys) {
            pluginAPI.getKeyboardResponse({ valid_responses: trial.choices, rt_method: 'performance', persist: false, allow_held_key: false, callback_function: ({ key }) => {
                Object.assign(data, { response: key, rt: Math.round(performance.now() - start) });
                if (trial.response_ends_trial) finish();
            } });
        }
        if (trial.trial_duration !== null) pluginAPI.setTimeout(finish, start - performance.now() + trial.trial_duration);
        else if (!hasKeys || !trial.response_ends_trial) pluginAPI.setTimeout(finish, untilMs + 250); // and what the audio thread says of it
    }
}
