// SPDX-License-Identifier: MIT
// A ball that bounces in React Three Fiber (without JSX): <Canvas><Physics><Felt ...><Ball /></Felt></Physics></Canvas>.
import { createElement as h } from 'react';
import { createRoot } from 'react-dom/client';
import { Canvas } from '@react-three/fiber';
import { BallCollider, CuboidCollider, Physics, RigidBody } from '@react-three/rapier';
import { Felt, useSource } from 'physvib/react';

function Ball() {
    const body = useSource('wooden board'); // a ref: this body feels
    return h(RigidBody, { ref: body, colliders: false, position: [0, 2, 0] }, h(BallCollider, { args: [0.3], restitution: 0.7 }), h('mesh', null, h('sphereGeometry', { args: [0.3] }), h('meshNormalMaterial')));
}
const floor = h(RigidBody, { key: 'floor', type: 'fixed', colliders: false }, h(CuboidCollider, { args: [5, 0.1, 5], restitution: 0.7 }));
createRoot(document.body.appendChild(document.createElement('div'))).render(h(Canvas, null, h(Physics, null, floor, h(Felt, { fieldWidth: 8, fieldHeight: 6, fieldX: -4 }, h(Ball)))));
