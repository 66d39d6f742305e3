# SPDX-License-Identifier: MIT
# The games of a folder in headless Chromium, with the frameworks from npm: each is felt by a controller's motors (a stub), and each impact is what the
# ball's velocity changed by.
# usage: frameworks.py FOLDER EXAMPLES. FOLDER: where npm has installed physvib and the frameworks; EXAMPLES: NAME.mjs of each game
import functools
import http.server
import json
import math
import os
import sys
import tempfile
import threading
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Web"))
from chromium import Browser  # noqa: E402

folder = os.path.abspath(sys.argv[1])
modules = "/node_modules"
imports = {"physvib": f"{modules}/physvib/physvib.js", **{f"physvib/{name}": f"{modules}/physvib/{name}.js" for name in ("gamepad", "velocities", "rapier3d")},
           "phaser": f"{modules}/phaser/dist/phaser.esm.js", "excalibur": f"{modules}/excalibur/build/esm/excalibur.js", "kaplay": f"{modules}/kaplay/dist/kaplay.mjs",
           "melonjs": f"{modules}/melonjs/build/index.js",
           "three": f"{modules}/three/build/three.module.js", "@dimforge/rapier3d-compat": f"{modules}/@dimforge/rapier3d-compat/dist/rapier.mjs"}
games = {path.stem: path.read_text() for path in sorted(Path(sys.argv[2]).glob("*.mjs")) if path.stem != "phaser-matter"}  # that one is chromium.py's
page = f'<!DOCTYPE html><link rel="icon" href="data:,"><script type="importmap">{json.dumps({"imports": imports})}</script><body></body>'
made = {"/": page, **{f"/{name}.mjs": text for name, text in games.items()}}

play = """(async name => {
    const told = [], felt = [], actuator = { effects: ['dual-rumble'], playEffect: (effect, { strongMagnitude }) => { told.push(strongMagnitude); return Promise.resolve('complete'); }, reset: () => Promise.resolve('complete') };
    const pad = { index: 0, id: 'stub', connected: true, mapping: 'standard', buttons: [], axes: [], timestamp: 0, vibrationActuator: actuator };
    navigator.getGamepads = () => [pad];
    const { Haptics } = await import('/node_modules/physvib/haptics.js'), follow = Haptics.prototype.follow, errors = [];
    Haptics.prototype.follow = function (follower) { globalThis.haptics = this; follow.call(this, events => felt.push(...events)); return follow.call(this, follower); };
    addEventListener('error', event => errors.push(event.message));
    await import(`/${name}.mjs`);
    const began = performance.now();
    while (performance.now() - began < 20000 && felt.length < 3) await new Promise(next => setTimeout(next, 50));
    await new Promise(next => setTimeout(next, 200));
    return { commands: told.length, strongest: Math.max(0, ...told), felt: felt.map(({ timeNs, x, y, impulse, massKg }) => ({ timeNs, x, y, impulse, massKg })), errors, ended: String(haptics.error), why: haptics.explain() };
})"""


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".mjs": "text/javascript", ".js": "text/javascript", ".wasm": "application/wasm"}

    def log_message(self, *words):
        pass

    def do_GET(self):
        text = made.get(self.path.split("?")[0])
        if text is None:
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html" if self.path == "/" else "text/javascript")
        self.end_headers()
        self.wfile.write(text.encode())


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
threading.Thread(target=server.serve_forever, daemon=True).start()
origin = f"http://127.0.0.1:{server.server_port}/"
failures = []
# What the ball's velocity changes by when it lands first, m/s: by its height, and what the engine makes of restitution.
due = {"arcade": 1.7 * math.sqrt(2 * 9 * 4.8), "excalibur": 1.7 * math.sqrt(2 * 9 * 4.6), "kaplay": math.sqrt(2 * 9 * 4.4), "melon": 1.7 * math.sqrt(2 * 9 * 4.6), "three": 1.35 * math.sqrt(2 * 9.81 * 2.6)}
for name, text in games.items():
    profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
    browser = Browser(profile.name, origin, profile.name, ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"))
    try:
        browser.call("Page.navigate", url=origin)
        browser.wait("document.readyState === 'complete'", "the page")
        found = browser.value(f"{play}({json.dumps(name)})")
    finally:
        browser.end()
    hits = [hit for hit in found["felt"] if hit["impulse"] > 0]
    speeds = [hit["impulse"] / hit["massKg"] for hit in hits if hit["massKg"]]
    print(f"{name}: {len(hits)} hits, the first {speeds[0] if speeds else 0:.2f} m/s (due {due[name]:.2f}) at x {hits[0]['x'] if hits else 0:.2f} m, {found['commands']} commands, the strongest {found['strongest']:.2f}; {found['why']}")
    if len(hits) < 3 or found["strongest"] < 0.1 or abs(speeds[0] / due[name] - 1) > 0.1 or found["errors"] or found["ended"] != "null":
        failures.append(f"{name}: {json.dumps(found)}")
for line in failures:
    print("FAILED:", line)
sys.exit(1 if failures or len(games) < 5 else 0)
