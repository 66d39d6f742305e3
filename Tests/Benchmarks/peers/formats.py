# SPDX-License-Identifier: GPL-3.0-or-later
"""The same voices in the languages of the peers. A voice: (frequency Hz, decay 1/s, amplitude, gains)."""
import math
import struct

RATE, BLOCK = 48000, 64


def as_faust(voices):
    lines = ['import("stdfaust.lib");']
    for i, (f, tau, a, gains) in enumerate(voices):
        w, r = 2 * math.pi * f / RATE, math.exp(-tau / RATE)
        split = ", ".join(f"*({g!r})" for g in gains)
        lines.append(f"v{i} = fi.tf2(0, {a * r * math.sin(w)!r}, 0, {-2 * r * math.cos(w)!r}, {r * r!r}) <: {split};")
    names = ", ".join(f"v{i}" for i in range(len(voices)))
    outputs = ", ".join("_" for _ in voices[0][3])
    return "\n".join(lines + [f"process = (1 - 1') <: {names} :> {outputs};", ""])


def as_csound(voices, seconds):
    notes = "\n".join(f"i1 0 {seconds} {f!r} {a!r} {tau!r} " + " ".join(repr(g) for g in gains) for f, tau, a, gains in voices)
    return f"""<CsoundSynthesizer>
<CsInstruments>
sr = {RATE}
ksmps = {BLOCK}
nchnls = 4
0dbfs = 1
instr 1
aSine poscil p5, p4
aDecay expon 1, p3, exp(-p6 * p3)
aVoice = aSine * aDecay
outq aVoice * p7, aVoice * p8, aVoice * p9, aVoice * p10
endin
</CsInstruments>
<CsScore>
{notes}
e
</CsScore>
</CsoundSynthesizer>
"""


def as_pure_data(voices, seconds, out):
    """A complex one-pole per voice, struck by a table whose first point is 1; two seconds go into tables, then a file."""
    lines, boxes = ["#N canvas 0 0 400 300 10;"], 0

    def box(kind, text):
        nonlocal boxes
        lines.append(f"#X {kind} 10 10 {text};")
        boxes += 1
        return boxes - 1

    wires = []

    def wire(a, outlet, b, inlet=0):
        wires.append(f"#X connect {a} {outlet} {b} {inlet};")

    kept = 2 * RATE
    box("obj", "table impulse 64")
    for j in range(4):
        box("obj", f"table t{j} {kept}")
    strike = box("obj", "tabplay~ impulse")
    sums = [box("obj", f"tabwrite~ t{j}") for j in range(4)]
    for f, tau, a, gains in voices:
        w, r = 2 * math.pi * f / RATE, math.exp(-tau / RATE)
        pole = box("obj", f"cpole~ {r * math.cos(w):.9g} {r * math.sin(w):.9g}")
        wire(strike, 0, pole)
        for j, gain in enumerate(gains):
            scaled = box("obj", f"*~ {a * gain:.9g}")
            wire(pole, 1, scaled)
            wire(scaled, 0, sums[j])
    start = box("obj", "loadbang")
    on = box("msg", "\\; pd dsp 1 \\; impulse 0 1")
    order = box("obj", "t b b b b b b")
    wire(start, 0, order)
    wire(order, 5, on)
    wire(order, 4, strike)
    for table in sums:
        wire(order, 3, table)
    write = box("msg", f"write -wave -bytes 4 {out} t0 t1 t2 t3")
    later, end = box("obj", "del 2100"), box("obj", f"del {seconds * 1000}")
    quit_ = box("msg", "\\; pd quit")
    filer = box("obj", "soundfiler")
    wire(order, 2, later)
    wire(order, 1, end)
    wire(later, 0, write)
    wire(write, 0, filer)
    wire(end, 0, quit_)
    return "\n".join(lines + wires) + "\n"


def _pascal(text):
    return bytes([len(text)]) + text.encode()


def _supercollider_definition(name, voice, seconds):
    f, tau, a, gains = voice
    constants = [f, 0.0, a, a * math.exp(-tau * seconds), seconds, *gains]  # 1: phase, done action and bus

    def ugen(kind, inputs, outputs=1, special=0):
        wires = b"".join(struct.pack(">ii", *pair) for pair in inputs)
        return _pascal(kind) + struct.pack(">biih", 2, len(inputs), outputs, special) + wires + b"\x02" * outputs

    constant = lambda i: (-1, i)
    ugens = [ugen("SinOsc", [constant(0), constant(1)]), ugen("XLine", [constant(2), constant(3), constant(4), constant(1)]),
             ugen("BinaryOpUGen", [(0, 0), (1, 0)], special=2)]
    ugens += [ugen("BinaryOpUGen", [(2, 0), constant(5 + j)], special=2) for j in range(4)]
    ugens.append(ugen("Out", [constant(1)] + [(3 + j, 0) for j in range(4)], outputs=0))
    return (_pascal(name) + struct.pack(">i", len(constants)) + struct.pack(f">{len(constants)}f", *constants) + struct.pack(">ii", 0, 0) +
            struct.pack(">i", len(ugens)) + b"".join(ugens) + struct.pack(">h", 0))


def as_supercollider(voices, seconds):
    """A score for scsynth -N: Open Sound Control bundles."""
    def text(s):
        raw = s.encode() + b"\0"
        return raw + b"\0" * (-len(raw) % 4)

    def message(address, *items):
        tags, body = ",", b""
        for item in items:
            if isinstance(item, bytes):
                tags, body = tags + "b", body + struct.pack(">i", len(item)) + item + b"\0" * (-len(item) % 4)
            elif isinstance(item, str):
                tags, body = tags + "s", body + text(item)
            else:
                tags, body = tags + "i", body + struct.pack(">i", item)
        return text(address) + text(tags) + body

    def bundle(time, messages):
        body = b"#bundle\0" + struct.pack(">II", int(time), int(time % 1 * 2**32)) + b"".join(struct.pack(">i", len(m)) + m for m in messages)
        return struct.pack(">i", len(body)) + body

    names = [f"v{i}" for i in range(len(voices))]
    definitions = [message("/d_recv", b"SCgf" + struct.pack(">ih", 2, 1) + _supercollider_definition(n, v, seconds)) for n, v in zip(names, voices)]
    notes = [message("/s_new", n, 1000 + i, 1, 0) for i, n in enumerate(names)]
    return b"".join(bundle(0, [d]) for d in definitions) + bundle(0, notes) + bundle(seconds, [message("/c_set", 0, 0)])
