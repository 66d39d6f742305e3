// SPDX-License-Identifier: MIT
// User input: drags bodies and actuators, with several fingers, and tilts the world by slider, keys or the phone's motion sensor.
const degreesPerKey = 15, tellEveryMs = 30, mostFingers = 10;

/// `tell` sends a message to the player; `moved(isDone)` reports that an actuator was moved.
export function dragOn(world, tell, moved) {
    const { canvas } = world, holds = new Map(); // by pointer id: the body or actuator that it drags
    const at = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    const thingAt = (x, y) => {
        if (!world.scene) return null;
        const actuator = world.enchanterAt(x, y), body = actuator < 0 ? world.bodyAt(x, y) : -1;
        return actuator < 0 && body < 0 ? null : { actuator, body };
    };
    const freeFinger = () => { for (let finger = 0; ; ++finger) if (![...holds.values()].some(hold => hold.finger === finger)) return finger; };
    const follow = event => {
        const { finger, body, actuator } = holds.get(event.pointerId);
        if (body >= 0) tell({ grip: [finger, body, ...world.metresAt(...at(event))] });
        if (actuator < 0 || actuator >= world.places.length) return;
        world.places[actuator] = world.placeAt(...at(event));
        moved(false);
    };
    canvas.addEventListener('touchstart', event => { // a swipe beside bodies and actuators scrolls the page
        if ([...event.changedTouches].some(touch => thingAt(...at(touch)))) event.preventDefault();
    }, { passive: false });
    canvas.addEventListener('pointerdown', event => {
        const thing = event.button === 0 && holds.size < mostFingers ? thingAt(...at(event)) : null;
        world.chosen = thing?.actuator ?? -1;
        if (!thing) return;
        holds.set(event.pointerId, { finger: freeFinger(), ...thing });
        canvas.setPointerCapture(event.pointerId);
        follow(event);
    });
    canvas.addEventListener('pointermove', event => {
        if (holds.has(event.pointerId)) return follow(event);
        if (event.pointerType === 'mouse') canvas.style.cursor = thingAt(...at(event)) ? 'grab' : '';
    });
    const letGo = ({ pointerId }) => {
        const hold = holds.get(pointerId);
        if (!hold) return;
        holds.delete(pointerId);
        if (hold.body >= 0) tell({ letGo: [hold.finger] });
        else moved(true);
    };
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, letGo);
}

/// Tilts the world by slider and keys, which control the player in a scene that has one.
export class Tilt {
    isPlayed = false;
    #told = 0; #followed = null;
    constructor(slider, tell) {
        this.slider = slider;
        this.tell = tell;
        slider.addEventListener('input', () => {
            this.show(slider.value);
            this.hold((-slider.value * Math.PI) / 180, 1);
        });
        slider.addEventListener('dblclick', () => this.turn(0));
    }
    hold(angleRadians, factor) { this.tell({ hold: [angleRadians, factor] }); }
    /// Updates the slider only; the world already has that tilt.
    show(degrees) {
        this.slider.value = degrees;
        this.slider.setAttribute('aria-valuetext', `${degrees} degrees`);
    }
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
    /// Follows the motion sensor or stops. To be called on a click, when phones ask for permission. Returns whether it follows.
    async follow(isOn) {
        if (this.#followed) window.removeEventListener('deviceorientation', this.#followed);
        if (this.#followed && !isOn) this.turn(0);
        this.#followed = null;
        if (!isOn || (await DeviceOrientationEvent.requestPermission?.().catch(() => 'denied')) === 'denied') return false;
        window.addEventListener('deviceorientation', this.#followed = event => this.#lean(event));
        return true;
    }
    // Gravity in the plane of the display: zero if the phone lies on a table, largest if it is upright.
    #lean({ beta, gamma }) {
        if (beta === null || performance.now() - this.#told < tellEveryMs) return;
        this.#told = performance.now();
        const b = (beta * Math.PI) / 180, c = (gamma * Math.PI) / 180, turned = ((screen.orientation?.angle ?? 0) * Math.PI) / 180;
        const right = Math.cos(b) * Math.sin(c), down = Math.sin(b);
        this.hold(Math.atan2(right, down) + turned, Math.hypot(right, down));
    }
}
