// SPDX-License-Identifier: MIT
import * as THREE from 'three';
import RAPIER from '@dimforge/rapier3d-compat';
import { load } from 'physvib';
import { rumble } from 'physvib/gamepad';
import { attach } from 'physvib/rapier3d';

await RAPIER.init();
const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 }), ball = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(0, 3, 0));
world.createCollider(RAPIER.ColliderDesc.ball(0.3).setRestitution(0.7), ball);
world.createCollider(RAPIER.ColliderDesc.cuboid(5, 0.1, 5));
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(60, 4 / 3, 0.1, 100), mesh = new THREE.Mesh(new THREE.SphereGeometry(0.3), new THREE.MeshNormalMaterial());
scene.add(mesh);
camera.position.set(0, 2, 6);
const picture = new THREE.WebGLRenderer();

const physvib = await load(), field = { fieldWidth: 8, fieldHeight: 6 };
const haptics = attach(physvib, world, { ...field, fieldX: -4, fieldY: -1 }); // x and y of a rectangle that actuators span
haptics.set(ball, { isSource: true, frequencyHz: 80, decayPerSecond: 20 });
rumble(physvib, field).follow(haptics);
picture.setAnimationLoop(() => {
    haptics.update(1 / 60); // instead of world.step()
    mesh.position.copy(ball.translation());
    picture.render(scene, camera);
});
