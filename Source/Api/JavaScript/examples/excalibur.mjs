// SPDX-License-Identifier: MIT
import * as ex from 'excalibur';
import { load } from 'physvib';
import { rumble } from 'physvib/gamepad';
import { attachVelocities } from 'physvib/velocities';

const game = new ex.Engine({ width: 800, height: 600, suppressPlayButton: true, physics: { solver: ex.SolverStrategy.Realistic, gravity: ex.vec(0, 900) } }), scene = game.currentScene;
const ball = new ex.Actor({ x: 400, y: 100, radius: 20, collisionType: ex.CollisionType.Active });
game.add(ball);
const floor = new ex.Actor({ x: 400, y: 590, width: 800, height: 20, collisionType: ex.CollisionType.Fixed });
ball.body.bounciness = floor.body.bounciness = 0.7;
game.add(floor);

const physvib = await load(), field = { fieldWidth: 8, fieldHeight: 6 }, solid = [ex.CollisionType.Active, ex.CollisionType.Fixed];
const haptics = attachVelocities(physvib, {
    bodies: () => scene.actors.filter(actor => solid.includes(actor.body.collisionType)),
    read({ vel, body, collider: { bounds } }, to) {
        Object.assign(to, { x: bounds.center.x, y: bounds.center.y, vx: vel.x, vy: vel.y, width: bounds.width, height: bounds.height, massKg: body.collisionType === ex.CollisionType.Fixed ? 0 : body.mass });
    },
    gravity: () => scene.physics.config.gravity,
}, field);
haptics.set(ball, { isSource: true, frequencyHz: 80, decayPerSecond: 20 });
scene.on('preupdate', () => haptics.look());
scene.on('postupdate', ({ elapsed }) => haptics.update(elapsed / 1000));
rumble(physvib, field).follow(haptics);
game.start();
