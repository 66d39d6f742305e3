# SPDX-License-Identifier: MIT
# Opens the page in headless Chromium and does what a visitor does. Talks to it by its own pipe, so that nothing else is needed.
# usage: browser.py FOLDER_OF_THE_PAGE SECONDS SEED BAD_SCENE.json PICTURES_FOLDER SCENE=NATIVE.wav...   < the line a bad scene ends in natively
import base64, functools, glob, hashlib, http.server, json, os, struct, subprocess, sys, tempfile, threading, time

page, seconds, seed, bad_scene, pictures, *natives = sys.argv[1:]
patience = 120  # s, for anything that must come; machines are slow at times


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *words):
        pass


class Browser:
    """One tab, over --remote-debugging-pipe: JSON between NUL bytes on descriptors 3 and 4."""

    def __init__(self, folder):
        to_read, self.to = os.pipe()
        self.come, from_write = os.pipe()
        chromium = f"exec chromium --headless=new --no-sandbox --disable-gpu --no-first-run --remote-debugging-pipe --user-data-dir={folder} about:blank"
        self.process = subprocess.Popen(["sh", "-c", f"{chromium} 3<&{to_read} 4>&{from_write}"], pass_fds=(to_read, from_write),
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(to_read)
        os.close(from_write)
        self.rest, self.count, self.session, self.complaints = b"", 0, None, []
        tab = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=tab, flatten=True)["sessionId"]
        for domain in ("Runtime", "Log", "Page", "Network"):
            self.call(domain + ".enable")

    def hear(self):
        while b"\0" not in self.rest:
            more = os.read(self.come, 1 << 20)
            if not more:
                sys.exit("chromium has ended")
            self.rest += more
        line, self.rest = self.rest.split(b"\0", 1)
        return json.loads(line)

    def call(self, method, **params):
        self.count += 1
        message = {"id": self.count, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            heard = self.hear()
            self.note(heard)
            if heard.get("id") == self.count:
                if "error" in heard:
                    sys.exit(f"{method}: {heard['error']['message']}")
                return heard["result"]

    def note(self, heard):
        method, params = heard.get("method"), heard.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.complaints.append(params["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
            self.complaints.append(str(params["args"]))
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            self.complaints.append(params["entry"]["text"])
        elif method == "Network.requestWillBeSent" and not params["request"]["url"].startswith((origin, "data:", "blob:", "about:")):
            self.complaints.append("asked the network for " + params["request"]["url"])

    def value(self, text):
        answer = self.call("Runtime.evaluate", expression=text, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            sys.exit("in the page: " + answer["exceptionDetails"]["exception"].get("description", text))
        return answer["result"].get("value")

    def wait(self, text, what):
        end = time.monotonic() + patience
        while not self.value(text):
            if time.monotonic() > end:
                sys.exit(f"FAILED: {what}: not within {patience} s; the page says: {self.value('document.getElementById(`fault`).textContent')}")
            time.sleep(0.05)

    def mouse(self, kind, x, y):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=0 if kind == "mouseReleased" else 1, clickCount=1)

    def click(self, selector):
        x, y = self.value(f"(() => {{ const e = document.querySelector('{selector}'); e.scrollIntoView({{block: 'center'}}); const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()")
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)

    def drag(self, start, end, steps=12):
        self.mouse("mousePressed", *start)
        for i in range(1, steps + 1):
            self.mouse("mouseMoved", *(a + (b - a) * i / steps for a, b in zip(start, end)))
            time.sleep(0.03)
        self.mouse("mouseReleased", *end)

    def picture(self, name, width, height, scale):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=width < 600)
        time.sleep(0.7)
        shot = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=width < 600)
        with open(os.path.join(pictures, name), "wb") as file:
            file.write(base64.b64decode(shot["data"]))

    def seconds_of_processors(self, threads=""):
        """Of the browser and all it started, so far: of the threads whose names begin so."""
        ticks = 0
        for stat in glob.glob("/proc/[0-9]*/task/*/stat"):
            try:
                name, rest = open(stat).read().split(" (", 1)[1].rsplit(") ", 1)
            except OSError:
                continue  # it has ended
            fields = rest.split()
            if int(fields[3]) == self.process.pid and name.startswith(threads):  # its session
                ticks += int(fields[11]) + int(fields[12])
        return ticks / os.sysconf("SC_CLK_TCK")


def samples_of(path):
    data = open(path, "rb").read()
    start = data.index(b"data")
    return data[start + 8:start + 8 + struct.unpack_from("<I", data, start + 4)[0]]


def expect(holds, what):
    print(("ok     " if holds else "FAILED ") + what)
    if not holds:
        failures.append(what)


# What the page's own thread renders, without a device: frame n is time n / rate when the play-out delay is taken out.
render_in_page = """(async () => {
    const rate = 48000, channels = 4, frames = rate * %s, name = '%s';
    const code = await (await fetch('physvib.wasm')).arrayBuffer();
    const places = [[0, 1], [1, 1], [0, 0], [1, 0]], late = %d;
    const context = new OfflineAudioContext(channels, frames + late, rate);
    await context.audioWorklet.addModule('worklet.js');
    const first = { isName: true, name, bytes: new TextEncoder().encode(name), byHand: false, seed: %s, places };
    new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [channels], processorOptions: { code, first } }).connect(context.destination);
    const buffer = await context.startRendering(), samples = new Float32Array(channels * frames);
    for (let j = 0; j < channels; ++j) buffer.getChannelData(j).subarray(late).forEach((value, n) => { samples[n * channels + j] = value; });
    return [...new Uint8Array(await crypto.subtle.digest('SHA-256', samples))].map(b => b.toString(16).padStart(2, '0')).join('');
})()"""
audio_thread = "Realtime AudioW"  # as Chromium calls it
play_out_frames = 1007  # at 48 kHz: two steps of 10 ms, and the limiter's look-ahead

failures = []
os.makedirs(pictures, exist_ok=True)
server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=page))
threading.Thread(target=server.serve_forever, daemon=True).start()
origin = f"http://127.0.0.1:{server.server_port}/"
folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
browser = Browser(folder.name)
try:
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)
    browser.call("Page.navigate", url=f"{origin}index.html?seed={seed}")
    browser.wait("document.readyState === 'complete' && !!document.getElementById('preset').length", "the page")
    browser.picture("web-start.png", 1280, 800, 1)

    # Sound begins with the click: from there to the first block that is not silent.
    browser.value("""globalThis.heard = new Promise(done => {
        const add = AudioWorkletNode.prototype.connect;
        AudioWorkletNode.prototype.connect = function (...to) {
            if (!this.watched) this.watched = this.port.addEventListener('message', ({ data }) => data.blocks?.some(x => x !== 0) && done(performance.now())) ?? true;
            return add.apply(this, to);
        };
        document.getElementById('start').addEventListener('click', () => { globalThis.clicked = performance.now(); }, true);
    }); 0""")
    browser.click("#start")
    first = browser.value("heard.then(at => at - clicked)")
    print(f"told   first sound {first:.0f} ms after the click; the scene's first hit is a fall of some 0.5 s")
    browser.wait("!!document.querySelector('.material')", "materials")

    # A hand holds the large rubber ball in the middle of the box, and moves an enchanter there.
    browser.click("#byItself")
    browser.value("import('./page.js').then(({ world }) => { globalThis.world = world; globalThis.pictures = 0; (function count() { ++pictures; requestAnimationFrame(count); })(); })")
    browser.wait("world.poses.length", "poses")
    time.sleep(2)
    busy, sounding, began = browser.seconds_of_processors(), browser.seconds_of_processors(audio_thread), time.monotonic()
    box = "(b => [b.x, b.y])(world.canvas.getBoundingClientRect())"
    on_page = f"((x, y) => [{box}[0] + world.map.left + x * world.map.scale, {box}[1] + world.map.bottom - y * world.map.scale])"
    ball = "world.scene.bodies.findIndex(body => body.name === 'large rubber ball')"
    middle = browser.value(f"{on_page}(3.2, 1.8)")
    for _ in range(3):  # what rolls may be elsewhere when the button goes down
        browser.mouse("mousePressed", *browser.value(f"{on_page}(world.poses[4 * {ball}], world.poses[4 * {ball} + 1])"))
        browser.mouse("mouseMoved", *middle)
        time.sleep(1)
    browser.wait(f"Math.hypot(world.poses[4 * {ball}] - 3.2, world.poses[4 * {ball} + 1] - 1.8) < 0.3", "a ball that is held")
    browser.mouse("mouseReleased", *middle)
    expect(True, "a ball is dragged")
    browser.drag(browser.value(f"{on_page}(0, 0)"), middle)
    expect(browser.value("Math.hypot(world.places[2][0] - 0.5, world.places[2][1] - 0.5) < 0.02"), "an enchanter is dragged")
    time.sleep(2)
    lasted = time.monotonic() - began
    share = lambda now, before: f"{100 * (now - before) / lasted:.0f} %"
    print(f"told   {browser.value('pictures') / (time.monotonic() - began + 2):.0f} pictures/s; of a core: {share(browser.seconds_of_processors(), busy)} the whole browser, drawing by software,",
          f"the audio thread {share(browser.seconds_of_processors(audio_thread), sounding)}")
    expect(browser.value("document.getElementById('sentence').textContent.includes('Hz')"), "hits are told")
    browser.click("#attach")
    browser.wait("document.getElementById('output').textContent.startsWith('5 enchanters')", "an enchanter attached")
    expect(True, "an enchanter is attached")
    browser.click("#byItself")
    time.sleep(2.5)
    browser.picture("web-desk.png", 1280, 800, 1)
    browser.picture("web-phone.png", 390, 844, 2)

    # A bad scene ends in the line that it ends in natively, and the world goes on.
    text = json.dumps(open(bad_scene).read())
    line = browser.value(f"""(async () => {{
        const transfer = new DataTransfer();
        transfer.items.add(new File([{text}], '{os.path.basename(bad_scene)}'));
        const file = document.getElementById('file');
        file.files = transfer.files;
        file.dispatchEvent(new Event('change'));
        while (document.getElementById('fault').hidden) await new Promise(next => setTimeout(next, 20));
        return document.getElementById('fault').textContent;
    }})()""")
    expected = sys.stdin.read().strip().removeprefix("physvib: ")
    expect(line == expected, f"a bad scene is refused as natively: {line}" + ("" if line == expected else f" (natively: {expected})"))
    browser.picture("web-fault.png", 390, 844, 2)
    browser.click("#again")
    browser.wait("world.poses.length && document.getElementById('scene').value === 'shake-the-box'", "the scene that was there before")

    for asked, shown in (("marbles", "marbles"), ("nobody", "shake-the-box")):
        browser.call("Page.navigate", url=f"{origin}index.html?scene={asked}")
        browser.wait(f"location.search === '?scene={asked}' && document.readyState === 'complete' && !!document.getElementById('preset').length", "the page again")
        browser.click("#start")
        browser.wait(f"document.getElementById('scene').value === '{shown}' && document.getElementById('materials').textContent.includes('Hz')", "a scene by its link")
        line = browser.value("document.getElementById('fault').textContent")
        expect(line == ("" if asked == shown else f"{asked}: expected the name of a scene that comes with PhysVib"), f"a link to {asked}: {line or 'plays'}")
    for scene, native in (pair.split("=", 1) for pair in natives):
        digest = browser.value(render_in_page % (seconds, scene, play_out_frames, seed))
        expect(digest == hashlib.sha256(samples_of(native)).hexdigest(), f"{scene}: {seconds} s of four channels are the native ones to the bit: {digest[:16]}")
    expect(not browser.complaints, "no complaint on the console" + "".join("\n       " + words for words in browser.complaints))
finally:
    browser.process.terminate()
    browser.process.wait()
sys.exit(f"{len(failures)} failed" if failures else 0)
