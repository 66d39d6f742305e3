// SPDX-License-Identifier: MIT
import * as Phaser from 'phaser';
import { load } from 'physvib';
import { rumble } from 'physvib/gamepad';
import { attachVelocities } from 'physvib/velocities';

const physvib = await load(), field = { fieldWidth: 8, fieldHeight: 6 };
class Box extends Phaser.Scene {
    create() {
        const ball = this.physics.add.existing(this.add.circle(400, 100, 20, 0xffffff)), { world } = this.physics;
        ball.body.setBounce(0.7).setCollideWorldBounds(true);
        const haptics = attachVelocities(physvib, {
            bodies: () => [...world.bodies, ...world.staticBodies],
            read: (body, to) => Object.assign(to, { ...body.center, vx: body.velocity.x, vy: body.velocity.y, width: body.width, height: body.height, massKg: body.immovable ? 0 : body.mass }),
            bodyOf: thing => thing.body ?? thing, gravity: () => world.gravity, bounds: () => world.bounds,
        }, field);
        haptics.set(ball, { isSource: true, frequencyHz: 80, decayPerSecond: 20 });
        this.events.on('preupdate', () => haptics.look());
        world.on('worldstep', seconds => haptics.update(seconds));
        rumble(physvib, field).follow(haptics);
    }
}
new Phaser.Game({ width: 800, height: 600, physics: { default: 'arcade', arcade: { gravity: { y: 900 } } }, scene: Box });
