# SPDX-License-Identifier: GPL-3.0-or-later
"""OSC to a port of this computer, for doors.sh: `osc.py PORT say ADDRESS [TYPES VALUE...]` prints when it was sent (ms since 1970) and what is answered within 0.3 s,
`osc.py PORT flood SECONDS PER_SECOND` sends strikes that are not felt."""
import socket
import struct
import sys
import time


def padded(text):
    data = text.encode() + b"\0"
    return data + b"\0" * (-len(data) % 4)


def message(address, types="", values=()):
    pack = {"i": lambda v: struct.pack(">i", int(v)), "f": lambda v: struct.pack(">f", float(v)), "s": padded}
    return padded(address) + padded("," + types) + b"".join(pack[t](v) for t, v in zip(types, values))


def main():
    door = ("127.0.0.1", int(sys.argv[1]))
    wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    if sys.argv[2] == "say":
        print("sent", time.time_ns() // 1_000_000)
        wire.sendto(message(sys.argv[3], sys.argv[4] if len(sys.argv) > 4 else "", sys.argv[5:]), door)
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
