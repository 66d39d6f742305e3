// SPDX-License-Identifier: MIT
// Where no enchanter is connected: the strongest hits on a game controller's two motors, or on the phone's one.
const least = 0.02; // full scale; weaker hits would all feel alike
const lowHz = 160; // below it the heavy motor, above it the light one
const pulseMs = 40;

export class Rumble {
    isOn = false;
    #busyUntil = 0;

    play(hits, level) {
        const now = performance.now();
        if (!this.isOn || now < this.#busyUntil || !hits.length) return;
        const strongest = hits.reduce((a, b) => (Math.abs(b[4]) > Math.abs(a[4]) ? b : a));
        const strength = Math.min(1, Math.sqrt(Math.abs(strongest[4]) * level * 4)); // motors start late and feel alike: roots, as the waveforms
        if (strength < Math.sqrt(least)) return;
        this.#busyUntil = now + pulseMs;
        const isLow = strongest[2] < lowHz;
        for (const pad of navigator.getGamepads?.() ?? [])
            pad?.vibrationActuator?.playEffect?.('dual-rumble', { duration: pulseMs, strongMagnitude: isLow ? strength : 0, weakMagnitude: isLow ? 0 : strength }).catch(() => {});
        navigator.vibrate?.(Math.round(5 + 25 * strength));
    }
}
