# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums that would hold a coil at nearly direct current, each of parts that may be played: writes NAME.lines (messages for
`physvib play --listen`), NAME.arguments, and the scenes and clips that they name, into a folder. guard.sh plays them."""
import json
import math
import struct
import sys
import wave
from pathlib import Path

folder, scene = Path(sys.argv[1]), Path(sys.argv[2])
SECONDS = 6.0


def clip(name, sample, seconds=5.0, rate=8000):
    with wave.open(str(folder / name), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(b"".join(struct.pack("<h", round(32767 * sample(n / rate))) for n in range(round(seconds * rate))))


def every(period, **message):
    count = int((SECONDS - 0.7) / period)
    return [dict(message, **{"in": round(0.5 + i * period, 6)}) for i in range(count)]


def strike(hz, decay, **more):
    return dict(message="strike", frequency_hz=hz, decay_per_s=decay, level=1, law="equal", **more)


def sums():
    slow = strike(1, 1)
    yield "strikes 1 Hz, every 0.25 s", every(0.25, **slow), []
    world = json.loads(scene.read_text())
    for material in world["materials"]:
        if "frequency_hz" in material:
            material.update(frequency_hz=1, decay_per_s=1)
    (folder / "slow.json").write_text(json.dumps(world))
    yield "a scene of 1 Hz", [], ["slow.json"]
    clip("constant.wav", lambda t: 0.0099)
    yield "60 clips of constant 0.0099", [dict(message="clip", file="constant.wav", law="equal", **{"in": 0.5})] * 60, []
    clip("one-hertz.wav", lambda t: 0.09 * math.sin(2 * math.pi * t))
    yield "11 clips of 1 Hz at 0.09", [dict(message="clip", file="one-hertz.wav", law="equal", **{"in": 0.5})] * 11, []
    yield "20 strikes of 1 Hz at once", [dict(slow, **{"in": 0.5})] * 20, []
    # Ten more.
    yield "strikes 4.9 Hz, in step", every(1 / 4.9, **strike(4.9, 1)), []
    yield "a tone of 5 Hz", [dict(message="phantom", seconds=5, frequency_hz=5, level=1, law="equal", **{"in": 0.5})], []
    yield "a tone of 10 Hz", [dict(message="phantom", seconds=5, frequency_hz=10, level=1, law="equal", **{"in": 0.5})], []
    yield "half waves of 200 Hz", every(0.005, **strike(200, 0, seconds=0.0025)), []
    yield "half waves of 20 Hz", every(0.05, **strike(20, 0, seconds=0.025)), []
    clip("three-hertz.wav", lambda t: 0.09 * math.sin(6 * math.pi * t))
    yield "30 clips of 3 Hz at 0.09", [dict(message="clip", file="three-hertz.wav", law="equal", **{"in": 0.5})] * 30, []
    yield "pulses of 7 Hz on one after the other", [dict(message="pattern", enchanters="AAAAAAAA", pulse_s=0.25, gap_s=0.3, frequency_hz=7, level=1, **{"in": 0.5})], []
    yield "2 Hz for a second, and again", every(2.0, **strike(2, 1, seconds=1)), []
    stops = [dict(message="stop", **{"in": round(0.6 + 0.2 * i, 3)}) for i in range(24)]
    pairs = zip(every(0.2, message="phantom", seconds=3, frequency_hz=5, level=1, law="equal"), stops)
    yield "5 Hz, stopped at its crests", [line for pair in pairs for line in pair], []
    yield "1 Hz without the limiter", every(0.25, **slow), ["--limiter", "off"]


for number, (name, lines, arguments) in enumerate(sums(), 1):
    (folder / f"{number:02}.name").write_text(name)
    (folder / f"{number:02}.lines").write_text("".join(json.dumps(line) + "\n" for line in lines))
    (folder / f"{number:02}.arguments").write_text(" ".join(arguments))
