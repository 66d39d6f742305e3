# SPDX-License-Identifier: MIT
# The worlds of worlds.mjs in headless Chromium, as in Node: the same table, and the audio worklet's samples are those of render. And a game for Phaser.
# usage: chromium.py FOLDER GAME.mjs. FOLDER: where npm has installed physvib, the engines and Phaser
import functools
import http.server
import json
import os
import sys
import tempfile
import threading

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Web"))
from chromium import Browser  # noqa: E402
import ten  # noqa: E402

folder, here = os.path.abspath(sys.argv[1]), os.path.dirname(os.path.abspath(__file__))
modules = "/node_modules"
imports = {"physvib": "/physvib/physvib.js", **{f"physvib/{name}": f"/physvib/{name}.js" for name in ("audio", "gamepad", "matter", "planck", "rapier2d", "box2d3")},
           "matter-js": "/matter.mjs", "phaser": f"{modules}/phaser/dist/phaser.esm.js", "planck": f"{modules}/planck/dist/planck.mjs", "@dimforge/rapier2d-compat": f"{modules}/@dimforge/rapier2d-compat/dist/rapier.mjs",
           **{f"node:{name}": "/node.mjs" for name in ("module", "path", "url")}}
made = {
    "/": f'<!DOCTYPE html><link rel="icon" href="data:,"><script type="importmap">{json.dumps({"imports": imports})}</script><script src="{modules}/matter-js/build/matter.js"></script>',
    "/matter.mjs": "export default globalThis.Matter;",
    # What worlds.mjs and engines.mjs ask of Node, for a folder that is this server's.
    "/node.mjs": "export const createRequire = () => null, join = (...parts) => parts.join('/'), resolve = path => path, pathToFileURL = path => path;",
    "/game.mjs": open(sys.argv[2], encoding="utf-8").read(),
    "/tests/installed.mjs": "export const load = (folder, name) => import(name);",
}


class Handler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *words):
        pass

    def translate_path(self, path):
        for start, real in (("/physvib/", f"{folder}/node_modules/physvib/"), ("/tests/", here + "/")):
            if path.startswith(start):
                return real + path[len(start):].split("?")[0]
        return super().translate_path(path)

    def do_GET(self):
        text = made.get(self.path.split("?")[0])
        if text is None:
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html" if self.path == "/" else "text/javascript")
        self.end_headers()
        self.wfile.write(text.encode())

    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".mjs": "text/javascript", ".js": "text/javascript", ".wasm": "application/wasm"}


# The table by worlds.mjs itself; and events of each world that it runs, once by render and once through the worklet.
in_page = """(async () => {
    const lines = [];
    console.log = line => lines.push(line);
    const ended = new Promise(done => { globalThis.process = { argv: ['', '', '', '', 'native', 'matter', 'planck', 'rapier2d', 'box2d3'], exit: done, versions: {} }; });
    const { Haptics } = await import('/physvib/haptics.js'), { PhysVib } = await import('physvib'), { play } = await import('physvib/audio');
    const lists = [], take = Haptics.prototype.take;
    Haptics.prototype.take = function (...values) { const events = take.apply(this, values); lists.push(events); return events; };
    await import('/tests/worlds.mjs');
    const code = await ended, physvib = await (await import('physvib')).load();
    const settings = { layout: 'phone4', fieldWidth: 10, fieldHeight: 10 }, seconds = 3, rate = 48000, differing = [];
    let sounding = 0, most = 0;
    for (const [i, events] of lists.entries()) {
        const due = events.filter(event => event.timeNs < (seconds - 0.1) * 1e9);
        if (due.length === 0) continue;
        const context = new OfflineAudioContext(4, rate * seconds, rate), output = await play(physvib, context, { ...settings, level: 1 });
        output.strike(due, 0);
        const recorded = await context.startRendering(), late = output.latencyFrames;
        physvib.render(due, { ...settings, seconds }).forEach((wanted, j) => {
            const got = recorded.getChannelData(j).subarray(late);
            if (!got.every((sample, n) => sample === wanted[n])) differing.push(`${i}, channel ${j}`);
            if (wanted.some(sample => sample !== 0)) ++sounding;
        });
        most = Math.max(most, due.length);
    }
    return { code, lines, worlds: lists.length, sounding, differing, most };
})()"""

# The ten worlds, held against the traces that ten.py has left of Node; those that differ, whole.
ten_worlds = """(async () => {
    globalThis.process = { argv: [], versions: {} };
    const { trace } = await import('/tests/trace.mjs'), physvib = await (await import('physvib')).load();
    const wanted = await (await fetch('/ten.json')).json(), other = {};
    let count = 0;
    for (const [engine, traces] of Object.entries(wanted)) for (const [text, there] of Object.entries(traces)) {
        const here = await trace('', physvib, engine, text);
        ++count;
        if (here !== there) (other[engine] ??= {})[text] = here;
    }
    return { count, other };
})()"""

# A controller's motors while a ball of the game falls and bounces.
play_game = """(async () => {
    const told = [], actuator = { effects: ['dual-rumble'], playEffect: (effect, { strongMagnitude }) => { told.push(strongMagnitude); return Promise.resolve('complete'); }, reset: () => Promise.resolve('complete') };
    navigator.getGamepads = () => [{ connected: true, vibrationActuator: actuator }];
    await import('/game.mjs');
    for (let i = 0; i < 200 && told.length < 10; ++i) await new Promise(next => setTimeout(next, 50));
    return told;
})()"""

# What motors get of a soft hit 30 ms after a hard one, and of 60 hits a second, by the browser's own timers. What the hard hit alone
# would give at that time is the measure: `less` holds what falls short of it.
play_hits = """(async () => {
    const { rumble } = await import('physvib/gamepad'), physvib = await (await import('physvib')).load(), told = [];
    const note = (low, effect) => { told.push({ ms: performance.now(), low, effect }); return Promise.resolve('complete'); };
    const actuator = { effects: ['dual-rumble'], reset: () => note(0, 'reset'),
        playEffect: (effect, { strongMagnitude }) => note(strongMagnitude, effect) };
    navigator.getGamepads = () => [null, { connected: true, vibrationActuator: actuator }];
    const hit = (ms, amplitude) => ({ timeNs: ms * 1e6, durationNs: 0, frequencyHz: 80, decayPerSecond: 10, amplitude, x: 0.5, y: 0.5, kind: 'hit' });
    const motors = physvib.pad('pad-generic'), alone = [];
    motors.strike(hit(100, 1));
    while (motors.dueNs < 2e9) alone.push(motors.next());
    const play = async (hits, ms) => {
        const pads = rumble(physvib, { phone: false }), start = performance.now();
        told.length = 0;
        pads.strike(hits, start * 1e6);
        await new Promise(done => setTimeout(done, ms));
        pads.close();
        return { lost: pads.lost ?? 0, told: told.map(command => ({ ...command, ms: command.ms - start })) };
    };
    const both = await play([hit(100, 1), hit(130, 0.02)], 900), after = both.told.filter(({ ms }) => ms >= 130 && ms < 600);
    const due = ms => alone.filter(({ timeNs }) => timeNs <= ms * 1e6).at(-1)?.low ?? 0;
    const less = after.filter(({ ms, low }) => low < due(ms)), soft = await play([hit(100, 0.02)], 400);
    const many = await play(Array.from({ length: 120 }, (_, i) => hit(100 + i * 1000 / 60, 0.05)), 2000);
    const steady = many.told.filter(({ ms }) => ms > 600 && ms < 1900).map(({ low }) => low);
    return { after: after.length, less, strongest: Math.max(...after.map(({ low }) => low)), soft: Math.max(0, ...soft.told.map(({ low }) => low)),
        many: steady.length, weakest: Math.min(...steady), lost: many.lost };
})()"""

server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
threading.Thread(target=server.serve_forever, daemon=True).start()
origin = f"http://127.0.0.1:{server.server_port}/"
profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
browser = Browser(profile.name, origin, profile.name)
try:
    browser.call("Page.navigate", url=origin)
    browser.wait("document.readyState === 'complete' && typeof Matter === 'object'", "the page")
    motors = browser.value(play_game)
    browser.call("Page.reload")
    browser.wait("document.readyState === 'complete' && typeof Matter === 'object'", "the page for hits")
    hits = browser.value(play_hits)
    browser.call("Page.reload")
    browser.wait("document.readyState === 'complete' && typeof Matter === 'object'", "the page again")
    found = browser.value(in_page)
    browser.call("Page.reload")
    browser.wait("document.readyState === 'complete' && typeof Matter === 'object'", "the page for ten worlds")
    here_too = browser.value(ten_worlds)
finally:
    browser.end()
print("\n".join(found["lines"]))
print(f"Chromium: {found['worlds']} worlds, {found['sounding']} channels that sound, up to {found['most']} events: the worklet's samples differ from render's in {found['differing'] or 'none'}")
differing = {name: len(traces) for name, traces in here_too["other"].items()}
print(f"Chromium: {here_too['count']} runs of the ten worlds are the same to the bit as in Node, but for {differing or 'none'}")
beyond = 0
if differing:  # judged as they are here
    node = json.load(open(os.path.join(folder, "ten.json")))
    traces = {label: {**node[name], **here_too["other"].get(name, {})} for label, name in ten.ENGINES.items() if name in differing}
    beyond = ten.worlds.table({label: all_of.__getitem__ for label, all_of in traces.items()}, ten.KNOWN)
print(f"Phaser's game: {len(motors)} commands, the strongest {max(motors, default=0)}")
print(f"a soft hit after a hard one: {hits['after']} commands, the strongest {hits['strongest']:.2f} (the soft hit alone {hits['soft']:.2f}), weaker than by the hard one alone: {hits['less'] or 'none'}")
print(f"60 hits a second: {hits['many']} commands in 1.3 s, the weakest {hits['weakest']:.2f}, hits lost: {hits['lost']}")
motors_fail = hits["after"] < 5 or hits["less"] or hits["strongest"] < 0.5 or hits["many"] < 10 or hits["weakest"] <= 0.3 or hits["lost"]
complaints = [words for words in browser.complaints if not words.startswith("asked the network for data:") and "WebGL" not in words]
for words in complaints:
    print("console:", words)
sys.exit(1 if motors_fail or beyond or found["code"] or found["differing"] or not found["sounding"] or max(motors, default=0) < 0.3 or complaints else 0)
