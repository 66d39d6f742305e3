// SPDX-License-Identifier: MIT
// React Three Fiber: inside <Physics> of @react-three/rapier, whose steps are its own.
import { createContext, createElement, useContext, useEffect, useRef, useState } from 'react';
import { useRapier } from '@react-three/rapier';
import { feel } from './feel.js';

const Context = createContext(null);

/** What feel() gives for the world around, whose options the props are; null until it is there. */
export function Felt({ children, onReady, ...options }) {
    const { world } = useRapier(), [felt, setFelt] = useState(null);
    useEffect(() => {
        let mine = null, isOver = false;
        feel(world, options).then(made => {
            if (isOver) return made.close();
            setFelt(mine = made);
            onReady?.(made);
        }, error => console.error(`PhysVib: nothing is felt, the scene goes on: ${error.message}`));
        return () => {
            isOver = true;
            mine?.close();
            setFelt(null);
        };
    }, [world]);
    return createElement(Context.Provider, { value: felt }, children);
}

/** What <Felt> around has. */
export const useFelt = () => useContext(Context);

/** A ref for <RigidBody>: that body feels, as felt.set() says; `values`: a material's name, or an object. */
export function useSource(values) {
    const body = useRef(null), felt = useFelt(), said = JSON.stringify(values);
    useEffect(() => {
        const set = body.current;
        if (!felt || !set) return undefined;
        felt.set(set, values);
        return () => { if (felt.haptics.known(set)) felt.haptics.remove(set); };
    }, [felt, said]);
    return body;
}
