// SPDX-License-Identifier: MIT
import kaplay from 'kaplay';
import { load } from 'physvib';
import { rumble } from 'physvib/gamepad';
import { attachVelocities } from 'physvib/velocities';

const k = kaplay({ width: 800, height: 600, global: false });
k.setGravity(900);
const ball = k.add([k.rect(40, 40), k.pos(400, 100), k.area(), k.body({ mass: 2 })]);
k.add([k.rect(800, 20), k.pos(0, 580), k.area(), k.body({ isStatic: true })]);

const physvib = await load(), field = { fieldWidth: 8, fieldHeight: 6 };
const haptics = attachVelocities(physvib, {
    bodies: () => k.get('body').filter(thing => thing.has('area')),
    read(thing, to) {
        const { pos, width, height } = thing.worldArea().bbox();
        Object.assign(to, { x: pos.x + width / 2, y: pos.y + height / 2, vx: thing.vel.x, vy: thing.vel.y, width, height, massKg: thing.isStatic ? 0 : thing.mass });
    },
    gravity: () => ({ x: 0, y: k.getGravity() }),
}, field);
haptics.set(ball, { isSource: true, frequencyHz: 80, decayPerSecond: 20 });
k.onUpdate(() => haptics.update(k.dt()));
k.onUpdate(() => { if (ball.isGrounded()) ball.jump(500); }); // the game's own
k.onUpdate(() => haptics.look());
rumble(physvib, field).follow(haptics);
