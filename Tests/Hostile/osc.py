# SPDX-License-Identifier: GPL-3.0-or-later
"""OSC to a port of this computer, for doors.sh: `osc.py PORT say ADDRESS [TYPES VALUE...]` prints when it was sent (ms since 1970) and what is answered within 0.3 s,
`osc.py PORT broken KIND` the same of one that is no OSC message of silence, `osc.py PORT flood SECONDS PER_SECOND` sends strikes that are not felt."""
import socket
import struct
import sys
import time
from functools import reduce


def padded(text):
    data = text.encode() + b"\0"
    return data + b"\0" * (-len(data) % 4)


def message(address, types="", values=()):
    pack = {"i": lambda v: struct.pack(">i", int(v)), "f": lambda v: struct.pack(">f", float(v)), "s": padded, "b": lambda v: struct.pack(">i", len(v)) + padded(v)[: -(-len(v) // 4) * 4],
            "T": lambda v: b"", "F": lambda v: b"", "N": lambda v: b""}
    return padded(address) + padded("," + types) + b"".join(pack[t](v) for t, v in zip(types, values))


def bundle(*elements):
    return padded("#bundle") + struct.pack(">Q", 1) + b"".join(struct.pack(">i", len(e)) + e for e in elements)


OFF = message("/physvib/silence", "si", ("on", 0))
BROKEN = {
    "no type tags": padded("/physvib/silence"),
    "no end of the address": b"/physvib/silence",
    "an off that is cut": OFF[:-2],
    "an off and one byte": OFF + b"\0",
    "noise behind the address": padded("/physvib/silence") + bytes(range(200, 232)),
    "a bundle that is cut": bundle(OFF)[:-4],
    "a bundle of a wrong message and an off": bundle(message("/physvib/strike", "b", ("blob",)), OFF),
    "a bundle of a wrong silence": bundle(message("/physvib/silence", "s", ("on",))),
    "bundles in bundles, 20 deep": reduce(lambda inner, _: bundle(inner), range(20), OFF),
}


def main():
    door = ("127.0.0.1", int(sys.argv[1]))
    if sys.argv[2:] == ["broken", "list"]:
        return print("\n".join(BROKEN))
    wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    if sys.argv[2] in ("say", "broken"):
        told = BROKEN[sys.argv[3]] if sys.argv[2] == "broken" else message(sys.argv[3], sys.argv[4] if len(sys.argv) > 4 else "", sys.argv[5:])
        print("sent", time.time_ns() // 1_000_000, flush=True)
        wire.sendto(told, door)
        wire.settimeout(0.3)
        try:
            while True:
                print(wire.recv(65536).replace(b"\0", b" ").decode(errors="replace"), flush=True)
        except socket.timeout:
            return
    seconds, rate = float(sys.argv[3]), float(sys.argv[4])
    strike = message("/physvib/strike", "sfsfsf", ("frequency_hz", 100, "decay_per_s", 50, "level", 0.001))
    begin, sent = time.monotonic(), 0
    while (now := time.monotonic() - begin) < seconds:
        while sent < now * rate:
            wire.sendto(strike, door)
            sent += 1
        time.sleep(0.001)


main()
