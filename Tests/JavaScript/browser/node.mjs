// SPDX-License-Identifier: MIT
// What tests ask of Node, in a page: node:test, node:assert/strict and paths.
const all = [];
/** A test, which runs when run() is called. */
export function test(name, act) { all.push({ name, act }); }
/** { passed, failed: [...], needNode } of the tests so far. */
export async function run() {
    const failed = [];
    let needNode = 0;
    for (const { name, act } of all) {
        try { await act(); } catch (error) {
            if (error?.needsNode) ++needNode;
            else failed.push(`${name}: ${error?.message ?? error}`);
        }
    }
    return { passed: all.length - failed.length - needNode, failed, needNode };
}

const shown = value => { try { return JSON.stringify(value); } catch { return String(value); } };
const orSaid = (said, found) => { if (said instanceof Error) throw said; throw new Error(said ?? found); };
function isSame(a, b) {
    if (Object.is(a, b)) return true;
    if (Object(a) !== a || Object(b) !== b || Object.getPrototypeOf(a) !== Object.getPrototypeOf(b)) return false;
    const keys = Object.keys(a);
    return keys.length === Object.keys(b).length && keys.every(key => Object.hasOwn(b, key) && isSame(a[key], b[key]));
}
function expectError(error, expected) {
    if (expected === undefined) return;
    const fits = expected instanceof RegExp ? expected.test(String(error)) : expected.prototype instanceof Error || expected === Error ? error instanceof expected
        : typeof expected === 'function' ? expected(error) === true : Object.entries(expected).every(([name, value]) => (value instanceof RegExp ? value.test(error[name]) : isSame(error[name], value)));
    if (!fits) throw new Error(`another error: ${error}`);
}
export const assert = Object.assign((holds, said) => { if (!holds) orSaid(said, `found ${shown(holds)}`); }, {
    fail(said) { orSaid(said, 'failed'); },
    ok(holds, said) { assert(holds, said); },
    equal(a, b, said) { if (!Object.is(a, b)) orSaid(said, `expected ${shown(b)}, found ${shown(a)}`); },
    notEqual(a, b, said) { if (Object.is(a, b)) orSaid(said, `found ${shown(a)}`); },
    deepEqual(a, b, said) { if (!isSame(a, b)) orSaid(said, `expected ${shown(b)}, found ${shown(a)}`); },
    match(text, pattern, said) { if (!pattern.test(text)) orSaid(said, `expected ${pattern}, found ${text}`); },
    doesNotMatch(text, pattern, said) { if (pattern.test(text)) orSaid(said, `found ${text}`); },
    throws(act, expected) {
        try { act(); } catch (error) { return expectError(error, expected); }
        throw new Error('expected an exception');
    },
    async rejects(promise, expected) {
        try { await (typeof promise === 'function' ? promise() : promise); } catch (error) { return expectError(error, expected); }
        throw new Error('expected a rejection');
    },
});

export const join = (...parts) => parts.join('/'), resolve = path => path, pathToFileURL = path => path;
export const createRequire = () => name => { throw Object.assign(new Error(`${name} needs Node`), { needsNode: true }); };
