#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What others do to a program that plays, through its doors and behind its back: losses.py PHYSVIB [GROUP...]. Prints a table, and fails if one case is not told,
not refused or not survived. Groups: stop, ceiling, files, signals, readers, stack, memory; all unless told. No device is needed."""
import array
import json
import os
import pathlib
import resource
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

physvib = os.path.realpath(sys.argv[1])
os.chdir(tempfile.mkdtemp())
failed = 0


def row(group, case, found, isGood):
    global failed
    failed += not isGood
    print(f"{group:10}{case:58}{found[:90]:90}{'' if isGood else '  FAILED'}", flush=True)


STILL = {"physvib_scene": 1, "name": "still", "description": "nothing moves", "field_m": [2, 1], "gravity_m_per_s2": [0, 0], "bodies": [],
         "materials": [{"name": "wood", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 205, "decay_per_s": 30}]}
pathlib.Path("still.json").write_text(json.dumps(STILL))
TONES = "".join(json.dumps({"message": "strike", "frequency_hz": 205 + k, "decay_per_s": 0, "seconds": 60, "level": 1, "law": "equal"}) + "\n" for k in range(20))


def padded(text):
    return text.encode() + b"\0" * (4 - len(text.encode()) % 4)


def osc(address, types="", *values):
    pack = {"s": padded, "i": lambda v: struct.pack(">i", v), "f": lambda v: struct.pack(">f", v)}
    return padded(address) + padded("," + types) + b"".join(pack[t](v) for t, v in zip(types, values))


class Player:
    """`physvib play` of tones that do not end, to a recording."""

    def __init__(self, *options):
        for left in ("r.wav", "s.json", "s.events.csv", "kept"):
            pathlib.Path(left).unlink(missing_ok=True)
        self.process = subprocess.Popen([physvib, "play", "still.json", "--device", "None:no device", "--seconds", "60", "--level", "0", "--listen", "--osc", "0", "--record", "r.wav", "--save", "s.json",
                                         *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=open("err", "w"), text=True)
        self.port = None
        for _ in range(600):
            said = pathlib.Path("err").read_text()
            if "listening at 127.0.0.1:" in said:
                self.port = int(said.split("listening at 127.0.0.1:")[1].split()[0])
                break
            time.sleep(0.05)
        self.say(TONES)
        self.wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.wire.settimeout(5)
        time.sleep(1)

    def say(self, text):
        self.process.stdin.write(text)
        self.process.stdin.flush()

    def send(self, packet):
        """The answers within half a second, in one text."""
        self.wire.sendto(packet, ("127.0.0.1", self.port))
        answers, end = [], time.monotonic() + 0.5
        while time.monotonic() < end:
            self.wire.settimeout(max(0.01, end - time.monotonic()))
            try:
                answers.append(self.wire.recv(65536).replace(b"\0", b" ").decode(errors="replace"))
            except socket.timeout:
                break
        return " ".join(answers)

    def end(self, by=signal.SIGTERM):
        """Exit code, or minus a signal; the lines of standard error without the port and the end."""
        if self.process.poll() is None:
            self.process.send_signal(by)
        self.out = self.process.communicate(timeout=30)[0]
        return self.process.returncode, [line for line in pathlib.Path("err").read_text().splitlines() if "cannot be" in line]


def peak(seconds):
    """Of the last seconds of the recording."""
    data = pathlib.Path("r.wav").read_bytes()
    begin = data.index(b"data") + 8
    samples = array.array("f", data[begin:begin + (len(data) - begin) // 4 * 4])
    return max(map(abs, samples[-int(seconds * 48000 * 4):]), default=0.0)


def try_stop():
    for case, packet in {"ss message stop": osc("/physvib/silence", "ss", "message", "stop"), "ss message status": osc("/physvib/silence", "ss", "message", "status"),
                         "ss input tilt": osc("/physvib/silence", "ss", "input", "tilt"), "/physvib/sil*": osc("/physvib/sil*", "si", "on", 0),
                         "/*/{stop,silence}": osc("/*/{stop,silence}")}.items():
        player = Player()
        answer = player.send(packet)
        time.sleep(1)
        alive = player.process.poll() is None
        player.end()
        answer = "".join(c if " " <= c <= "~" else "" for c in answer)  # doors.sh listens whether it is silent
        row("stop", case, f"alive {alive}: {answer}", alive and "/physvib/answer/silence" in answer and "silenced all the same" in answer)


def try_ceiling():
    raised = "".join(json.dumps({"control": "ceiling", "channel": j, "value": 1}) + "\n" for j in range(1, 5))  # all: the limiter has one gain for all

    def to(value):
        return [osc("/physvib/ceiling", "sisf", "channel", j, "value", value) for j in range(1, 5)]

    def bundle(elements):
        return padded("#bundle") + struct.pack(">Q", 1) + b"".join(struct.pack(">i", len(one)) + one for one in elements)

    for case, act in {"by OSC": lambda p: [p.send(one) for one in to(1.0)][0], "by --listen": lambda p: p.say(raised) or "", "by OSC, in a bundle": lambda p: p.send(bundle(to(0.5)))}.items():
        player = Player("--ceiling", "-20")
        answer = act(player)
        time.sleep(2)
        player.end()
        told = answer + pathlib.Path("err").read_text()
        row("ceiling", f"raised {case}", f"peak {peak(1):.4f}", 0.05 < peak(1) <= 0.10001 and "expected at most 0.1" in told)
    player = Player("--ceiling", "-20")
    player.send(bundle(to(0.01)))
    player.send(bundle(to(0.1)))
    time.sleep(2)
    player.end()
    row("ceiling", "lowered, and up to it again", f"peak {peak(0.5):.4f}", 0.05 < peak(0.5) <= 0.10001 and "ceiling" not in pathlib.Path("err").read_text())


def try_files():
    def replace(path):
        pathlib.Path("kept").write_text("mine")
        os.replace("kept", path)

    acts = {"removed": os.remove, "moved": lambda path: os.rename(path, "kept"), "replaced": replace, "cut": lambda path: os.truncate(path, 20)}
    for path in ("r.wav", "s.json", "s.events.csv"):
        for how, act in acts.items():
            player = Player()
            act(path)
            time.sleep(0.5)
            code, told = player.end()
            isKept = how != "replaced" or pathlib.Path(path).read_text() == "mine"
            row("files", f"{path} {how}", f"exit {code}: {' / '.join(told)}", code == 1 and len(told) == 1 and path in told[0] and isKept
                and (path != "r.wav" or "begins at" not in player.out) and not list(pathlib.Path(".").glob("*.part")))
    player = Player()
    code, told = player.end()
    row("files", "left alone", f"exit {code}", code in (0, 143, -15) and not told and "begins at" in player.out)
    player = Player()
    for path in ("r.wav", "s.json"):
        os.remove(path)
    code, told = player.end()
    row("files", "both removed", f"exit {code}: {' / '.join(told)}", code == 1 and all(path in " ".join(told) for path in ("r.wav", "s.json")))


def try_signals():
    for name in ("USR1", "USR2", "ALRM", "XCPU", "QUIT", "PIPE", "HUP", "INT"):
        player = Player()
        player.process.send_signal(getattr(signal, "SIG" + name))
        time.sleep(1.5)
        left = [str(path) for path in pathlib.Path(".").glob("*.part")]
        code, told = player.end()
        left = left if name != "PIPE" else [str(path) for path in pathlib.Path(".").glob("*.part")]
        row("signals", name, f"exit {code}, left {left}", not left and not told)
        render = subprocess.Popen([physvib, "render", "shake-the-box", "--seconds", "3000", "--out", "long.wav"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(200):
            if list(pathlib.Path(".").glob("*.part")):
                break
            time.sleep(0.02)
        render.send_signal(getattr(signal, "SIG" + name))
        render.wait(timeout=30)
        left = [str(path) for path in pathlib.Path(".").glob("*.part")]
        row("signals", name + ", render", f"exit {render.returncode}, left {left}", not left and not pathlib.Path("long.wav").exists())


def call(*words, limit=20):
    begin = time.monotonic()
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=limit, stdin=subprocess.DEVNULL)
        code, said = done.returncode, done.stderr.strip()
    except subprocess.TimeoutExpired:
        code, said = "never", ""
    return code, said, time.monotonic() - begin


def try_readers():
    os.mkfifo("pipe")
    os.mkdir("folder")
    doors = {"an event list": ["render", "--from-events", "{}", "--layout", "phone2", "--seconds", "1", "--out", "out.wav"], "a layout": ["render", "drop", "--layout", "{}", "--seconds", "1", "--out", "out.wav"],
             "a scene": ["render", "{}", "--seconds", "1", "--out", "out.wav"], "a table": ["analyse", "confusion", "{}"], "a protocol": ["study", "check", "{}"]}
    os.symlink("/dev/zero", "zero.json")
    for kind, words in doors.items():
        for what in ("zero.json", "pipe", "folder", "/dev/null"):
            if kind in ("a scene", "a layout", "a protocol") and what in ("pipe", "folder", "/dev/null"):
                what = "./" + what if what[0] != "/" else what # a path, no name
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
            code, said, took = call(physvib, *[word.format(what) for word in words])
            grown = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
            row("readers", f"{kind}: {what}", f"exit {code}, {took:.1f} s, at most {grown // 1000} MB: {said}", code in (1, 2) and said.count("\n") == 0 and grown < max(before, 200_000) + 1)
    code, said, _ = call("bash", "-c", f"'{physvib}' render --from-events <(sleep 1; cat box.csv) --field 6.4,3.6 --layout phone2 --seconds 1 --out out.wav")
    row("readers", "an event list that a slow command writes", f"exit {code}: {said}", code == 0)


def try_stack():
    for kib in (32, 96, 128, 256):
        for words in ("render drop --seconds 1 --out out.wav", "render --from-events box.csv --field 6.4,3.6 --layout phone2 --seconds 1 --out out.wav", "study plan --help", "material --list"):
            code, said, _ = call("sh", "-c", f"ulimit -s {kib}; exec '{physvib}' {words}")
            row("stack", f"{kib} kB: {words[:30]}", f"exit {code}: {said}", code in ((0, 1, 2) if kib >= 128 else (1,)) and said.count("\n") == 0)


def try_memory():
    """A render is whole, or it says that memory is short: never silence in a file that was promised."""
    told = 0
    for mib in range(16, 64, 2):
        code, said, _ = call("sh", "-c", f"ulimit -v {1024 * mib}; exec '{physvib}' render drop --seconds 1 --out out.wav >said")
        text = pathlib.Path("said").read_text()
        told += code != 0
        row("memory", f"{mib} MB of addresses", f"exit {code}: {said or text.strip()}", code != 0 or "silent" not in text)
    row("memory", "some are too few", f"{told} told", told > 0)


subprocess.run([physvib, "render", "shake-the-box", "--seconds", "2", "--events", "box.csv", "--out", "box.wav"], check=True, capture_output=True)
for group in sys.argv[2:] or ("stop", "ceiling", "files", "signals", "readers", "stack", "memory"):
    globals()["try_" + group]()
print(f"{failed} of these failed" if failed else "all held")
sys.exit(failed != 0)
