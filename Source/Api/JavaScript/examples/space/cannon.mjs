// SPDX-License-Identifier: MIT
// A ball that bounces in cannon-es: in Node, or a page.
import { Body, Box, ContactMaterial, Material, Sphere, Vec3, World } from 'cannon-es';
import { feel } from 'physvib/feel';

const world = new World({ gravity: new Vec3(0, -9.81, 0) }), rubber = new Material();
world.addContactMaterial(new ContactMaterial(rubber, rubber, { restitution: 0.5 }));
const ball = new Body({ mass: 0.2, shape: new Sphere(0.1), position: new Vec3(0, 0.9, 0), material: rubber });
world.addBody(ball);
world.addBody(new Body({ mass: 0, shape: new Box(new Vec3(5, 0.5, 5)), position: new Vec3(0, -0.5, 0), material: rubber }));

const felt = await feel(world, { fieldWidth: 4, fieldHeight: 3, fieldX: -2 });
felt.set(ball, 'wooden board');
felt.haptics.follow(events => { for (const { timeNs, impulse } of events) console.log(`${(timeNs * 1e-6).toFixed(0)} ms: ${impulse.toFixed(2)} N s`); });
for (let i = 0; i < 120; ++i) world.step(1 / 60); // a page: world.fixedStep() in each frame
felt.close();
