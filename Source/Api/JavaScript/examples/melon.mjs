// SPDX-License-Identifier: MIT
import * as me from 'melonjs';
import { load } from 'physvib';
import { rumble } from 'physvib/gamepad';
import { attachVelocities } from 'physvib/velocities';

await new Promise(done => me.device.onReady(done));
me.video.init(800, 600, { renderer: me.video.CANVAS });
const physvib = await load(), field = { fieldWidth: 8, fieldHeight: 6 }, { world } = me.game, { fps } = world;
world.gravity.set(0, 0.25); // pixels and steps: 900 pixels/s2
class Thing extends me.Renderable {
    constructor(x, y, width, height) {
        super(x, y, width, height);
        this.anchorPoint.set(0, 0);
        this.body = new me.Body(this, new me.Rect(0, 0, width, height));
    }
    draw() {}
    onCollision() { return true; }
}
class Box extends me.Stage {
    onResetEvent() {
        const ball = world.addChild(new Thing(380, 80, 40, 40)), floor = world.addChild(new Thing(0, 580, 800, 20));
        ball.body.bounce = 0.7;
        floor.body.setStatic(true);
        const haptics = attachVelocities(physvib, {
            bodies: () => world.bodies,
            read: (body, to) => Object.assign(to, { x: body.ancestor.pos.x + body.getBounds().centerX, y: body.ancestor.pos.y + body.getBounds().centerY, vx: body.vel.x * fps, vy: body.vel.y * fps,
                width: body.getBounds().width, height: body.getBounds().height, massKg: body.isStatic ? 0 : body.mass, gravityScale: body.ignoreGravity ? 0 : body.mass * body.gravityScale }),
            bodyOf: thing => thing.body ?? thing, gravity: () => ({ x: world.gravity.x * fps ** 2, y: world.gravity.y * fps ** 2 }),
        }, field);
        haptics.set(ball, { isSource: true, frequencyHz: 80, decayPerSecond: 20 });
        me.event.on(me.event.GAME_UPDATE, () => haptics.look());
        me.event.on(me.event.WORLD_STEP, () => haptics.update(1 / fps));
        rumble(physvib, field).follow(haptics);
    }
}
me.state.set(me.state.PLAY, new Box());
me.state.change(me.state.PLAY);
