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
    /** How a body feels and sounds; its masses are the engine's. Its number in events, which it keeps when it leaves the engine's world and comes back. A part, a
     * collider or a fixture stands for its body. */
    set(body: Body, values?: HapticValues & { material?: string }): number;
    id(body: Body): number;
    remove(body: Body): void;
    /** `advance` steps the engine by so many seconds. */
    step(seconds: number, advance?: (seconds: number) => void): void;
    /** What ended haptics, told once on the console; null: nothing did. The game goes on without them. */
    readonly error: Error | null;
    take(atOnce?: boolean): FullHapticEvent[];
    /** After each step, with all that is known: a later step may still add what happened before. What it returns ends that. */
    follow(follower: (events: FullHapticEvent[], world: World) => void): () => void;
    /** Events that nobody took, and that have made room for newer ones. */
    readonly forgotten: number;
    readonly counts: WorldCounts;
    /** As World.explain; it looks at all bodies of the engine. Left out, `output` is the first of play() that follows. */
    explain(output?: Renderer | OutputFacts): string;
    free(): void;
}

/** Of engines that do not step themselves. */
export interface SteppedHaptics<Body = any> extends Haptics<Body> {
    /** Steps the engine by so many seconds. */
    update(seconds: number): void;
}

/** Of engines that another, a scene say, may step. */
export interface SpaceHaptics<Body = any> extends SteppedHaptics<Body> {
    /** Before a step of so many seconds that another makes, and behind it. */
    before(seconds: number): void;
    after(): void;
}

export function attach<Body = any>(physvib: PhysVib, world: object, options?: AttachOptions): SteppedHaptics<Body>;
