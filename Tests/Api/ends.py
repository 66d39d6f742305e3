# SPDX-License-Identifier: MIT
"""A page's first sound ends: below full scale, and nothing at all after 2.5 s. ends.py FILE.wav"""
import array
import sys
from pathlib import Path

data = Path(sys.argv[1]).read_bytes()
channels = int.from_bytes(data[data.index(b"fmt ") + 10:][:2], "little")
start = data.index(b"data") + 8
samples = array.array("f", data[start:start + (len(data) - start) // 4 * 4])
peak = max(map(abs, samples))
last = max(i // channels for i, sample in enumerate(samples) if sample != 0.0) / 48000
print(f"peak {peak:.3f}, silent from {last:.3f} s on")
sys.exit(0 if 0.1 < peak < 1.0 and last < 2.5 and len(samples) >= 2.5 * 48000 * channels else 1)
