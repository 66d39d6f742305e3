// SPDX-License-Identifier: MIT
// In Chromium, Firefox and WebKitGTK: the package's tests that need no Node, the web page, and how late impacts are felt at five rates of pictures. Prints both tables; 1
// if a test fails, or a hit comes late, or is not heard, though neither pictures nor sound stuttered by 30 ms. usage: browsers.mjs FOLDER PAGE [SECONDS [BROWSER...]]. FOLDER: where npm has installed physvib and the engines;
// PAGE: build/web/page
import { join, resolve } from 'node:path';
import { inBrowsers, receive, send, serve } from './browser/browsers.mjs';

const [folder, page, seconds = '20', ...wanted] = process.argv.slice(2), modules = join(resolve(folder), 'node_modules'), root = join(import.meta.dirname, '../..');
const parts = ['silent', 'velocities', 'bodies', 'space', 'lives', 'clock'], tests = [...parts, 'the page'], rates = [30, 45, 60, 90, 144, '60, the smallest page'];
const npm = '/node_modules', asked = { test: 'test', 'assert/strict': 'assert', module: '', path: '', url: '' };
const imports = { physvib: `${npm}/physvib/physvib.js`, 'physvib/': `${npm}/physvib/`, ...Object.fromEntries(['audio', 'velocities', 'matter', 'planck', 'rapier2d', 'rapier3d', 'box2d3'].map(name => [`physvib/${name}`, `${npm}/physvib/${name}.js`])),
    'matter-js': '/matter.mjs', planck: `${npm}/planck/dist/planck.mjs`, ...Object.fromEntries(['2d', '3d'].map(kind => [`@dimforge/rapier${kind}-compat`, `${npm}/@dimforge/rapier${kind}-compat/dist/rapier.mjs`])),
    ...Object.fromEntries(Object.entries(asked).map(([name, what]) => [`node:${name}`, what ? `/${what}.mjs` : '/browser/node.mjs'])) };
const head = `<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="importmap">${JSON.stringify({ imports })}</script>`;
const tell = "error => parent.postMessage({ error: String(error?.message ?? error) }, '*')";
const made = {
    '/test.html': `${head}<script src="${npm}/matter-js/build/matter.js"></script><script type="module">
globalThis.process = { argv: ['', '', ''], versions: {} };
import('/Tests/JavaScript/' + location.search.slice(1) + '.mjs').then(() => import('/browser/node.mjs')).then(({ run }) => run()).then(told => parent.postMessage(told, '*'), ${tell});
</script>`,
    '/rates.html': `${head}<script type="module">import('/browser/rates.mjs').then(({ rateOf }) => rateOf(parseInt(location.search.slice(1)), ${+seconds}, location.search.includes('smallest'))).then(told => parent.postMessage(told, '*'), ${tell});</script>`,
    '/': `<!DOCTYPE html><link rel="icon" href="data:,"><body><script type="module">
const told = {};
for (const [name, place, most] of ${JSON.stringify([...parts.map(name => [name, `/test.html?${name}`, 300]), ['the page', '/page/index.html?seed=3', 120], ...rates.map(rate => [rate, `/rates.html?${rate}`, +seconds + 30])])}) {
    const frame = document.createElement('iframe');
    frame.allow = 'autoplay';
    told[name] = await new Promise(done => {
        onmessage = ({ data }) => done(data);
        setTimeout(() => done({ error: 'nothing within ' + most + ' s' }), 1000 * most);
        frame.src = place;
        document.body.append(frame);
    });
    frame.remove();
}
await fetch('/', { method: 'POST', body: JSON.stringify(told) });
</script></body>`,
    '/matter.mjs': 'export default globalThis.Matter;', '/test.mjs': "export { test as default } from '/browser/node.mjs';", '/assert.mjs': "export { assert as default } from '/browser/node.mjs';",
    '/Tests/JavaScript/installed.mjs': 'export const load = (folder, name) => import(name);',
};
let arrived = () => {};
const { server, origin } = await serve((request, response, path) => {
    if (request.method === 'POST') receive(request, response, told => arrived(told));
    else if (made[path] !== undefined) {
        response.writeHead(200, { 'Content-Type': path.endsWith('.mjs') ? 'text/javascript' : 'text/html' });
        response.end(made[path]);
    } else if (/^\/page\/(index\.html)?$/.test(path)) send(response, join(page, 'index.html'), {}, text => text.replace('</head>', '<script type="module" src="/browser/page.mjs"></script></head>'));
    else if (path.startsWith('/page/')) send(response, join(page, path.slice(6)));
    else send(response, path.startsWith(npm) ? join(modules, path.slice(npm.length)) : path.startsWith('/browser/') ? join(import.meta.dirname, path) : join(root, path));
});
const results = await inBrowsers(wanted, `${origin}/`, 900 + rates.length * (+seconds + 30), done => { arrived = done; });
server.close();

const names = Object.keys(results), failures = [], sums = new Set(), line = (first, cells) => console.log(`| ${first} | ${cells.join(' | ')} |`);
const of = (browser, name) => results[browser][name] ?? { error: results[browser].error ?? 'nothing was told' };
line('', names);
line('---', names.map(() => '---'));
for (const name of tests) line(name, names.map(browser => {
    const { passed, failed = [], needNode, error, sum } = of(browser, name);
    if (sum) sums.add(sum);
    for (const each of [...failed, ...(error ? [error] : [])]) failures.push(`${browser}, ${name}: ${each}`);
    return error ?? `${passed} of ${passed + failed.length}${needNode ? `, ${needNode} need Node` : ''}`;
}));
console.log('\nFrom a collision to its vibration: median (least to most) in ms, as wanted; late; moves of the clock / stutters over 30 ms, of pictures or of sound.\n');
line('pictures a second', names);
line('---', names.map(() => '---'));
for (const rate of rates) line(rate, names.map(browser => {
    const { error, struck, heard, late, moves, stutters, asked: wish, median, least, most } = of(browser, rate);
    if (error || late > stutters || heard + stutters + moves < struck) failures.push(`${browser}, ${rate} pictures: ${error ?? `${late} late, ${heard} of ${struck} heard`}`);
    return error ?? `${median?.toFixed(0)} (${least?.toFixed(0)} to ${most?.toFixed(0)}), ${wish.toFixed(0)}; ${late} of ${struck}; ${moves} / ${stutters}`;
}));
console.log(`\nOf the page's samples there ${sums.size === 1 ? 'is one sum' : `are ${sums.size} sums`} in all browsers.`);
if (sums.size !== 1) failures.push(`sums of samples: ${[...sums].join(' and ')}`);
for (const each of failures) console.log(`FAILED: ${each}`);
process.exit(failures.length > 0 ? 1 : 0);
