#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a hand would feel of a WAV file: felt.py FILE.wav [PEAK... | some] prints the peak of each channel, and exits with 1 where it is not
the one expected, to 0.001; or, of what depends on how busy the machine is, where no channel comes to 0.01."""
import array
import struct
import sys


def peaks(path):
    with open(path, "rb") as file:
        data = file.read()
    at, kind = 12, None
    while data[at:at + 4] != b"data":
        if data[at:at + 4] == b"fmt ":
            kind, channels, _, _, _, bits = struct.unpack_from("<HHIIHH", data, at + 8)
            kind = struct.unpack_from("<H", data, at + 32)[0] if kind == 0xFFFE else kind
        at += 8 + struct.unpack_from("<I", data, at + 4)[0]
    code, middle, full = {(3, 32): ("f", 0, 1.0), (1, 16): ("h", 0, 32768.0), (1, 8): ("B", 128, 128.0)}[kind, bits]
    held = data[at + 8:]
    samples = array.array(code, held[:len(held) // (channels * bits // 8) * (channels * bits // 8)])
    return [max((abs(sample - middle) for sample in samples[channel::channels]), default=0) / full for channel in range(channels)]


if __name__ == "__main__":
    found, words = peaks(sys.argv[1]), sys.argv[2:]
    wanted = [] if words == ["some"] else [float(word) for word in words]
    print(f"{sys.argv[1]}: felt", *(f"{peak:.3f}" for peak in found))
    if words == ["some"] and max(found) < 0.01 or wanted and (len(wanted) != len(found) or any(abs(peak - other) > 0.001 for peak, other in zip(found, wanted))):
        sys.exit(f"{sys.argv[1]}: expected to feel {' '.join(sys.argv[2:])}")
