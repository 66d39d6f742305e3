// SPDX-License-Identifier: MIT
import type { FullHapticEvent, HapticValues, OutputFacts, PhysVib, Renderer, World, WorldCounts, WorldSettings } from 'physvib';

export interface AttachOptions extends WorldSettings {
    /** Of one unit of the engine's lengths (1; Matter 0.01). Lengths of the other options are metres. */
    metresPerUnit?: number;
}

/** `Body`: the engine's. */
export interface Haptics<Body = any> {
    readonly world: World;
    readonly metresPerUnit: number;
    /** How a body feels and sounds; its masses are the engine's. Its number in events. */
    set(body: Body, values?: HapticValues): number;
    id(body: Body): number;
    remove(body: Body): void;
    /** `advance` steps the engine by so many seconds. */
    step(seconds: number, advance?: (seconds: number) => void): void;
    /** The same, and steps the engine. Not with Matter, which steps itself. */
    update?(seconds: number): void;
    take(atOnce?: boolean): FullHapticEvent[];
    /** After each step; what it returns ends that. */
    follow(follower: (events: FullHapticEvent[], world: World) => void): () => void;
    /** Events that nobody took, and that have made room for newer ones. */
    readonly forgotten: number;
    readonly counts: WorldCounts;
    /** As World.explain; it looks at all bodies of the engine. */
    explain(output?: Renderer | OutputFacts): string;
    free(): void;
}

export function attach<Body = any>(physvib: PhysVib, world: object, options?: AttachOptions): Haptics<Body>;
