#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sound files of every kind, made here by rule: sounds.py SOUND_KINDS [FOLDER]. Each is read to the bit that its making says, or refused in one line
that fits. Where ffmpeg and sox are installed, they judge what is read. Seeded: every run makes the same files. Exit code 1 if one is otherwise."""
import array
import math
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

random.seed(73)
FRAMES = 1201  # odd: chunks of odd lengths as well
GUID = bytes.fromhex("000000001000800000aa00389b71")
cases = []  # name, bytes, (rate, channels, samples) or a pattern of the refusal


def case(name, content, wanted):
    cases.append((name, content, wanted))


def ints(bits, channels=1, level=0.9):
    """Whole numbers of so many bits: a tone per channel, and the ends of their range."""
    half = 1 << bits - 1
    made = [round(level * (half - 1) * math.sin(0.05 * (j + 1) * n)) for n in range(FRAMES) for j in range(channels)]
    if level > 0.5:
        made[:2] = [-half, half - 1]
    return made


def shares(values, bits):
    return [x / (1 << bits - 1) for x in values]


def packed(values, width, order="little"):
    return b"".join((x & (1 << 8 * width) - 1).to_bytes(width, order) for x in values)


def chunk(name, content, size=None, order="<", pad=True):
    return name + struct.pack(order + "I", len(content) if size is None else size) + content + b"\0" * (len(content) & 1 if pad else 0)


def fmt(tag, channels, rate, bits, block=None, extensible=False, extra=b"", order="<"):
    block = channels * ((bits + 7) // 8) if block is None else block
    head = struct.pack(order + "HHIIHH", 0xFFFE if extensible else tag, channels, rate, rate * block & 0xFFFFFFFF, block & 0xFFFF, bits)
    return head + (struct.pack(order + "HHIH", 22, bits, 0, tag) + GUID if extensible else extra)


def wave(form, data, kind=b"RIFF", told=None, before=b"", behind=b"", long_told=None):
    order, is_long = (">" if kind == b"RIFX" else "<"), kind in (b"RF64", b"BW64")
    body = b"WAVE"
    if is_long:
        body += chunk(b"ds64", struct.pack("<QQQI", len(data) + 100, len(data) if long_told is None else long_told, 0, 0))
    body += chunk(b"fmt ", form, order=order) + before + chunk(b"data", data, 0xFFFFFFFF if is_long and told is None else told, order) + behind
    return kind + struct.pack(order + "I", 0xFFFFFFFF if is_long else len(body)) + body


def law(code, is_mu):
    """G.711, as its tables say."""
    if is_mu:
        code = ~code & 255
        value = (((code & 15) << 3) + 132 << (code >> 4 & 7)) - 132
        return -value if code & 128 else value
    code ^= 0x55
    part, step = code >> 4 & 7, (code & 15) << 4
    value = step + 8 if part == 0 else step + 264 << part - 1
    return value if code & 128 else -value


def samples_of(kind, channels, order):
    """The format's tag and bits, its bytes, and its samples."""
    if kind == "f32":
        values = [random.uniform(-2, 2) for _ in range(FRAMES * channels)]
        return 3, 32, struct.pack(("<" if order == "little" else ">") + f"{len(values)}f", *values), values
    if kind == "f64":
        values = [random.uniform(-2, 2) for _ in range(FRAMES * channels)]
        return 3, 64, struct.pack(("<" if order == "little" else ">") + f"{len(values)}d", *values), values
    if kind in ("alaw", "ulaw"):
        codes = [random.randrange(256) for _ in range(FRAMES * channels)]
        return 6 if kind == "alaw" else 7, 8, bytes(codes), [law(c, kind == "ulaw") / 32768 for c in codes]
    bits = int(kind)
    values, width = ints(bits, channels), (bits + 7) // 8
    stored = [x + 128 for x in values] if bits == 8 else [x << 8 * width - bits for x in values]
    return 1, bits, packed(stored, width, order), shares(values, bits)


BEFORE = {"none": b"", "LIST": chunk(b"LIST", b"INFOICMT\3\0\0\0abc\0"), "odd": chunk(b"odd ", b"abc"), "JUNK": chunk(b"JUNK", bytes(3000)), "fact": chunk(b"fact", struct.pack("<I", 7)),
          "bext": chunk(b"bext", bytes(602)), "short bext": chunk(b"bext", b"x"), "bad PEAK": chunk(b"PEAK", b"\1\0\0\0"), "bad smpl": chunk(b"smpl", b"\xff" * 40), "bad cue": chunk(b"cue ", b"\xff" * 28),
          "ds64": chunk(b"ds64", struct.pack("<QQQI", 300, 200, 0, 0)), "many": chunk(b"xxxx", b"") * 500, "id3": chunk(b"id3 ", b"ID3" + bytes(40))}
BEHIND = {"none": b"", "LIST": chunk(b"LIST", b"INFOISFT\2\0\0\0a\0"), "odd": chunk(b"odd ", b"abc", pad=False), "zeros": bytes(500), "TAG": b"TAG" + b"x" * 125, "two": chunk(b"LIST", b"INFO") + chunk(b"cue ", bytes(4)),
          "second data": chunk(b"data", b"\1\2" * 50), "DISP": chunk(b"DISP", b"\1\0\0\0x")}


def waves():
    kinds = ("8", "12", "16", "20", "24", "32", "f32", "f64", "alaw", "ulaw")
    plan = [(k, c, v, e, "none", "none") for k in kinds for c in (b"RIFF", b"RIFX", b"RF64", b"BW64") for v in (1, 2, 5) for e in (False, True)]
    plan += [("16", b"RIFF", 1, False, a, z) for a in BEFORE for z in BEHIND]
    plan += [(random.choice(kinds), random.choice((b"RIFF", b"RF64", b"BW64")), random.choice((1, 2, 3, 8, 64)), random.random() < 0.5, random.choice(list(BEFORE)), random.choice(list(BEHIND))) for _ in range(150)]
    for kind, container, channels, extensible, before, behind in plan:
        if container != b"RIFF" and before == "ds64":
            continue  # a second one, of other sizes
        order = "big" if container == b"RIFX" else "little"
        tag, bits, data, values = samples_of(kind, channels, order)
        rate = random.choice((8000, 11025, 44100, 48000, 96000, 192000))
        content = wave(fmt(tag, channels, rate, bits, extensible=extensible, order=">" if order == "big" else "<"), data, container, before=BEFORE[before], behind=BEHIND[behind])
        case(f"{container.decode()} {kind} {channels}ch {'ext ' if extensible else ''}{before}/{behind}", content, (rate, channels, values))


def rooms():
    """Samples in more bytes than they need: upper bits as WAVE has it, lower ones as ALSA's arecord."""
    for bits, width in ((12, 2), (16, 3), (16, 4), (20, 3), (20, 4), (24, 4)):
        for channels in (1, 2):
            for level in (0.9, 0.01):
                values = ints(bits, channels, level)
                for upper in (True, False):
                    data = packed([x << 8 * width - bits if upper else x for x in values], width)
                    for extensible in (False, True):
                        case(f"{bits} in {8 * width}, {'upper' if upper else 'lower'}, {level}, {channels}ch{' ext' if extensible else ''}",
                             wave(fmt(1, channels, 48000, bits, width * channels, extensible), data), (48000, channels, shares(values, bits)))
    data = packed(ints(16, 2), 2)
    for block in (0, 1, 2):  # no room for its samples: a slip
        case(f"block {block} of 4", wave(fmt(1, 2, 48000, 16, block), data), (48000, 2, shares(ints(16, 2), 16)))
    for block in (5, 7, 12, 400):
        case(f"block {block} of 4", wave(fmt(1, 2, 48000, 16, block), data), "expected blocks of 4 bytes")
    for tag, bits in ((2, 4), (0x11, 4), (0x55, 16), (1, 0), (1, 33), (1, 64), (3, 16), (3, 24), (7, 16), (0, 16), (0xFFFE, 16)):
        case(f"tag {tag}, {bits} bits", wave(fmt(tag, 1, 48000, bits, 2), data), "expected PCM of 8 to 32 bits")


def sizes():
    values = ints(16)
    data, form, wanted = packed(values, 2), fmt(1, 1, 48000, 16), (48000, 1, shares(values, 16))
    for told in (0, 0x7FFF0000, 0x7FFFF000, 0x7FFFFFDB, 0x7FFFFFFF, 0x80000000, 0xFFFF0000, 0xFFFFFFDB, 0xFFFFFFFF):
        case(f"told {told:x}", wave(form, data, told=told), wanted)
    for told in (2403, 3000, 10**6, 10**9, 3 * 10**9):
        case(f"told {told}", wave(form, data, told=told), rf"expected {told} bytes of samples, as its header says, found \d+: it ends early")
    for told in (2, 100, 1000, 2000, 2390):
        case(f"told {told}", wave(form, data, told=told), rf"expected {told} bytes of samples, as its header says, found \d+ more, which are no other chunks")
    for kind in (b"RF64", b"BW64"):
        for told in (0, 1 << 60, (1 << 64) - 1):
            case(f"{kind} {told:x}", wave(form, data, kind, long_told=told), wanted)
        case(f"{kind} long", wave(form, data, kind, long_told=5 * 10**9), "it ends early")
        case(f"{kind} short", wave(form, data, kind, long_told=200), "no chunks")
    for size in (0, 8, 36, 100, 10**9, 0xFFFFFFFF):
        case(f"RIFF of {size}", b"RIFF" + struct.pack("<I", size) + wave(form, data)[8:], wanted)
    for form, wide in ((fmt(1, 1, 48000, 16, extra=b"\0\0"), True), (fmt(1, 1, 48000, 16, extra=bytes(4)), True), (fmt(1, 1, 48000, 16)[:14], False), (b"", False)):
        case(f"format of {len(form)}", wave(form, data), wanted if wide else "expected a format")
    whole = wave(fmt(1, 1, 48000, 16), data)
    for end in range(0, 44, 3):
        case(f"cut at {end}", whole[:end], "expected ")
    case("samples before the format", b"RIFF\0\0\0\0WAVE" + chunk(b"data", data) + chunk(b"fmt ", fmt(1, 1, 48000, 16)), "expected a format before")
    case("chunk beyond the end", whole[:36] + b"LIST\xff\xff\xff\xff" + whole[36:], "expected samples, found none")
    case("none", wave(fmt(1, 1, 48000, 16), b""), "expected samples, found none")
    case("none, and a chunk", wave(fmt(1, 1, 48000, 16), b"", behind=chunk(b"LIST", b"INFO")), "expected samples, found none")
    case("ID3 before", b"ID3\4\0\0\0\0\1\0" + bytes(128) + whole, wanted)
    for rate in (0, 1, 99, 768001, 1 << 31, (1 << 32) - 1):
        case(f"rate {rate}", wave(fmt(1, 1, rate, 16), data), "expected a rate of 100 to 768000 Hz")
    for channels in (65, 255, 1025, 65535):
        case(f"{channels} channels", wave(fmt(1, channels, 48000, 16, 0), bytes(2 * channels)), "expected 1 to 64 channels")
    case("no channels", wave(fmt(1, 0, 48000, 16), data), "expected PCM")
    for name, bad in (("NaN", math.nan), ("infinity", math.inf), ("-infinity", -math.inf)):
        for at in (0, 700, FRAMES - 1):
            for code, bits in (("f", 32), ("d", 64)):
                values = [0.25] * FRAMES
                values[at] = bad
                case(f"{name} at {at}", wave(fmt(3, 1, 48000, bits), struct.pack(f"<{FRAMES}{code}", *values)), rf"expected finite samples, found {name.lstrip('-')} at {at / 48000:.4f} s")
    for text in (b"", b"R", b"RIFF", b"MThd", b"hello, this is no sound at all", b"\xff\xfb\x90\x00" + bytes(400), b"caff" + bytes(90), b".snd" + bytes(90), b"OggS", b"fLaC", b"FORM\0\0\0\4AIFF", b"ID3\4\0\0\0\0\0\0"):
        case(f"no sound {text[:8]}", text, "expected ")


def extended(rate):
    """A rate as AIFF has it: 80 bits."""
    exponent = rate.bit_length() - 1
    return struct.pack(">HQ", 16383 + exponent, rate << 63 - exponent)


def aiffs():
    for bits in (8, 16, 24, 32):
        for channels in (1, 2, 6):
            values = ints(bits, channels)
            data = chunk(b"SSND", bytes(8) + packed(values, bits // 8, "big"), order=">")
            common = struct.pack(">HIH", channels, FRAMES, bits) + extended(44100)
            for extra in (b"", chunk(b"NAME", b"odd", order=">"), chunk(b"MARK", b"\0\0", order=">")):
                body = b"AIFF" + chunk(b"COMM", common, order=">") + extra + data
                case(f"AIFF {bits} {channels}ch {extra[:4]}", b"FORM" + struct.pack(">I", len(body)) + body, (44100, channels, shares(values, bits)))
            body = b"AIFC" + chunk(b"FVER", struct.pack(">I", 0xA2805140), order=">") + chunk(b"COMM", common + b"NONE\0\0", order=">") + data
            case(f"AIFC {bits} {channels}ch", b"FORM" + struct.pack(">I", len(body)) + body, (44100, channels, shares(values, bits)))
            case(f"AIFC cut {bits} {channels}ch", b"FORM" + struct.pack(">I", len(body)) + body[:-400], "it ends early")


def crc(data, width, polynomial):
    value = 0
    for byte in data:
        value ^= byte << width - 8
        for _ in range(8):
            value = (value << 1 ^ (polynomial if value >> width - 1 else 0)) & (1 << width) - 1
    return value


def flac(values, bits, channels=1, total=None, told_bits=None, blocks=(), is_code_of_description=False):
    """FLAC without compression: frames of 400 samples, verbatim."""
    code = 0 if is_code_of_description else {8: 1, 12: 2, 16: 4, 20: 5, 24: 6, 32: 7}[bits]
    frames = b""
    for number, begin in enumerate(range(0, len(values) // channels, 400)):
        part = values[begin * channels:(begin + 400) * channels]
        count = len(part) // channels
        head = b"\xff\xf8" + bytes([0x7 << 4 | 10, channels - 1 << 4 | code << 1, number]) + struct.pack(">H", count - 1)
        head += bytes([crc(head, 8, 7)])
        stream = "".join("00000010" + "".join(format(x & (1 << bits) - 1, f"0{bits}b") for x in part[j::channels]) for j in range(channels))
        stream += "0" * (-len(stream) % 8)
        frame = head + int(stream, 2).to_bytes(len(stream) // 8, "big")
        frames += frame + struct.pack(">H", crc(frame, 16, 0x8005))
    total = len(values) // channels if total is None else total
    description = struct.pack(">HH", 400, 400) + bytes(6) + (48000 << 44 | channels - 1 << 41 | (told_bits or bits) - 1 << 36 | total).to_bytes(8, "big") + bytes(16)
    head = b"fLaC" + bytes([0 if blocks else 128]) + len(description).to_bytes(3, "big") + description
    for i, (kind, content) in enumerate(blocks):
        head += bytes([kind | (128 if i == len(blocks) - 1 else 0)]) + len(content).to_bytes(3, "big") + content
    return head + frames


def flacs():
    others = {"none": (), "padding": ((1, bytes(900)),), "application": ((2, b"abcdxyz"),), "picture": ((6, b"\xff" * 70),), "many": ((1, b""),) * 300, "broken comment": ((4, b"\xff\xff\xff\xff"),)}
    for bits in (8, 12, 16, 20, 24, 32):
        for channels in (1, 2):
            values = ints(bits, channels)
            wanted = (48000, channels, shares(values, bits))
            for name, blocks in others.items():
                case(f"FLAC {bits} {channels}ch {name}", flac(values, bits, channels, blocks=blocks), wanted)
            whole = flac(values, bits, channels)
            case(f"FLAC {bits} {channels}ch without a total", flac(values, bits, channels, total=0), wanted)
            case(f"FLAC {bits} {channels}ch behind ID3", b"ID3\3\0\0\0\0\0\5hello" + whole, wanted)
            case(f"FLAC {bits} {channels}ch before TAG", whole + b"TAG" + b"x" * 125, wanted)
            says = "as its header says, found "
            case(f"FLAC {bits} {channels}ch few", flac(values, bits, channels, total=500), says + "more")
            case(f"FLAC {bits} {channels}ch many", flac(values, bits, channels, total=5000), says + "damage or the end after 1201")
            case(f"FLAC {bits} {channels}ch cut", whole[:2 * len(whole) // 3], says + "damage or the end")
            for part in (0.3, 0.6, 0.97):
                at = int(part * len(whole))
                case(f"FLAC {bits} {channels}ch damaged at {at}", whole[:at] + bytes([whole[at] ^ 0x40]) + whole[at + 1:], says + "damage")
            case(f"FLAC {bits} {channels}ch of two descriptions", flac(values, bits, channels, blocks=((0, whole[8:42]),)), "expected one description")
            case(f"FLAC {bits} {channels}ch that tells {(bits + 8) % 32 + 1} bits", flac(values, bits, channels, told_bits=(bits + 8) % 32 + 1), "in its description as in its frames")
    case("FLAC of no frames", flac([], 16, total=100), "expected samples, found none")
    case("FLAC of two days", flac(ints(16), 16, total=(1 << 36) - 1), "expected at most 600 s")


def pages_of(ogg):
    at = [m.start() for m in re.finditer(b"OggS", ogg)] + [len(ogg)]
    return [ogg[a:b] for a, b in zip(at, at[1:])]


def oggs(folder):
    """Vorbis and Opus, where ffmpeg can make them: the number of samples is known, not their values."""
    made = 0
    for codec, ending in (("libvorbis", "ogg"), ("libopus", "opus")):
        for channels in (1, 2):
            path = folder / f"made{channels}.{ending}"
            subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-f", "lavfi", "-i", "anoisesrc=d=4:r=48000:a=0.3:seed=1", "-ac", str(channels), "-c:a", codec, path], check=True)
            ogg = path.read_bytes()
            pages = pages_of(ogg)
            case(f"{codec} {channels}ch", ogg, (48000, channels, 192000))
            case(f"{codec} {channels}ch twice", ogg + ogg, "expected one stream of sound, found several")
            for i in range(2, len(pages) - 1):
                case(f"{codec} {channels}ch without page {i}", b"".join(pages[:i] + pages[i + 1:]), "expected whole pages, found damage")
            for i in range(1, len(pages)):
                case(f"{codec} {channels}ch to page {i}", b"".join(pages[:i]), "it ends early")
            for _ in range(10):
                at = random.randrange(len(ogg))
                case(f"{codec} {channels}ch damaged at {at}", ogg[:at] + bytes([ogg[at] ^ 0x10]) + ogg[at + 1:], "expected ")
                case(f"{codec} {channels}ch cut at {at}", ogg[:at], "expected ")
            made += 1
    return made


def judge(command, paths, sums):
    """How many of these files another program reads as the same samples."""
    same = 0
    for path, wanted in zip(paths, sums):
        run = subprocess.run([part.replace("FILE", str(path)) for part in command], capture_output=True)
        same += run.returncode == 0 and zlib.crc32(run.stdout) == wanted
    return same


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as own:
        folder = Path(next(iter(a for a in sys.argv[2:] if a != '--judges'), own))
        folder.mkdir(parents=True, exist_ok=True)
        for make in (waves, rooms, sizes, aiffs, flacs):
            make()
        if shutil.which("ffmpeg"):
            oggs(folder)
        else:
            print("no ffmpeg: no Vorbis and Opus")
        paths = []
        for i, (name, content, _) in enumerate(cases):
            paths.append(folder / f"{i:04}.sound")
            paths[-1].write_bytes(content)
        run = subprocess.run([program], input="".join(f"{path}\n" for path in paths), capture_output=True, encoding="utf-8")
        lines = run.stdout.splitlines()
        bad, read = [] if run.returncode == 0 and len(lines) == len(cases) else [f"{program}: exit {run.returncode} after {len(lines)} of {len(cases)} files"], []
        for path, line, (name, _, wanted) in zip(paths, lines, cases):
            if isinstance(wanted, str):
                if not re.search(re.escape(str(path)) + ": .*" + wanted, line):
                    bad.append(f"{name}: {line}: expected a line with {wanted!r}")
                continue
            rate, channels, values = wanted
            if isinstance(values, int):
                fits = line.startswith(f"ok {rate} {channels} {values} ")
            else:
                total = zlib.crc32(array.array("f", values).tobytes())
                fits = line == f"ok {rate} {channels} {len(values) // channels} {total}"
                read.append((path, total))
            if not fits:
                bad.append(f"{name} ({path.name}): {line}: expected its {channels} channels at {rate} Hz")
        print("\n".join(bad[:40]))
        for name, command in (("ffmpeg", ["ffmpeg", "-loglevel", "error", "-i", "FILE", "-f", "f32le", "-c:a", "pcm_f32le", "-"]), ("sox", ["sox", "-t", "wav", "FILE", "-t", "f32", "-"])):
            if shutil.which(name) and "--judges" in sys.argv:
                print(f"{name}: the same samples of {judge(command, *zip(*read))} of {len(read)} files")
        print(f"{len(cases)} files: {len(cases) - len(bad)} as wanted, {sum(not isinstance(w, str) for _, _, w in cases)} of them to be read")
        return 1 if bad else 0


sys.exit(main())
