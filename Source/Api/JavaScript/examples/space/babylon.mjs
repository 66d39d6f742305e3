// SPDX-License-Identifier: MIT
// A ball that bounces in Babylon with Havok: in Node with an engine that draws nothing; in a page new Engine(canvas), and await HavokPhysics().
import { HavokPlugin, MeshBuilder, NullEngine, PhysicsAggregate, PhysicsShapeType, Scene, FreeCamera, Vector3 } from '@babylonjs/core';
import HavokPhysics from '@babylonjs/havok';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { feel } from 'physvib/feel';

const scene = new Scene(new NullEngine()), wasmBinary = readFileSync(createRequire(import.meta.url).resolve('@babylonjs/havok/lib/esm/HavokPhysics.wasm'));
new FreeCamera('', Vector3.Zero(), scene);
scene.enablePhysics(new Vector3(0, -9.81, 0), new HavokPlugin(false, await HavokPhysics({ wasmBinary })));
const mesh = MeshBuilder.CreateSphere('ball', { diameter: 0.2 }, scene), floor = MeshBuilder.CreateBox('floor', { width: 10, height: 1, depth: 10 }, scene);
mesh.position.y = 0.9;
floor.position.y = -0.5;
new PhysicsAggregate(mesh, PhysicsShapeType.SPHERE, { mass: 0.2, restitution: 0.5 }, scene);
new PhysicsAggregate(floor, PhysicsShapeType.BOX, { mass: 0, restitution: 0.5 }, scene);

const felt = await feel(scene, { fieldWidth: 4, fieldHeight: 3, fieldX: -2 });
felt.set(mesh, 'wooden board'); // a mesh, an aggregate, or a PhysicsBody
felt.haptics.follow(events => { for (const { timeNs, impulse } of events) console.log(`${(timeNs * 1e-6).toFixed(0)} ms: ${impulse.toFixed(2)} N s`); });
for (let i = 0; i < 120; ++i) scene.render(); // a page: engine.runRenderLoop(() => scene.render())
felt.close();
scene.dispose();
