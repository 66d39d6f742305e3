#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Motors that listen to avatar parameters, as head-pat straps and home-made vests for VRChat do, follow the hits of PhysVib.

    physvib play shake-the-box --device JACK:system --osc-to 127.0.0.1:9010 &
    vest.py pat_left=0,0.5 pat_right=2,0.5 [--reach 1] [--from 9010] [--to 127.0.0.1:9001 | --find NAME]

Each NAME=X,Y is a motor at that place of the field, m. Fifty times a second `/avatar/parameters/NAME` is sent if it has changed: a float, 0 to 1,
the sum of all hits, decayed, less by their distance, none from `--reach` (m) on. Two seconds without a packet, or the end, are 0: silence.
`--find` asks by OSCQuery for a program whose name has that in it, on this network (Debian: python3-zeroconf), and says which motors it has not.
"""
import argparse
import math
import signal
import socket
import struct
import sys
import time

RATE_HZ, GONE_S, EPOCH_S = 50, 2.0, 2208988800  # NTP counts from 1900


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), (end + 4) // 4 * 4


def hits(packet, due=None):
    """Named values and time.time() of each hit."""
    if packet.startswith(b"#bundle\0"):
        tag, at = struct.unpack_from(">Q", packet, 8)[0], 16
        due = tag / 2**32 - EPOCH_S if tag > 1 else None
        while at < len(packet):
            size = struct.unpack_from(">i", packet, at)[0]
            yield from hits(packet[at + 4:at + 4 + size], due)
            at += 4 + size
        return
    address, at = text(packet, 0)
    types, at = text(packet, at)
    values = []
    for kind in types[1:]:
        if kind == "s":
            value, at = text(packet, at)
        else:
            form = {"f": ">f", "i": ">i", "d": ">d", "h": ">q"}[kind]
            value, at = struct.unpack_from(form, packet, at)[0], at + struct.calcsize(form)
        values.append(value)
    if address == "/physvib/hit":
        yield dict(zip(values[::2], values[1::2])), due or time.time()


def message(name, level):
    address = f"/avatar/parameters/{name}".encode()
    return address + bytes(4 - len(address) % 4) + b",f\0\0" + struct.pack(">f", level)


def level(sounding, x, y, reach, now):
    total = 0.0
    for hit, due in sounding:
        share = 1.0 - math.hypot(hit["x_m"] - x, hit["y_m"] - y) / reach
        if share > 0.0 and now >= due:
            total += share * abs(hit["amplitude"]) * math.exp(-hit["decay_per_s"] * (now - due))
    return min(1.0, total) if total > 0.01 else 0.0


def found(name, motors, interface):
    """Host and port of the first program that says by OSCQuery where it takes OSC, within ten seconds."""
    import json
    import queue
    import urllib.request
    from zeroconf import ServiceBrowser, Zeroconf
    names, network = queue.Queue(), Zeroconf(interfaces=[interface]) if interface else Zeroconf()

    class Listener:
        def add_service(self, _, kind, service):
            names.put((kind, service))

        update_service = remove_service = lambda *_: None

    def asked(address, port, what):
        with urllib.request.urlopen(f"http://{address}:{port}{what}", timeout=2) as answer:
            return json.load(answer)

    try:
        ServiceBrowser(network, "_oscjson._tcp.local.", Listener())
        until = time.time() + 10
        while (left := until - time.time()) > 0:
            try:
                kind, service = names.get(timeout=left)
            except queue.Empty:
                break
            info = network.get_service_info(kind, service) if name.lower() in service.lower() else None
            for address in map(socket.inet_ntoa, info.addresses if info else []):
                try:
                    host, tree = asked(address, info.port, "/?HOST_INFO"), asked(address, info.port, "/")
                except (OSError, ValueError):
                    continue  # another of its addresses
                there = tree.get("CONTENTS", {}).get("avatar", {}).get("CONTENTS", {}).get("parameters", {}).get("CONTENTS", {})
                lacking = sorted(set(motors) - set(there))
                print(f"vest: {service.partition('.')[0]}" + (f" has no {', '.join(lacking)}" if lacking else ""), file=sys.stderr)
                return host.get("OSC_IP", address), int(host.get("OSC_PORT", info.port))
    finally:
        network.close()
    sys.exit(f"vest: expected a program with {name} in its name that answers OSCQuery, found none in ten seconds")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("motors", nargs="+", metavar="NAME=X,Y")
    parser.add_argument("--reach", type=float, default=1.0)
    parser.add_argument("--from", type=int, default=9010, dest="port")
    parser.add_argument("--to", default="127.0.0.1:9001")
    parser.add_argument("--find", metavar="NAME")
    parser.add_argument("--interface", help="where --find looks: an address of this computer")
    given = parser.parse_args()
    motors = {name: tuple(map(float, place.split(","))) for name, place in (motor.split("=") for motor in given.motors)}
    host, port = found(given.find, motors, given.interface) if given.find is not None else given.to.rsplit(":", 1)
    heard, told = socket.socket(socket.AF_INET, socket.SOCK_DGRAM), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    heard.bind(("127.0.0.1", given.port))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    sounding, sent, last = [], dict.fromkeys(motors, 0.0), time.time()
    try:
        while True:
            end = time.time() + 1 / RATE_HZ
            while (left := end - time.time()) > 0:
                heard.settimeout(left)
                try:
                    sounding += hits(heard.recv(65536))
                    last = time.time()
                except (TimeoutError, ValueError, KeyError, struct.error, UnicodeDecodeError):
                    pass  # nothing came, or what is no packet of ours
            now = time.time()
            if now - last > GONE_S:
                sounding = []
            sounding = [(hit, due) for hit, due in sounding if hit["decay_per_s"] * (now - due) < 7 and now - due < 60]
            for name, (x, y) in motors.items():
                strength = level(sounding, x, y, given.reach, now)
                if strength != sent[name]:
                    told.sendto(message(name, strength), (host, int(port)))
                    sent[name] = strength
    except KeyboardInterrupt:
        pass
    finally:
        for name in motors:
            told.sendto(message(name, 0.0), (host, int(port)))


if __name__ == "__main__":
    main()
