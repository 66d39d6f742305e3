// SPDX-License-Identifier: MIT
import type { ReactElement, ReactNode, RefObject } from 'react';
import type { RapierRigidBody } from '@react-three/rapier';
import type { HapticValues } from 'physvib';
import type { FeelOptions, Felt as FeltWorld } from './feel.js';

/** Inside <Physics> of @react-three/rapier: bodies below it are felt as feel() has it, whose options its props are, as they are at first. */
export function Felt(props: FeelOptions & { children?: ReactNode; onReady?(felt: FeltWorld<RapierRigidBody>): void }): ReactElement;

/** What <Felt> around has; null until it is there. */
export function useFelt(): FeltWorld<RapierRigidBody> | null;

/** A ref for <RigidBody>, or <InstancedRigidBodies>: these feel. A material's name, or what set() takes (isSource: true). */
export function useSource<Body = RapierRigidBody>(values: string | (HapticValues & { material?: string })): RefObject<Body | null>;
