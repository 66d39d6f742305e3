# SPDX-License-Identifier: MIT
# What leaves the page: links, codes and controllers' motors; and what it is without a network, over http, and to those who do not see it.
# usage: sharing.py FOLDER_OF_THE_PAGE PHYSVIB PICTURES_FOLDER [AXE.js]
import base64
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from chromium import Browser
from served import expect, failures, hash_in_page, hash_of, serve

page, physvib, pictures, *axe = (os.path.abspath(path) for path in sys.argv[1:])
seconds = 10
server = serve(page)
origin = f"http://physvib.test:{server.server_port}/"  # an address that others could open, so links have codes
as_https = ("--host-resolver-rules=MAP *.test 127.0.0.1", f"--unsafely-treat-insecure-origin-as-secure={origin[:-1]}")
work = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
browsers = []
wanted = "(await import('./page.js')).wanted()"
ready = "document.getElementById('start')?.disabled === false"
sizes = (("desk", 1280, 800, 1), ("laptop", 1366, 680, 1), ("phone", 390, 844, 2), ("across", 844, 390, 2))


def visitor(*options):
    browsers.append(Browser(tempfile.mkdtemp(dir=work.name), origin, pictures, options or as_https))
    browsers[-1].call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)
    return browsers[-1]


def leave(browser):
    expect(not browser.complaints, "no complaint on the console" + "".join("\n       " + words for words in browser.complaints))
    browsers.remove(browser)
    browser.end()


def visit(browser, url, is_there=ready):
    browser.call("Page.navigate", url="about:blank")
    browser.call("Page.navigate", url=url)
    browser.wait(is_there, url)


def give(browser, name, value, kind="change"):
    browser.value(f"(element => {{ element.value = {json.dumps(value)}; element.dispatchEvent(new Event('{kind}', {{ bubbles: true }})); }})(document.getElementById('{name}')); 0")


def share(browser):
    browser.click("#sharing")
    browser.wait("document.getElementById('share').open", "a link")
    return browser.value("document.getElementById('link').value")


def judge(browser, what):
    """By axe, if it is there."""
    if not axe:
        return
    if browser.value("typeof axe") == "undefined":
        browser.value(open(axe[0]).read() + "; 0")
    for name, width, height, _ in sizes:
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        time.sleep(0.3)
        complain(browser, f"{what}, {name}")
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)


def complain(browser, what):
    found = browser.value("axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }).then(({ violations }) => violations.map(({ id, nodes }) => `${id}: ${nodes.map(node => node.target).join(', ')}`))")
    expect(found == [], f"axe, {what}: {'; '.join(found) or 'nothing to complain of'}")


def links():
    one, other = visitor(), visitor()
    visit(one, origin)
    judge(one, "before Start")
    give(one, "scene", "marbles")
    one.wait("document.title.startsWith('marbles')", "marbles")
    give(one, "seed", "7")
    one.wait("import('./page.js').then(page => page.wanted().seed === 7)", "a seed")
    for _ in range(2):  # the same arrangement twice
        give(one, "preset", "three in a row")
    one.value("document.querySelectorAll('.badge')[1].focus(); 0")
    for _ in range(5):
        one.key("ArrowUp")
    expect(one.value("import('./page.js').then(({ world }) => world.places[1])") == [0.5, 0.6], "an actuator moves by keys")
    give(one, "law", "energy")
    one.value("for (const row of document.querySelectorAll('.material')) { const slider = row.querySelector('input'); slider.value = 0.5; slider.dispatchEvent(new Event('input', { bubbles: true })); } 0")
    one.click("#again")  # a restart keeps all of it
    one.wait("import('./page.js').then(page => page.wanted().materials.length === document.querySelectorAll('.material').length)", "materials that stay")
    link = share(one)
    print("told  ", link)
    for name, *size in sizes:
        one.picture(f"web-share-{name}.png", *size)
    one.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)
    judge(one, "a link")
    decoded = subprocess.run(["zbarimg", "--quiet", "--raw", os.path.join(pictures, "web-share-desk.png")], capture_output=True, text=True, check=False).stdout.strip()
    expect(decoded == link, f"the QR code is the link: {decoded[:60]}")

    visit(other, link)
    here, there = hash_in_page(one, wanted, seconds), hash_in_page(other, wanted, seconds)
    scene = json.load(open(os.path.join(os.path.dirname(__file__), "../../Source/Scene/Scenes/marbles.json")))
    for material in scene["materials"]:
        if material.get("frequency_hz"):
            material["frequency_hz"] = 141.4
    width, height = 0.12, 0.06  # of phone4, which the page's shares are of
    layout = {"name": "three", "extent_m": [width, height], "enchanters": [{"label": label, "x_m": x * width, "y_m": y * height} for label, x, y in (("A", 0, 0.5), ("B", 0.5, 0.6), ("C", 1, 0.5))]}
    for name, content in (("scene", scene), ("layout", layout)):
        json.dump(content, open(os.path.join(work.name, f"{name}.json"), "w"))
    subprocess.run([physvib, "render", "scene.json", "--seconds", str(seconds), "--seed", "7", "--law", "energy", "--layout", "layout.json", "--instructions", "scalar", "--out", "native.wav"],
                   cwd=work.name, check=True, stdout=subprocess.DEVNULL)
    native = hash_of(os.path.join(work.name, "native.wav"))
    expect(here == there, f"a link that is opened elsewhere gives the same {seconds} s: {here[:16]}, {there[:16]}")
    expect(there == native, f"and so does physvib render: {native[:16]}")

    # A scene of one's own goes along, whole; a scene's variables do; what is no link says so.
    text = open(os.path.join(os.path.dirname(__file__), "../../Source/Scene/Scenes/shake-the-box.json")).read().replace('"drive_gain": ', '"drive_gain": 0.5')
    one.value(f"document.getElementById('share').close(); (transfer => {{ transfer.items.add(new File([{json.dumps(text)}], 'mine.json')); const file = document.getElementById('file'); file.files = transfer.files; file.dispatchEvent(new Event('change')); }})(new DataTransfer()); 0")
    one.wait("document.title.startsWith('mine')", "a scene of one's own")
    link = share(one)
    visit(other, link)
    here, there = hash_in_page(one, wanted, seconds), hash_in_page(other, wanted, seconds)
    expect(here == there, f"a scene of one's own in a link of {len(link)} characters: {there[:16]}")
    visit(other, f"{origin}#scene=drop&set=height%3D1")
    expect(other.value("document.querySelectorAll('#variables select')[2].value") == "1", "a variable of a scene by its link")
    first = hash_in_page(other, wanted, 3)
    other.value("(select => { select.value = '2'; select.onchange(); })(document.querySelectorAll('#variables select')[2]); 0")
    other.wait("import('./page.js').then(page => page.wanted().variables.some(([, value]) => value === '2'))", "another height")
    expect(hash_in_page(other, wanted, 3) != first, "another value is another world")
    for words, line in (("at=0,7", "link: at: expected places"), ("law=loud", "link: law: expected one of linear, "), ("set=height=9", "drop: variable")):
        visit(other, f"{origin}#scene=drop&{words}")
        other.wait("document.querySelectorAll('.material').length > 0", "the first scene instead")
        told = other.value("document.querySelector('#fault p').textContent")
        expect(told.startswith(line), f"a link that cannot be followed says why, and the first scene is there: {told}")
    leave(other)
    return one


def motors():
    pads = visitor()
    pads.call("Page.addScriptToEvaluateOnNewDocument", source="""
        globalThis.motors = [];
        globalThis.buzzes = [];
        const actuator = { effects: ['dual-rumble', 'trigger-rumble'],
            playEffect(effect, { strongMagnitude, weakMagnitude, duration }) { motors.push([performance.now(), effect, strongMagnitude, weakMagnitude, duration]); return Promise.resolve('complete'); },
            reset() { motors.push([performance.now(), 'reset', 0, 0, 0]); return Promise.resolve('complete'); } };
        navigator.getGamepads = () => [null, { connected: true, vibrationActuator: actuator }];
        navigator.vibrate = ms => { buzzes.push(ms); return true; };""")
    visit(pads, origin)
    pads.click("#start")
    pads.wait("document.getElementById('begin').hidden", "sound")
    pads.click("#rumble")
    time.sleep(seconds)
    told = pads.value("motors")
    strong = [command for command in told if command[1] == "trigger-rumble"]
    expect(100 < len(told) <= seconds * 30 + 5, f"ten seconds of shake the box: {len(told)} commands, at most 30 a second")
    expect(max((max(low, high) for _, _, low, high, _ in strong), default=0) > 0.6 and all(duration >= 100 for *_, duration in strong), "motors are driven, each command until the next")
    expect(len(pads.value("buzzes")) > 50, "a phone's motor as well")
    pads.click("#silence")
    time.sleep(0.3)
    count = pads.value("motors.length")
    time.sleep(1)
    expect(pads.value("motors.at(-1)[1]") == "reset" or pads.value("motors.at(-1).slice(2, 4)") == [0, 0], "SILENCE rests them")
    expect(pads.value(f"motors.slice({count}).every(([, , low, high]) => low === 0 && high === 0)"), "and they stay at rest")
    return pads


def native(*words):
    """physvib with these words, in the folder of the test."""
    subprocess.run([physvib, *words], cwd=work.name, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def content(name):
    with open(os.path.join(work.name, name), "rb") as file:
        return file.read()


def alike(ours, theirs):
    """The same JSON, numbers to 1e-9 of themselves: the logarithm of WebAssembly's library may differ in its last digit."""
    if isinstance(ours, dict):
        return isinstance(theirs, dict) and list(ours) == list(theirs) and all(alike(ours[key], theirs[key]) for key in ours)
    if isinstance(ours, list):
        return isinstance(theirs, list) and len(ours) == len(theirs) and all(map(alike, ours, theirs))
    return math.isclose(ours, theirs, rel_tol=1e-9) if isinstance(ours, float) else ours == theirs


def recording(browser):
    """What is played for ten seconds, as files: samples, events, and the clips that physvib export makes of these."""
    browser.value("""globalThis.blobs = new Map();
        const make = URL.createObjectURL; // the page's policy lets nobody fetch them
        URL.createObjectURL = blob => { const url = make.call(URL, blob); blobs.set(url, blob); return url; }; 0""")
    browser.click("#record")
    browser.wait("document.getElementById('record').textContent.startsWith('Recording')", "a recording")
    browser.wait("document.querySelectorAll('#recorded a').length > 0", "files of a recording")
    files = browser.value("""Promise.all([...document.querySelectorAll('#recorded a')].map(async link => {
        const bytes = new Uint8Array(await blobs.get(link.href).arrayBuffer()), step = 8192;
        let text = '';
        for (let at = 0; at < bytes.length; at += step) text += String.fromCharCode(...bytes.subarray(at, at + step));
        return [link.download, btoa(text)];
    }))""")
    files = {name: base64.b64decode(code) for name, code in files}
    for name, data in files.items():
        with open(os.path.join(work.name, "page-" + name), "wb") as file:
            file.write(data)
    wav = files["shake-the-box.wav"]
    rate = int.from_bytes(wav[60:64], "little")  # after room for a longer file's sizes
    loud = any(wav[104:])
    whole = wav[:4] == b"RIFF" and rate in (44100, 48000) and len(wav) == 104 + 4 * 4 * rate * 10 and loud
    expect(whole, f"a recording of ten seconds, four channels, {rate} Hz: {len(wav)} bytes")
    events = files["shake-the-box.csv"].decode().strip().splitlines()
    expect(len(events) > 30, f"an event list of it: {len(events)} lines")
    for ending in ("haptic", "ahap"):
        made = sorted(name for name in files if name.endswith(ending))
        native("export", "page-shake-the-box.csv", "--field", "6.4,3.6", "--to", f"native.{ending}")
        # But for the title that the list's name gives it.
        same = [name for name in made
                if alike(json.loads(content("native" + name.removeprefix("shake-the-box")).replace(b"page-shake-the-box.csv", b"")), json.loads(files[name]))]
        expect(made == [f"shake-the-box-{letter}.{ending}" for letter in "ABCD"] and same == made, f"four .{ending}, as physvib export makes them: {same}")
    for name, *size in sizes:
        browser.picture(f"web-recorded-{name}.png", *size)
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)


def drop(browser, name):
    text = json.dumps(content(name).decode())
    browser.value(f"""(transfer => {{
        transfer.items.add(new File([{text}], '{name}'));
        document.dispatchEvent(new DragEvent('drop', {{ dataTransfer: transfer, bubbles: true, cancelable: true }}));
    }})(new DataTransfer()); 0""")


def dropped(other):
    """Event lists and clips on the page are what physvib render makes of them."""
    one = visitor()
    visit(one, origin)
    native("render", "shake-the-box", "--seconds", str(seconds), "--events", "hits.csv", "--out", "scene.wav")
    native("export", "marbles", "--layout", "phone1", "--seconds", "4", "--to", "knock.haptic")
    native("export", "marbles", "--layout", "phone1", "--seconds", "4", "--to", "knock.ahap")
    for name, way in (("hits.csv", ["--from-events", "hits.csv", "--field", "6.4,3.6"]), ("knock.haptic", ["knock.haptic"]), ("knock.ahap", ["knock.ahap"])):
        drop(one, name)
        one.wait(f"document.title.startsWith('{name}')", name)
        native("render", *way, "--seconds", str(seconds), "--layout", "phone4", "--instructions", "scalar", "--out", "whole.wav")
        digest, wanted_digest = hash_in_page(one, wanted, seconds), hash_of(os.path.join(work.name, "whole.wav"))
        expect(digest == wanted_digest, f"{name} on the page is physvib render's: {digest[:16]}, {wanted_digest[:16]}")
        visit(other, share(one))
        one.click("#shared")
        there = hash_in_page(other, wanted, seconds)
        expect(there == digest, f"and so it is by its link: {there[:16]}")
    one.click("#start")
    one.wait("document.getElementById('begin').hidden", "sound")
    drop(one, "hits.csv")
    one.wait("document.getElementById('sentence').textContent.includes('Hz')", "hits of a list that are told")
    time.sleep(0.5)
    for name, *size in sizes:
        one.picture(f"web-list-{name}.png", *size)
    bad = content("hits.csv").decode().splitlines()
    with open(os.path.join(work.name, "bad.csv"), "w") as file:
        file.write("\n".join([*bad[:3], "x" + bad[3], *bad[4:]]) + "\n")
    told = subprocess.run([physvib, "render", "--from-events", "bad.csv", "--out", "never.wav"], cwd=work.name, capture_output=True, text=True, check=False)
    drop(one, "bad.csv")
    one.wait("!document.getElementById('fault').hidden", "a refusal")
    line = one.value("document.querySelector('#fault p').textContent")
    expect(line == told.stderr.strip().removeprefix("physvib: "), f"a bad list is refused as natively: {line}")
    with open(os.path.join(work.name, "wave.hjif"), "w") as file:
        file.write("{}")
    drop(one, "wave.hjif")
    one.wait("document.querySelector('#fault p').textContent.includes('wave')", "another refusal")
    line = one.value("document.querySelector('#fault p').textContent")
    expect("expected a file .haptic or .ahap" in line, f"and MPEG's formats with what to do: {line}")
    leave(one)


def phone_sensors(answer):
    """A phone's sensor and its screen are asked for at Start, not before; both end."""
    phone = visitor()
    phone.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=2, mobile=True)
    phone.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
    phone.call("Page.addScriptToEvaluateOnNewDocument", source=f"""
        globalThis.asked = [];
        globalThis.held = [];
        if (globalThis.DeviceOrientationEvent) // an empty page before the page has none
            DeviceOrientationEvent.requestPermission = () => {{ asked.push(['sensor', navigator.userActivation.isActive]); return Promise.resolve('{answer}'); }};
        if (navigator.wakeLock) navigator.wakeLock.request = kind => {{
            asked.push([kind, true]);
            return Promise.resolve({{ release() {{ asked.push(['released', true]); return Promise.resolve(); }} }});
        }};
        const post = MessagePort.prototype.postMessage;
        MessagePort.prototype.postMessage = function (message, ...rest) {{ if (message.hold) held.push(message.hold); return post.call(this, message, ...rest); }};""")
    visit(phone, origin)
    expect(phone.value("asked.length") == 0, "neither sensor nor screen are asked for before Start")
    phone.click("#start")
    phone.wait("document.getElementById('begin').hidden && asked.length === 2", "sound, sensor and screen")
    expect(phone.value("asked") == [["sensor", True], ["screen", True]], "both are asked for at Start, the sensor within the click")
    lean = "window.dispatchEvent(new DeviceOrientationEvent('deviceorientation', { alpha: 0, beta: 40, gamma: 30 })); held.length"
    is_on = answer == "granted"
    expect(phone.value("document.getElementById('sensor').getAttribute('aria-pressed')") == str(is_on).lower(), f"a sensor that is {answer} is shown as such")
    time.sleep(0.1)
    held = phone.value(lean)
    expect((held > 0) == is_on, f"leaning a phone whose sensor is {answer} holds the world {held} times")
    if is_on:
        phone.click("#sensor")
        phone.wait("document.getElementById('sensor').getAttribute('aria-pressed') === 'false'", "a sensor that is off")
        time.sleep(0.1)
        held = phone.value("held.length")
        expect(phone.value("held.at(-1)") == [0, 1] and phone.value(lean) == held, "turned off, the world stands upright and follows no more")
        phone.click("#pause")
        phone.wait("asked.at(-1)[0] === 'released'", "a screen that may sleep")
        phone.click("#pause")
        phone.wait("asked.at(-1)[0] === 'screen'", "a screen that stays awake again")
        expect(True, "a paused world lets the screen sleep")
    leave(phone)


def fingers():
    """A phone: two things are held at once; a swipe beside all things scrolls."""
    phone = visitor()
    phone.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=2, mobile=True)
    phone.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
    visit(phone, f"{origin}#by=hand")
    phone.value("import('./page.js').then(({ world }) => { globalThis.world = world; })")
    phone.wait("world.poses.length", "poses")
    time.sleep(2)  # what falls lies by then
    on_page = "(([x, y]) => { const box = world.canvas.getBoundingClientRect(), { left, bottom, scale } = world.map; return { x: box.x + left + x * scale, y: box.y + bottom - y * scale }; })"
    places = "['large rubber ball', 'large wood sphere'].map(name => { const i = world.scene.bodies.findIndex(body => body.name === name); return [world.poses[4 * i], world.poses[4 * i + 1]]; })"
    targets = [[1.5, 2.5], [4.5, 2.5]]
    touch = lambda kind, points: phone.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{**point, "id": i} for i, point in enumerate(points)])
    held = phone.value(f"{places}.map({on_page})")
    touch("touchStart", held)
    ends = phone.value(f"{json.dumps(targets)}.map({on_page})")
    for step in (0.5, 1):
        touch("touchMove", [{axis: start[axis] + step * (end[axis] - start[axis]) for axis in "xy"} for start, end in zip(held, ends)])
        time.sleep(1)
    found = phone.value(places)
    expect(all(abs(x - u) < 0.4 and abs(y - v) < 0.4 for (x, y), (u, v) in zip(found, targets)), f"two fingers hold two balls: {found}")
    touch("touchEnd", [])
    time.sleep(1)
    expect(phone.value("scrollY") == 0, "what is held scrolls nothing")
    empty = phone.value(f"[[3, 3.5]].map({on_page})[0]")
    touch("touchStart", [empty])
    for up in range(1, 11):
        touch("touchMove", [{"x": empty["x"], "y": empty["y"] - 15 * up}])
        time.sleep(0.02)
    touch("touchEnd", [])
    time.sleep(0.5)
    expect(phone.value("scrollY") > 50, f"a swipe beside all things scrolls: {phone.value('scrollY')} px")
    return phone


def still():
    """For those who ask for less motion it stands until they ask for it."""
    calm = visitor()
    calm.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
    visit(calm, origin)
    moved = "import('./page.js').then(({ world }) => { globalThis.stood ??= [...world.poses]; return stood.length > 0 && stood.some((value, i) => value !== world.poses[i]); })"
    calm.value(moved)
    time.sleep(1)
    expect(calm.value("stood.length > 0") and not calm.value(moved) and calm.value("!document.getElementById('paused').hidden"), "less motion: the world is drawn, and stands")
    calm.click("#start")
    calm.wait(moved, "a world that moves after Start")
    return calm


def plain_http():
    browser = visitor("--host-resolver-rules=MAP *.test 127.0.0.1")
    browser.origin = f"http://plain.test:{server.server_port}/"
    visit(browser, browser.origin)
    text = browser.value("document.getElementById('beginText').textContent")
    expect(not browser.value("isSecureContext") and text.startswith("No sound here: this page came by http;") and browser.value("document.getElementById('start').hidden"), f"http: {text}")
    browser.value("import('./page.js').then(({ world }) => { globalThis.world = world; })")
    browser.wait("(globalThis.before ??= [...world.poses]) && world.poses.some((value, i) => Math.abs(value - before[i]) > 0.05)", "a world over http")
    browser.picture("web-http-phone.png", 390, 844, 2)
    return browser


def own_address():
    """An address that only this computer has is no phone's; a page that is opened as a file says what to do."""
    browser = visitor()
    browser.origin = f"http://127.0.0.1:{server.server_port}/"
    visit(browser, browser.origin)
    share(browser)
    text = browser.value("document.getElementById('codeNote').textContent")
    expect(browser.value("document.getElementById('code').hidden") and "serve.py" in text, f"no code of 127.0.0.1: {text}")
    leave(browser)
    browser = visitor()
    browser.origin = "file://"
    browser.call("Page.navigate", url=f"file://{os.path.abspath(page)}/index.html")
    browser.wait("document.getElementById('beginText')?.textContent.startsWith('If nothing moves: ')", "a page from a file that says what to do")
    browsers.remove(browser)
    browser.end()


try:
    one = links()
    pads = motors()
    pads.click("#silence")
    recording(pads)
    judge(pads, "while it plays")
    leave(pads)
    dropped(one)
    phone_sensors("granted")
    phone_sensors("denied")
    leave(fingers())
    leave(still())
    leave(plain_http())
    own_address()
    one.wait("navigator.serviceWorker.controller !== null", "a service worker")
    server.shutdown()
    server.server_close()
    visit(one, f"{origin}#scene=marbles&seed=3")
    one.click("#start")
    one.wait("document.getElementById('begin').hidden && document.getElementById('sentence').textContent.includes('Hz')", "sound without a network")
    expect(True, "without a network, after the first visit, it plays")
    leave(one)
finally:
    for browser in browsers:
        browser.end()
sys.exit(f"{len(failures)} failed" if failures else 0)
