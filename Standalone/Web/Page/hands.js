// SPDX-License-Identifier: MIT
// What hands do: drag bodies and enchanters, tilt the world by slider, keys or the phone's own sensor.
const degreesPerKey = 15, tellEveryMs = 30;

/// `tell` sends a message to the audio thread; `moved(isDone)` says that an enchanter is elsewhere.
export function dragOn(world, tell, moved) {
    const { canvas } = world;
    let body = -1, enchanter = -1;
    const at = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    canvas.addEventListener('pointerdown', event => {
        if (!world.scene || !event.isPrimary) return;
        enchanter = world.chosen = world.enchanterAt(...at(event));
        body = enchanter < 0 ? world.bodyAt(...at(event)) : -1;
        if (body < 0 && enchanter < 0) return;
        canvas.setPointerCapture(event.pointerId);
        follow(event);
    });
    const follow = event => {
        if (body >= 0) tell({ grip: [body, ...world.metresAt(...at(event))] });
        if (enchanter < 0) return;
        world.places[enchanter] = world.placeAt(...at(event));
        moved(false);
    };
    canvas.addEventListener('pointermove', event => {
        if (body >= 0 || enchanter >= 0) return follow(event);
        if (world.scene && event.pointerType === 'mouse') canvas.style.cursor = world.enchanterAt(...at(event)) >= 0 || world.bodyAt(...at(event)) >= 0 ? 'grab' : '';
    });
    const letGo = () => {
        if (body >= 0) tell({ letGo: [] });
        if (enchanter >= 0) moved(true);
        body = enchanter = -1;
    };
    canvas.addEventListener('pointerup', letGo);
    canvas.addEventListener('pointercancel', letGo);
}

/// The slider's way of tilting, and that of the keys: they play where the scene has a player.
export class Tilt {
    isPlayed = false;
    #told = 0;
    constructor(slider, tell) {
        this.slider = slider;
        this.tell = tell;
        slider.addEventListener('input', () => this.hold((-slider.value * Math.PI) / 180, 1));
        slider.addEventListener('dblclick', () => this.turn(0));
    }
    hold(angleRadians, factor) { this.tell({ hold: [angleRadians, factor] }); }
    turn(degrees) {
        this.slider.value = degrees;
        this.slider.dispatchEvent(new Event('input'));
    }
    key(event) {
        const way = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: 0 }[event.key];
        if (way === undefined) return;
        event.preventDefault();
        if (this.isPlayed) this.tell({ steer: [way] });
        else this.turn(way ? +this.slider.value + way * degreesPerKey : 0);
    }

    static get hasSensor() { return 'DeviceOrientationEvent' in window && matchMedia('(pointer: coarse)').matches; }
    /// Gravity in the plane of the display: the world lies still on a table and is heaviest upright.
    async followSensor() {
        if ((await DeviceOrientationEvent.requestPermission?.()) === 'denied') return false;
        window.addEventListener('deviceorientation', ({ beta, gamma }) => {
            if (beta === null || performance.now() - this.#told < tellEveryMs) return;
            this.#told = performance.now();
            const b = (beta * Math.PI) / 180, c = (gamma * Math.PI) / 180, turned = ((screen.orientation?.angle ?? 0) * Math.PI) / 180;
            const right = Math.cos(b) * Math.sin(c), down = Math.sin(b);
            this.hold(Math.atan2(right, down) + turned, Math.hypot(right, down));
        });
        return true;
    }
}
