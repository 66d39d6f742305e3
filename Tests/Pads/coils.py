#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What controllers with coils are sent, against a second encoder written from the public descriptions alone.

usage: coils.py PHYSVIB PHYSVIB_COIL_REPORTS [SECONDS (600)]

1. SECONDS of simulated time in both formats: each byte, each sample of a known signal, the sequence, CRC, pace, and the device's clock
   150 ppm off.
2. `physvib play` on a controller of plain files: found by its number, unplugged and plugged in as another node, silent at the end.
3. Hits as two tones for Switch controllers: energy, pitch, pace.
4. A node that this user may not write to is told in one line."""
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

PHYSVIB, REPORTS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
SECONDS = int(sys.argv[3]) if len(sys.argv) > 3 else 600
bad = 0


def expect(holds, words):
    global bad
    print(("ok    " if holds else "FAIL  ") + words, flush=True)
    bad += not holds


def dualsense(pairs, number):
    settings = struct.pack("<BB5BBB", 0x91, 7, 0xFE, 0, 0, 0, 0, 0xFF, number % 256)
    audio = struct.pack("<BB64b", 0x92, 64, *[sample for pair in pairs for sample in pair])
    body = (bytes([0x32, number % 16 << 4]) + settings + audio).ljust(138, b"\0")
    return body + struct.pack("<I", zlib.crc32(b"\xa2" + body))


def steam(pairs, _):
    sides = [struct.pack("<15h", *[pair[side] for pair in pairs]).ljust(31, b"\0") for side in (0, 1)]
    return b"\x88" + bytes([30]) + sides[0] + sides[1]


def dualsense_pairs(report):
    samples = struct.unpack("64b", report[13:77])
    return list(zip(samples[::2], samples[1::2]))


def steam_pairs(report):
    return list(zip(struct.unpack("<15h", report[2:32]), struct.unpack("<15h", report[33:63])))


FORMATS = {  # bytes, Hz, frames, full scale, encoder, decoder
    "dualsense": (142, 3000, 32, 127, dualsense, dualsense_pairs),
    "steam": (64, 4000, 15, 32767, steam, steam_pairs),
}


def simulated(name, ppm):
    size, rate, frames, full, encode, decode = FORMATS[name]
    data = subprocess.run([REPORTS, name, str(SECONDS), str(ppm)], check=True, stdout=subprocess.PIPE).stdout
    sent = [(struct.unpack("<q", data[i:i + 8])[0] / 1e9, data[i + 8:i + 8 + size]) for i in range(0, len(data), 8 + size)]
    expect(all(encode(decode(report), n) == report for n, (_, report) in enumerate(sent)),
           f"{name}: {len(sent)} reports are byte for byte those of the second encoder, in sequence")
    wanted = SECONDS * (1 + ppm * 1e-6) * rate / frames
    expect(abs(len(sent) - wanted) < 3, f"{name}: {len(sent)} reports in {SECONDS} s, {wanted:.1f} expected at {ppm} ppm")
    gaps = [b[0] - a[0] for a, b in zip(sent[200:], sent[201:])]
    period = frames / rate
    # looked at each millisecond; a block that comes later than any in the last two seconds delays a report
    even = sum(abs(gap - period) < 0.00101 for gap in gaps) / len(gaps)
    expect(even > 0.99 and max(gaps) < period + 0.004,
           f"{name}: {1e3 * min(gaps):.1f} to {1e3 * max(gaps):.1f} ms apart, {100 * even:.2f} % within 1 ms of {1e3 * period:.2f}")
    delay = 6 / (2 * 0.4833 * rate)  # of a sinc of six zeros on each side
    worst = 0.0
    for n, (_, report) in list(enumerate(sent))[1:: max(1, len(sent) // 3000)]:
        for k, pair in enumerate(decode(report)):
            t = (n * frames + k) / rate - delay
            tones = lambda *list_of: sum(a * math.sin(2 * math.pi * (hz * t % 1.0)) for a, hz in list_of)
            if t < 0.02:
                continue
            for side, value in enumerate((tones((0.5, 90), (0.3, 310)), tones((0.6, 47), (0.2, 700)))):
                worst = max(worst, abs(value - pair[side] / full))
    expect(worst < 0.5 / full + 0.005, f"{name}: samples are the signal within {worst:.4f} of full scale")


# Steps of amplitude as Nintendo's drivers list them, of a thousand: below 0.12 in quarter octaves, then finer.
SMALL = [0, 10, 12, 14, 17, 20, 24, 28, 33, 40, 47, 56, 67, 80, 95, 112]


def amplitude(step):
    return SMALL[step] / 1e3 if step < 16 else 2 ** (step / 16) / 17 if step < 32 else 2 ** (step / 32) / 8.7


def side_of(four):
    """(low Hz, low, high Hz, high) of one side's bytes."""
    high = four[0] | (four[1] & 1) << 8
    return (10 * 2 ** (((four[2] & 0x7F) + 0x40) / 32), amplitude((four[3] - 0x40) * 2 + (four[2] >> 7)),
            10 * 2 ** ((high / 4 + 0x60) / 32), amplitude(four[1] >> 1))


def energy(hit, start):
    """Mean square within 30 ms, by summing; in place of the closed form."""
    when, _, decay, size, _ = hit
    times = [start + 0.03 * (k + 0.5) / 1000 for k in range(1000)]
    return sum((size * math.exp(-decay * (t - when))) ** 2 for t in times if t >= when) / 1000


def switch():
    seconds = 60
    data = subprocess.run([REPORTS, "switch", str(seconds), "0"], check=True, stdout=subprocess.PIPE).stdout
    sent = [(struct.unpack("<q", data[i:i + 8])[0] / 1e9, data[i + 8:i + 18]) for i in range(0, len(data), 18)]
    expect(all(r[0] == 0x10 and r[1] == n % 16 and r[1] < 16 for n, (_, r) in enumerate(sent)), f"switch: {len(sent)} reports in sequence")
    expect(min(b[0] - a[0] for a, b in zip(sent, sent[1:])) > 0.0299, "switch: at least 30 ms apart")
    hits = []
    for i in range(4 * seconds):
        hit = (i * 0.25, 60 * 1.13 ** (i % 20), 3 + i % 7 * 5, 0.1 + 0.1 * (i % 10), i % 2)
        hits += [hit] + ([(hit[0], 2 * hit[1], hit[2], hit[3] / 2, hit[4])] if i % 3 == 0 else [])
    single = worst = pitch = 0
    for start, report in sent:
        for side in (0, 1):
            low_hz, low, high_hz, high = side_of(report[2 + 4 * side:6 + 4 * side])
            ringing = [(h[1], energy(h, start)) for h in hits if h[4] == side and start - 3 < h[0] < start + 0.03]
            total = sum(r[1] for r in ringing)
            if total > 1e-2 and all(not 0 < tone < 0.12 for tone in (low, high)):
                worst = max(worst, abs(10 * math.log10((low ** 2 + high ** 2) / min(1, total))))
            if total > 1e-2 and max(ringing, key=lambda r: r[1])[1] > 0.999 * total:
                single += 1
                hz = low_hz if low > high else high_hz
                pitch = max(pitch, abs(math.log2(hz / max(ringing, key=lambda r: r[1])[0])))
    # steps of 1/16 octave are 0.38 dB, coarser below 0.12; those of pitch are 3/8 of a semitone
    expect(worst < 0.3, f"switch: the energy of both tones is that of what rings within {worst:.2f} dB")
    expect(single > 100 and pitch < 0.02, f"switch: {single} single tones are at their pitch within {12 * pitch:.2f} semitones")


class Pads:
    """A folder that looks like /sys/class/hidraw and /dev."""

    def __init__(self):
        self.folder = tempfile.mkdtemp()
        os.chmod(self.folder, 0o755)

    def plug(self, number, ident="0005:0000054C:00000CE6", name="Wireless Controller"):
        place = os.path.join(self.folder, "class", f"hidraw{number}", "device")
        os.makedirs(place)
        os.makedirs(os.path.join(self.folder, "dev"), exist_ok=True)
        with open(os.path.join(place, "uevent"), "w") as file:
            file.write(f"DRIVER=playstation\nHID_ID={ident}\nHID_NAME={name}\n")
        open(self.node(number), "wb").close()
        return self.node(number)

    def pull(self, number):
        os.rename(self.node(number), self.node(number) + ".gone")
        shutil.rmtree(os.path.join(self.folder, "class", f"hidraw{number}"))

    def node(self, number):
        return os.path.join(self.folder, "dev", f"hidraw{number}")

    def play(self, device, seconds, **more):
        return subprocess.Popen([PHYSVIB, "play", "shake-the-box", "--device", device, "--level", "0", "--seconds", str(seconds)],
                                env=dict(os.environ, PHYSVIB_HIDRAW=self.folder), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, **more)


def read(path, size=142):
    data = open(path, "rb").read()
    expect(len(data) % size == 0, f"{os.path.basename(path)}: whole reports")
    return [data[i:i + size] for i in range(0, len(data) - size + 1, size)]


def live():
    pads = Pads()
    pads.plug(0, "0003:0000054C:00000CE6")  # by cable: a sound card, not for this
    pads.plug(3)
    listed = subprocess.run([PHYSVIB, "pads"], env=dict(os.environ, PHYSVIB_HIDRAW=pads.folder), stdout=subprocess.PIPE, text=True).stdout
    expect(listed.count("--device DUALSENSE:") == 1 and "hidraw3" in listed, "listed: " + listed.strip())
    program = pads.play("DUALSENSE:auto", 5)
    time.sleep(2.5)
    pads.pull(3)
    time.sleep(0.5)
    pads.plug(1)
    text = program.communicate(timeout=30)[0]
    expect(program.returncode == 0 and "connected 2 times" in text, "play goes on without the controller: " + text.strip().split("\n")[-1])
    before, after = read(pads.node(3) + ".gone"), read(pads.node(1))
    expect(not open(pads.node(0), "rb").read(), "nothing goes to a controller on a cable")
    expect(len(before) > 60 and len(after) > 40, f"{len(before)} reports, unplugged, {len(after)} reports")
    for part in (before, after):
        first = part[0][10] if part else 0
        expect(all(dualsense(dualsense_pairs(r), r[10] + 256 * 16 if n else first)[4:] == r[4:] for n, r in enumerate(part)),
               "each is the second encoder's")
    expect(any(any(report[13:77]) for report in before) and not any(after[-1][13:77]), "it vibrates, and the last report is silence")
    shutil.rmtree(pads.folder)


def forbidden():
    pads = Pads()
    text = pads.play("DUALSENSE:auto", 1).communicate(timeout=30)[0].strip()
    expect(text == "physvib: no DualSense by Bluetooth is there", "one line: " + text)
    os.chmod(pads.plug(0), 0)
    become = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    if become:  # nobody may not enter a home of root's, where the build may be
        become["executable"] = shutil.copy(PHYSVIB, pads.folder)
    program = pads.play("DUALSENSE:auto", 1, cwd="/", **become)
    text = program.communicate(timeout=30)[0].strip()
    expect(program.returncode == 1 and "may not write to" in text and text.count("\n") == 0, "one line: " + text)
    shutil.rmtree(pads.folder)


for name in FORMATS:
    for ppm in (150, -150):
        simulated(name, ppm)
switch()
live()
forbidden()
sys.exit(bad > 0)
