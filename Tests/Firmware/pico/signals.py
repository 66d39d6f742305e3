# SPDX-License-Identifier: MIT
"""What pico.sh plays, as 16-bit frames: signals.py FOLDER SECONDS RENDER. The scene shake-the-box as PhysVib renders it for four and for eight
actuators, and what only warms coils."""
import array
import struct
import subprocess
import sys

RATE = 48000


def chunks(data):
    at = 12
    while at + 8 <= len(data):
        name, size = struct.unpack_from("<4sI", data, at)
        yield name, data[at + 8 : at + 8 + size]
        at += 8 + size + size % 2


def scene(folder, seconds, channels, render):
    """As a sound card gets it: 32-bit floats, rounded to 16 bits."""
    file = f"{folder}/scene{channels}.wav"
    subprocess.run([render, "shake-the-box", "--layout", f"pico{channels}", "--seconds", str(seconds), "--rate", str(RATE), "--out", file], check=True, stdout=subprocess.DEVNULL)
    with open(file, "rb") as wav:
        parts = dict(chunks(wav.read()))
    _, found, rate, _, _, bits = struct.unpack_from("<HHIIHH", parts[b"fmt "])
    assert (found, rate, bits) == (channels, RATE, 32), (found, rate, bits)
    samples = array.array("f", parts[b"data"])
    assert len(samples) >= seconds * RATE * channels and max(map(abs, samples)) > 0.1, "the scene is silent or too short"
    return (32767 * x for x in samples[: seconds * RATE * channels])


def slow(seconds, channels):
    """Squares of 0.5 to 20 Hz at full scale, and -32768."""
    return [
        (32767 if (n * (j + 1)) // (RATE // 5) % 2 else -32768) for n in range(RATE * seconds) for j in range(channels)
    ]


def main(folder, seconds, render):
    for channels in (4, 8):
        for name, samples in (("scene", scene(folder, seconds, channels, render)), ("slow", slow(2, channels))):
            clipped = (max(-32768, min(32767, round(x))) for x in samples)
            with open(f"{folder}/{name}{channels}.raw", "wb") as file:
                array.array("h", clipped).tofile(file)


main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
