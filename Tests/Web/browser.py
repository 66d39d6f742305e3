# SPDX-License-Identifier: MIT
# Opens the page in headless Chromium and does what a visitor does. Talks to it by its own pipe, so that nothing else is needed.
# usage: browser.py FOLDER_OF_THE_PAGE SECONDS SEED BAD_SCENE.json PICTURES_FOLDER SCENE=NATIVE.wav...   < the line a bad scene ends in natively
import json, os, sys, tempfile, time
from chromium import Browser
from served import expect, failures, hash_in_page, hash_of, serve

page, seconds, seed, bad_scene, pictures, *natives = sys.argv[1:]
audio_thread = "Realtime AudioW"  # as Chromium calls it

os.makedirs(pictures, exist_ok=True)
server = serve(page)
origin = f"http://127.0.0.1:{server.server_port}/"
folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
browser = Browser(folder.name, origin, pictures)
try:
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)
    browser.call("Page.navigate", url=f"{origin}index.html?seed={seed}")
    browser.wait("document.getElementById('start')?.disabled === false", "the page")

    # Before the click the world moves, and nothing is heard; it can be played with.
    browser.value("import('./page.js').then(({ world }) => { globalThis.world = world; })")
    browser.wait("world.poses.length && (globalThis.before ??= [...world.poses]) && world.poses.some((value, i) => Math.abs(value - before[i]) > 0.05)", "a world that moves before the click")
    expect(True, "the world moves before the click")
    time.sleep(1.5)
    for name, *size in (("desk", 1280, 800, 1), ("laptop", 1366, 680, 1), ("phone", 390, 844, 2), ("across", 844, 390, 2)):
        browser.picture(f"web-start-{name}.png", *size)
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)

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

    # A hand holds the large rubber ball in the middle of the box, and moves an actuator there.
    browser.click("#byItself")
    browser.value("globalThis.pictures = 0; (function count() { ++pictures; requestAnimationFrame(count); })(); 0")
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
    expect(browser.value("Math.hypot(world.places[2][0] - 0.5, world.places[2][1] - 0.5) < 0.02"), "an actuator is dragged")
    time.sleep(2)
    lasted = time.monotonic() - began
    share = lambda now, before: f"{100 * (now - before) / lasted:.0f} %"
    print(f"told   {browser.value('pictures') / (time.monotonic() - began + 2):.0f} pictures/s; of a core: {share(browser.seconds_of_processors(), busy)} the whole browser, drawing by software,",
          f"the audio thread {share(browser.seconds_of_processors(audio_thread), sounding)}")
    expect(browser.value("document.getElementById('sentence').textContent.includes('Hz')"), "hits are told")
    browser.click("#attach")
    browser.wait("document.getElementById('output').textContent.startsWith('5 actuators')", "an actuator attached")
    expect(True, "an actuator is attached")
    browser.click("#byItself")
    time.sleep(2.5)
    for name, *size in (("desk", 1280, 800, 1), ("laptop", 1366, 680, 1), ("phone", 390, 844, 2), ("across", 844, 390, 2)):
        browser.picture(f"web-{name}.png", *size)
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)
    browser.click("#pause")
    browser.wait("!document.getElementById('paused').hidden", "a paused world that shows it")
    browser.click("#pause")

    # A bad scene ends in the line that it ends in natively, and the world goes on.
    text = json.dumps(open(bad_scene).read())
    line = browser.value(f"""(async () => {{
        const transfer = new DataTransfer();
        transfer.items.add(new File([{text}], '{os.path.basename(bad_scene)}'));
        const file = document.getElementById('file');
        file.files = transfer.files;
        file.dispatchEvent(new Event('change'));
        while (document.getElementById('fault').hidden) await new Promise(next => setTimeout(next, 20));
        return document.querySelector('#fault p').textContent;
    }})()""")
    expected = sys.stdin.read().strip().removeprefix("physvib: ")
    expect(line == expected, f"a bad scene is refused as natively: {line}" + ("" if line == expected else f" (natively: {expected})"))
    browser.picture("web-fault.png", 390, 844, 2)
    browser.click("#again")
    browser.wait("world.poses.length && document.getElementById('scene').value === 'shake-the-box'", "the scene that was there before")

    for asked, shown in (("marbles", "marbles"), ("nobody", "shake-the-box")):
        browser.call("Page.navigate", url=f"{origin}index.html?scene={asked}")
        browser.wait(f"location.search === '?scene={asked}' && document.getElementById('start')?.disabled === false", "the page again")
        browser.click("#start")
        browser.wait(f"document.getElementById('scene').value === '{shown}' && document.getElementById('materials').textContent.includes('Hz')", "a scene by its link")
        line = browser.value("document.querySelector('#fault p').textContent")
        expect(line == ("" if asked == shown else f"{asked}: expected the name of a scene that comes with PhysVib"), f"a link to {asked}: {line or 'plays'}")
    for scene, native in (pair.split("=", 1) for pair in natives):
        digest = hash_in_page(browser, f"(await import('./link.js').then(({{ openedBy, freshWorld }}) => openedBy({{ ...freshWorld(), scene: '{scene}', seed: {seed} }}, [])))", int(seconds))
        expect(digest == hash_of(native), f"{scene}: {seconds} s of four channels are the native ones to the bit: {digest[:16]}")
    expect(not browser.complaints, "no complaint on the console" + "".join("\n       " + words for words in browser.complaints))
finally:
    browser.end()
sys.exit(f"{len(failures)} failed" if failures else 0)
