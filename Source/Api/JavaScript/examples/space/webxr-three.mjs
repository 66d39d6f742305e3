// SPDX-License-Identifier: MIT
import * as THREE from 'three';
import { VRButton } from 'three/addons/webxr/VRButton.js';
import RAPIER from '@dimforge/rapier3d-compat';
import { load } from 'physvib';
import { attach } from 'physvib/rapier3d';
import { hands } from 'physvib/xr';

await RAPIER.init();
const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 }), scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(60, 4 / 3, 0.1, 100), picture = new THREE.WebGLRenderer();
picture.xr.enabled = true;
document.body.append(picture.domElement, VRButton.createButton(picture));
world.createCollider(RAPIER.ColliderDesc.cuboid(5, 0.1, 5));
const ball = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(0, 3, -0.5)), mesh = new THREE.Mesh(new THREE.SphereGeometry(0.1), new THREE.MeshNormalMaterial());
world.createCollider(RAPIER.ColliderDesc.ball(0.1).setRestitution(0.7), ball);
scene.add(mesh);

const physvib = await load(), haptics = attach(physvib, world, { fieldWidth: 8, fieldHeight: 6, fieldX: -4, fullScaleImpulse: 'automatic' });
const felt = hands(physvib, () => picture.xr.getSession()), grips = [picture.xr.getControllerGrip(0), picture.xr.getControllerGrip(1)], held = {};
for (const grip of grips) grip.addEventListener('connected', ({ data: { handedness } }) => {
    if (handedness === 'none' || held[handedness]) return;
    const body = world.createRigidBody(RAPIER.RigidBodyDesc.kinematicPositionBased());
    world.createCollider(RAPIER.ColliderDesc.ball(0.08), body);
    haptics.set(body, { isSource: true, material: 'wooden board' }); // a hand that feels what strikes it
    felt.follow(haptics, { [handedness]: body });
    held[handedness] = { body, grip };
});
picture.setAnimationLoop(() => {
    for (const { body, grip } of Object.values(held)) body.setNextKinematicTranslation(grip.getWorldPosition(new THREE.Vector3()));
    haptics.update(1 / 60);
    if (ball.translation().y < -2) ball.setTranslation({ x: 0, y: 3, z: -0.5 }, true);
    mesh.position.copy(ball.translation());
    picture.render(scene, camera);
});
