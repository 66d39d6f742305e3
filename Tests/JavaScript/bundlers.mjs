// SPDX-License-Identifier: MIT
// Bundlers, loaders and content security policies by browsers: bundlers.mjs FOLDER [BROWSER...]. FOLDER: where npm has installed physvib and the bundlers. Prints the
// table; 1 if a cell is not right. bundlers.sh calls it.
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { inBrowsers, receive, send, serve } from './browser/browsers.mjs';

const [folder, ...wanted] = process.argv.slice(2), root = resolve(folder), work = join(root, 'fixtures'), here = join(import.meta.dirname, 'bundlers');
const bin = (name, ...words) => execFileSync(join(root, 'node_modules/.bin', name), words, { cwd: root, stdio: ['ignore', 'pipe', 'pipe'], env: { ...process.env, NODE_ENV: 'production', PARCEL_WORKERS: '0' } });
const installed = join(root, 'node_modules/physvib'), strict = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self' HOST";

/** The sources of a fixture: of `from`, which exports load. */
function write(name, from = 'physvib', { late = '', files = '', format = 'module' } = {}) {
    const at = join(work, name);
    mkdirSync(at, { recursive: true });
    const worker = format === 'module' ? "new Worker(new URL('./worker.js', import.meta.url), { type: 'module' })" : "new Worker('worker.js')";
    writeFileSync(join(at, 'app.js'), `import { load } from '${from}';\n${readFileSync(join(here, 'app.js'), 'utf8')}\n${late}\nload({ files: ${files || 'undefined'} }.files ? { files: ${files || 'undefined'} } : undefined).then(physvib => run(physvib, () => ${worker})).then(tell, error => tell({ error: error.message }));\n`);
    writeFileSync(join(at, 'worker.js'), `import { load } from '${from}';\n${readFileSync(join(here, 'worker.js'), 'utf8')}`);
    writeFileSync(join(at, 'index.html'), '<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="module" src="./app.js"></script>\n');
    return at;
}
const page = (at, script, head = '', type = 'type="module"') => writeFileSync(join(at, 'index.html'), `<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,">${head}<script ${type} src="${script}"></script>\n`);

// Each makes a folder that a server gives out as it is.
const cases = {
    vite() {
        const at = write('vite');
        bin('vite', 'build', at, '--base', './', '--logLevel', 'error');
        return join(at, 'dist');
    },
    webpack() {
        const at = write('webpack'), out = join(at, 'dist');
        const said = bin('webpack', '--mode', 'production', '--entry', join(at, 'app.js'), '-o', out).toString();
        if (/WARNING|Critical/.test(said.replace(/WARNING in (asset|entrypoint) size limit[^]*?\n\n/g, '').replace(/WARNING in webpack performance[^]*?\n\n/g, ''))) console.log(said);
        page(out, 'main.js');
        return out;
    },
    parcel() {
        const at = write('parcel');
        bin('parcel', 'build', join(at, 'index.html'), '--dist-dir', join(at, 'dist'), '--public-url', './', '--no-cache', '--no-source-maps', '--log-level', 'error');
        return join(at, 'dist');
    },
    'esbuild, inline'() { return inlined('esbuild', (at, name, format) => bin('esbuild', join(at, `${name}.js`), '--bundle', '--minify', `--format=${format}`, `--outfile=${join(at, 'dist', `${name}.js`)}`)); },
    'Rollup, inline'() { return inlined('rollup', (at, name, format) => bin('rollup', join(at, `${name}.js`), '-p', 'node-resolve', '-f', format, '--silent', '-o', join(at, 'dist', `${name}.js`))); },
    'import map'() { return served('import-map', '/packages/'); },
    'another host'() { return served('another-host', 'CDN/'); },
};
/** Bundles that take no files along, so the code is inside; a classic script and a classic worker at that. */
function inlined(name, bundle) {
    const at = write(name, 'physvib/inline', { format: 'iife', files: "new URL('files.wasm', location.href)" });
    for (const part of ['app', 'worker']) bundle(at, part, 'iife');
    cpSync(join(installed, 'files.wasm'), join(at, 'dist/files.wasm'));
    cpSync(join(installed, 'worklet.js'), join(at, 'dist/worklet.js'));
    page(join(at, 'dist'), 'app.js', '<script src="address.js"></script>', 'defer');
    writeFileSync(join(at, 'dist/address.js'), "globalThis.workletAddress = 'worklet.js'; // the policy allows no blob\n");
    return join(at, 'dist');
}
function served(name, place) {
    const at = write(name), imports = Object.fromEntries(['', '/audio', '/matter'].map(part => [`physvib${part}`, `${place}physvib${part || '/physvib'}.js`]));
    page(at, './app.js', `<script type="importmap">${JSON.stringify({ imports })}</script>`);
    const worker = readFileSync(join(at, 'worker.js'), 'utf8').replace("'physvib'", `'${imports.physvib}'`); // workers have no import maps
    writeFileSync(join(at, 'worker.js'), worker);
    return at;
}

rmSync(work, { recursive: true, force: true });
const built = {}, failures = [];
for (const [name, make] of Object.entries(cases)) {
    try { built[name] = make(); } catch (error) { failures.push(`${name} does not build: ${String(error.stderr ?? error.message)}${error.stdout ?? ''}`.slice(0, 2000)); }
}
// What a server renders before a browser has it: importing must ask for nothing that only pages have.
mkdirSync(join(work, 'server'));
const parts = ['', '/inline', '/audio', '/gamepad', '/matter', '/planck', '/rapier2d', '/rapier3d', '/box2d3', '/velocities'];
writeFileSync(join(work, 'server/all.mjs'), parts.map((part, i) => `import * as part${i} from 'physvib${part}';\n`).join('') + `export default [${parts.map((_, i) => `part${i}`)}];\n`);
bin('esbuild', join(work, 'server/all.mjs'), '--bundle', '--platform=node', '--format=esm', `--outfile=${join(work, 'server/bundle.mjs')}`);
for (const name of ['all', 'bundle']) await import(join(work, `server/${name}.mjs`)).catch(error => failures.push(`a server does not import it (${name}): ${error.message}`));

const cdn = await serve((request, response, path) => send(response, join(root, 'node_modules', path), { 'Access-Control-Allow-Origin': '*' }));
const results = {};
let arrived = () => {};
const { server, origin } = await serve((request, response, path) => {
    if (request.method === 'POST') { receive(request, response, told => arrived(told)); return; }
    const [, first, ...rest] = path.split('/');
    if (path === '/') { response.writeHead(200, { 'Content-Type': 'text/html' }); response.end(all); return; }
    if (first === 'packages') { send(response, join(root, 'node_modules', ...rest)); return; }
    const name = decodeURIComponent(first), at = built[name];
    // An import map, which Parcel writes too, is an inline script, and a strict policy wants a hash or nonce of it.
    const policy = ['import map', 'another host', 'parcel'].includes(name) ? strict.replace("'self' 'wasm", `'nonce-map' 'self' ${cdn.origin} 'wasm`) : strict;
    if (at) send(response, join(at, rest.join('/') || 'index.html'), { 'Content-Security-Policy': policy.replace('HOST', cdn.origin) },
        text => text.replaceAll('CDN', cdn.origin).replace(/<script (type="?importmap)/, '<script nonce="map" $1'));
    else send(response, 'none');
});
const all = `<!DOCTYPE html><link rel="icon" href="data:,"><script type="module">
const told = {};
for (const name of ${JSON.stringify(Object.keys(built))}) {
    const frame = document.createElement('iframe');
    told[name] = await new Promise(done => {
        onmessage = ({ data }) => done(data);
        setTimeout(() => done({ error: 'nothing within 30 s' }), 30000);
        frame.src = '/' + encodeURIComponent(name) + '/';
        document.body.append(frame);
    });
    frame.remove();
}
// What a missing file and a server that answers with a page are told as.
const { load } = await import('/packages/physvib/physvib.js');
told.refusals = [];
for (const place of ['/nowhere/physvib.wasm', '/']) told.refusals.push(await load(new URL(place, location.href)).then(() => 'loaded', error => error.message));
await fetch('/', { method: 'POST', body: JSON.stringify(told) });
</script><body></body>`;

Object.assign(results, await inBrowsers(wanted, `${origin}/`, 300, done => { arrived = done; }));
server.close();
cdn.server.close();

const sums = new Set();
console.log(`| | ${Object.keys(results).join(' | ')} |\n| --- |${' --- |'.repeat(Object.keys(results).length)}`);
for (const name of Object.keys(built)) {
    const cells = Object.entries(results).map(([browser, told]) => {
        const { error, sum, events, worklet, worker } = told[name] ?? { error: 'nothing was told' };
        if (error === undefined) sums.add(sum);
        const isRight = error === undefined && events === 1 && worker === 'same' && worklet === 'same';
        if (!isRight) failures.push(`${name}, ${browser}: ${error ?? JSON.stringify({ events, worklet, worker })}`);
        return isRight ? 'page, files, worklet, worker' : error ?? `worklet: ${worklet}, worker: ${worker}`;
    });
    console.log(`| ${name} | ${cells.join(' | ')} |`);
}
for (const [browser, { refusals = [] }] of Object.entries(results)) {
    for (const line of refusals) console.log(`${browser}: ${line}`);
    if (!(refusals[0]?.includes('/nowhere/physvib.wasm') && refusals[0].includes('404') && refusals[1]?.includes('text/html'))) failures.push(`${browser}: refusals: ${refusals}`);
}
if (sums.size !== 1) failures.push(`sums of samples: ${[...sums]}`);
for (const line of failures) console.log(`FAILED: ${line}`);
process.exit(failures.length > 0 ? 1 : 0);
