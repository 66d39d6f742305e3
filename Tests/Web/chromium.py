# SPDX-License-Identifier: MIT
# Headless Chromium by its own pipe, with nothing but Python's own library.
import base64
import fcntl
import glob
import json
import os
import subprocess
import sys
import time


class Browser:
    """One tab, over --remote-debugging-pipe: JSON between NUL bytes on descriptors 3 and 4."""

    patience = 120  # s, for anything that must come; machines are slow at times

    def __init__(self, folder, origin, pictures, options=()):
        self.origin, self.pictures = origin, pictures  # what it may ask for; where its pictures go
        os.makedirs(pictures, exist_ok=True)
        to_read, self.to = os.pipe()
        self.come, from_write = os.pipe()
        words = ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-pipe", f"--user-data-dir={folder}", *options, "about:blank"]

        def give_pipes():  # 3 and 4, whatever stood there
            high = [fcntl.fcntl(end, fcntl.F_DUPFD, 20) for end in (to_read, from_write)]
            for end, at in zip(high, (3, 4)):
                os.dup2(end, at)

        self.process = subprocess.Popen(words, close_fds=False, preexec_fn=give_pipes, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
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
        elif method == "Network.requestWillBeSent" and not params["request"]["url"].startswith((self.origin, "data:", "blob:", "about:")):
            self.complaints.append("asked the network for " + params["request"]["url"])

    def value(self, text):
        answer = self.call("Runtime.evaluate", expression=text, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            sys.exit("in the page: " + answer["exceptionDetails"]["exception"].get("description", text))
        return answer["result"].get("value")

    def wait(self, text, what):
        end = time.monotonic() + self.patience
        while not self.value(text):
            if time.monotonic() > end:
                sys.exit(f"FAILED: {what}: not within {self.patience} s; the page says: {self.value('document.getElementById(`fault`)?.textContent')}")
            time.sleep(0.05)

    def mouse(self, kind, x, y):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=0 if kind == "mouseReleased" else 1, clickCount=1)

    def click(self, selector):
        x, y = self.value(f"(() => {{ const e = document.querySelector('{selector}'); e.scrollIntoView({{block: 'center'}}); const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()")
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)

    def key(self, name):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode={"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Escape": 27}[name])

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
        with open(os.path.join(self.pictures, name), "wb") as file:
            file.write(base64.b64decode(shot["data"]))

    def end(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.to)
        os.close(self.come)

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
