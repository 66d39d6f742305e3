// SPDX-License-Identifier: MIT
// Servers of files, and Chromium, Firefox and WebKitGTK that look at a page of theirs until it has told what it found.
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.css': 'text/css' };
export function serve(answer) {
    const server = createServer((request, response) => answer(request, response, new URL(request.url, 'http://127.0.0.1').pathname));
    return new Promise(done => server.listen(0, '127.0.0.1', () => done({ server, origin: `http://127.0.0.1:${server.address().port}` })));
}
export function send(response, file, headers = {}, edit = text => text) {
    if (!existsSync(file)) { response.writeHead(404, headers); response.end('nothing here'); return; }
    response.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream', ...headers });
    response.end(/\.(html|js)$/.test(file) ? edit(readFileSync(file, 'utf8')) : readFileSync(file));
}
/** Gives what a page posts to `arrived`. */
export function receive(request, response, arrived) {
    let text = '';
    request.on('data', part => { text += part; });
    request.on('end', () => { response.end(); arrived(JSON.parse(text)); });
}

// Sound without a click.
const browsers = {
    Chromium: (profile, place) => ['chromium', '--headless=new', '--no-sandbox', '--disable-gpu', '--no-first-run', '--autoplay-policy=no-user-gesture-required', `--user-data-dir=${profile}`, place],
    Firefox(profile, place) {
        writeFileSync(join(profile, 'user.js'), 'user_pref("media.autoplay.default", 0);\nuser_pref("media.autoplay.block-webaudio", false);\nuser_pref("media.autoplay.blocking_policy", 0);\n');
        return ['firefox-esr', '--headless', '--profile', profile, place];
    },
    WebKitGTK: (profile, place) => ['xvfb-run', '-a', execFileSync('sh', ['-c', 'ls /usr/lib/*/webkit2gtk-4.*/MiniBrowser | tail -1'], { encoding: 'utf8' }).trim(), '--autoplay-policy=allow', place],
};
/** What each told, by its name: `expect(done)` gives done to what comes by POST; nothing within so many seconds: {}. `more`: of their environment. */
export async function inBrowsers(wanted, place, seconds, expect, more = {}) {
    const results = {};
    for (const [name, words] of Object.entries(browsers).filter(([name]) => wanted.length === 0 || wanted.includes(name))) {
        const profile = mkdtempSync(join(tmpdir(), 'physvib-browser-')), [program, ...rest] = words(profile, place);
        const child = spawn(program, rest, { stdio: 'ignore', detached: true, env: { ...process.env, WEBKIT_DISABLE_COMPOSITING_MODE: '1', XDG_CACHE_HOME: profile, XDG_DATA_HOME: profile, ...more } });
        results[name] = await new Promise(done => {
            expect(done);
            child.on('error', error => done({ error: error.message }));
            setTimeout(() => done({}), 1000 * seconds).unref();
        });
        try { process.kill(-child.pid); } catch { /* it has ended */ }
        await new Promise(done => setTimeout(done, 1000));
        rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    }
    return results;
}
