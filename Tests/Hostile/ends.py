# SPDX-License-Identifier: GPL-3.0-or-later
"""How `physvib play` ends, however long it was played and whatever ends it; without a device.

`ends.py PHYSVIB [EVENTS [TIMES [KILLS]]]` (100000, 3, 5): a session of that many strikes is ended that often, by TERM, INT and HUP in
turn: within a second, with a whole recording and a session that renders. A recording is killed (SIGKILL) that often at random
moments: a whole WAV of all but the last half second is there. A disk that is full is told in one line, and what fitted is a whole
WAV. Fails if one of these is not so. Where the machine is busy, what it took from the recording's thread is measured and allowed."""
import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time

RATE_HZ = 48000
STRIKE = b'{"message": "strike", "frequency_hz": 205, "decay_per_s": 30, "level": 0.1}\n'
faults = []


def expect(is_so, words):
    if not is_so:
        faults.append(words)
        print("FAILED:", words, flush=True)


def frames_of(path, is_ended=False):
    """How many frames a WAV of 32-bit float holds by its header, read as strictly as any program does; None: it is none."""
    try:
        with open(path, "rb") as file:
            head = file.read(4096)
    except FileNotFoundError:
        return None
    size = os.path.getsize(path)
    if len(head) < 12 or head[:4] not in (b"RIFF", b"RF64") or head[8:12] != b"WAVE":
        return None
    at, frame = 12, 0
    while at + 8 <= len(head):
        name, length = head[at:at + 4], struct.unpack_from("<I", head, at + 4)[0]
        at += 8
        if name == b"fmt ":
            frame = struct.unpack_from("<H", head, at + 12)[0]
        if name == b"data":
            riff = struct.unpack_from("<I", head, 4)[0]
            is_whole = frame > 0 and length % frame == 0 and at + length <= size and riff + 8 == at + length
            return length // frame if is_whole and (not is_ended or at + length == size) else None
        at += length + length % 2
    return None


def opens_in_sox(path):
    return not shutil.which("sox") or subprocess.run(["sox", path, "-n", "stat"], capture_output=True).returncode == 0


def play(physvib, *options, **how):
    for name in ("felt.wav", "session.json", "session.events.csv"):
        if os.path.exists(name):
            os.remove(name)
    return subprocess.Popen([physvib, "play", "drop", "--device", "None:no device", "--seconds", "3600", "--record", "felt.wav", *options],
                            stdout=open("out", "wb"), stderr=open("err", "wb"), **how)


def said(name):
    with open(name, encoding="utf-8", errors="replace") as file:
        return file.read()


def until(is_so, seconds=300.0):
    end = time.monotonic() + seconds
    while not is_so() and time.monotonic() < end:
        time.sleep(0.01)
    return is_so()


def end_sessions(physvib, events, times):
    worst = {}
    for turn in range(times):
        number = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)[turn % 3]
        process = play(physvib, "--save", "session.json", "--listen", stdin=subprocess.PIPE)
        for _ in range(0, events, 1000):
            process.stdin.write(STRIKE * 1000)
            process.stdin.flush()
            time.sleep(0.01)
        process.stdin.write(b'{"message": "status"}\n')
        process.stdin.flush()
        expect(until(lambda: "status" in said("out")), "the strikes are not taken")
        time.sleep(0.6)  # the journal's turn
        begin = time.monotonic()
        process.send_signal(number)
        code = process.wait(60)
        milliseconds = round(1000 * (time.monotonic() - begin))
        worst[number.name] = max(milliseconds, worst.get(number.name, 0))
        with open("session.json", "rb") as file:
            kind = "journal" if b'"journal"' in file.readline() else "document"
        rows = sum(1 for _ in open("session.events.csv", "rb"))
        print(f"{number.name} after {events} strikes: {milliseconds} ms, exit {code}, {frames_of('felt.wav')} frames, {kind}, {rows} rows", flush=True)
        expect(milliseconds <= 1000, f"{number.name}: {milliseconds} ms")
        expect(frames_of("felt.wav", True) and opens_in_sox("felt.wav"), "no whole recording")
        rendered = subprocess.run([physvib, "render", "session.json", "--seconds", "0.1", "--out", "again.wav"], capture_output=True)
        expect(rendered.returncode == 0, f"the session does not render: {rendered.stderr}")
        expect(not [name for name in os.listdir(".") if name.endswith(".part")], "something half is left")
    print("worst:", worst)


class Lateness(threading.Thread):
    """The most by which the machine let a thread wait that wanted to run."""

    def __init__(self):
        super().__init__(daemon=True)
        self.worst, self.is_over = 0.0, False
        self.start()

    def run(self):
        while not self.is_over:
            begin = time.monotonic()
            time.sleep(0.01)
            self.worst = max(self.worst, time.monotonic() - begin - 0.01)


def kill_recordings(physvib, kills):
    lost = []
    for _ in range(kills):
        process, late = play(physvib, stdin=subprocess.DEVNULL), Lateness()
        expect(until(lambda: (frames_of("felt.wav") or 0) > 0, 30), "no recording while it plays")
        begin, first = time.monotonic(), frames_of("felt.wav") or 0
        time.sleep(random.uniform(0.0, 3.0))
        played = time.monotonic() - begin
        process.kill()
        process.wait()
        late.is_over = True
        frames = frames_of("felt.wav")
        expect(frames is not None and opens_in_sox("felt.wav"), "half a recording after a kill")
        lost.append(played - ((frames or 0) - first) / RATE_HZ)
        expect(lost[-1] <= 0.5 + late.worst, f"{lost[-1]:.2f} s are lost by a kill, {late.worst:.2f} s of them by the machine")
    print(f"killed {kills} times: every recording whole but for {max(lost):.2f} s at most, {sum(lost) / len(lost):.2f} s on average")


def fill_disk(physvib):
    room = 1_000_000

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))

    process = play(physvib, stdin=subprocess.DEVNULL, preexec_fn=limit)
    told = "physvib: felt.wav: cannot be written: File too large\n"
    expect(until(lambda: said("err") == told, 20), f"a full disk is told so: {said('err')}")
    expect(process.poll() is None, "a full disk ends what plays")
    process.terminate()
    code = process.wait()
    frames = frames_of("felt.wav", True)
    expect(frames and frames * 16 > room - RATE_HZ * 16 and opens_in_sox("felt.wav"), f"of a megabyte {frames} frames are there")
    expect(code == 1 and set(said("err").splitlines()) == {told.strip()}, f"exit {code}: {said('err')}")
    print(f"full disk: exit {code}, {frames} frames of {room} bytes, told: {told.strip()}")


def main():
    physvib = os.path.abspath(sys.argv[1])
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores these, and so would what is ended
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    events, times, kills = (int(word) for word in (sys.argv[2:] + ["100000", "3", "5"][len(sys.argv) - 2:]))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        end_sessions(physvib, events, times)
        kill_recordings(physvib, kills)
        fill_disk(physvib)
        os.chdir("/")
    sys.exit(1 if faults else 0)


main()
