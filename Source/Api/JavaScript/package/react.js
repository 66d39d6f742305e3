// SPDX-License-Identifier: MIT
// React Three Fiber: inside <Physics> of @react-three/rapier, whose steps are its own.
import { createContext, createElement, useContext, useEffect, useRef, useState } from 'react';
import { useRapier } from '@react-three/rapier';
import { feel } from './feel.js';

const Context = createContext(undefined); // of who is outside
const goesOn = error => console.error(`PhysVib: nothing is felt, the scene goes on: ${error.message ?? error}`);

/** What feel() gives for the world around, whose options the props are, as they are at first; null until it is there. */
export function Felt({ children, onReady, ...options }) {
    const { world } = useRapier(), [felt, setFelt] = useState(null);
    useEffect(() => {
        let mine = null, isOver = false;
        feel(world, options).then(made => {
            if (isOver) return made.close();
            setFelt(mine = made);
            onReady?.(made);
        }, goesOn);
        return () => {
            isOver = true;
            mine?.close();
            setFelt(null);
        };
    }, [world]);
    return createElement(Context.Provider, { value: felt }, children);
}

/** What <Felt> around has. */
export const useFelt = () => useContext(Context) ?? null;

/** A ref for <RigidBody> or <InstancedRigidBodies>: these feel, as felt.set() says; `values`: a material's name, or an object. */
export function useSource(values) {
    const body = useRef(null), felt = useContext(Context), said = JSON.stringify(values);
    useEffect(() => {
        if (felt === undefined) goesOn('useSource is outside of <Felt>');
        const bodies = [body.current ?? []].flat();
        if (!felt) return undefined;
        try {
            for (const each of bodies) felt.set(each, typeof values === 'string' ? values : { isSource: true, ...values });
        } catch (error) {
            goesOn(error);
        }
        return () => { for (const each of bodies) if (felt.haptics.known(each)) felt.haptics.remove(each); };
    }, [felt, said]);
    return body;
}
