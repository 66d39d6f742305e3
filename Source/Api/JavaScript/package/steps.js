// SPDX-License-Identifier: MIT
// Wraps the step function of an engine that a game, a scene or a component may step, so that an attachment runs before and after each step, whoever makes it.
const stepped = new WeakMap();

/** `haptics.before(seconds)` and `haptics.after(isDone)` around each call of `object[name]`, until what it returns is called. `isOurs(...given)`: it steps our world; `secondsOf(...given)`:
 * how far. */
export function aroundSteps(object, name, haptics, secondsOf, isOurs = () => true) {
    let each = stepped.get(object);
    if (each === undefined) {
        stepped.set(object, each = new Map());
        const step = object[name];
        object[name] = function (...given) {
            const ours = [...each].filter(([, of]) => of.isOurs(...given));
            let isDone = false;
            for (const [one, of] of ours) one.before(of.secondsOf(...given));
            try {
                const result = step.apply(this, given);
                isDone = true;
                return result;
            } finally {
                for (const [one] of ours) one.after(isDone);
            }
        };
    }
    each.set(haptics, { isOurs, secondsOf });
    return () => { each.delete(haptics); };
}
