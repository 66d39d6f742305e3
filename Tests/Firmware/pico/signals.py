# SPDX-License-Identifier: MIT
"""What pico.sh plays, as 16-bit frames: signals.py FOLDER SECONDS. Impacts that decay, and what only warms coils."""
import array
import math
import random
import sys

RATE = 48000


def impacts(seconds, channels):
    """Decaying sinusoids at random times, as a scene renders them: 60 to 400 Hz, below full scale."""
    chance = random.Random(1)
    out = [0.0] * (channels * RATE * seconds)
    for _ in range(12 * seconds):
        at, hz, tau = chance.randrange(RATE * seconds), chance.uniform(60, 400), chance.uniform(15, 60)
        gains = [chance.random() ** 2 for _ in range(channels)]
        for n in range(at, min(at + int(RATE * 5 / tau), RATE * seconds)):
            t = (n - at) / RATE
            x = 9000 * math.sin(2 * math.pi * hz * t) * math.exp(-tau * t)
            for j in range(channels):
                out[n * channels + j] += gains[j] * x
    return out


def slow(seconds, channels):
    """Squares of 0.5 to 20 Hz at full scale, and -32768."""
    return [
        (32767 if (n * (j + 1)) // (RATE // 5) % 2 else -32768) for n in range(RATE * seconds) for j in range(channels)
    ]


def main(folder, seconds):
    for channels in (4, 8):
        for name, samples in (("scene", impacts(seconds, channels)), ("slow", slow(2, channels))):
            clipped = (max(-32768, min(32767, round(x))) for x in samples)
            with open(f"{folder}/{name}{channels}.raw", "wb") as file:
                array.array("h", clipped).tofile(file)


main(sys.argv[1], int(sys.argv[2]))
