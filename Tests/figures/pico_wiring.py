#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws Docs/pico-wiring.svg, and prints the voltages at the amplifiers' SD pins that its resistors make.
usage: pico_wiring.py Docs/pico-wiring.svg
Fails if a voltage would let an amplifier play the wrong word, or play while it should be silent."""
import itertools
import sys

# Ohms. GP8 is pulled down to ground; node L hangs on it by a resistor, node R by a divider.
DOWN, SERIES, UPPER, LOWER = 1500.0, 1500.0, 10000.0, 5600.0
INNER, MODULE = 100000.0, 1000000.0  # of every SD pin: to ground in the amplifier; to VIN on most modules
PIN_V, VIN_V, DIODE_V = 3.3, 5.0, 0.6
# The data sheet's limits in volts: above LEFT the left word, within RIGHT the right one, below OFF nothing.
LEFT, RIGHT, OFF = 1.5, (0.83, 1.24), 0.08
IDLE_A = 2.4e-3  # of one amplifier that is on


def nodes(pin, each, modules, supply=VIN_V):
    """Volts at L and R: the pin at `pin` volts, or None for not driven; `each` amplifiers at L and as many at R."""
    up = each / MODULE if modules else 0.0
    load = each / INNER + up
    left = right = pin or 0.0
    held = pin
    for _ in range(200):  # Gauss-Seidel: three nodes, diagonally dominant
        if pin is None:
            held = (left / SERIES + right / UPPER) / (1 / DOWN + 1 / SERIES + 1 / UPPER)
        left = (held / SERIES + up * supply) / (1 / SERIES + load)
        right = (held / UPPER + up * supply) / (1 / UPPER + 1 / LOWER + load)
    return left, right


def check():
    playing, silent = [], []
    for each, modules in itertools.product((1, 2, 4), (False, True)):
        playing.append(nodes(PIN_V, each, modules))
        silent += [nodes(0.0, each, modules), nodes(None, each, modules)]
    left, right = zip(*playing)
    most = max(max(pair) for pair in silent)
    # With the amplifiers' supply off, an SD pin is a diode into their rail: what the two nodes then feed it.
    fed = (PIN_V - DIODE_V) / SERIES + max(0.0, PIN_V * LOWER / (UPPER + LOWER) - DIODE_V) * (1 / UPPER + 1 / LOWER)
    print(f"L {min(left):.2f} to {max(left):.2f} V, R {min(right):.2f} to {max(right):.2f} V, silent {most:.3f} V at most, fed while off {1e3 * fed:.1f} mA")
    assert min(left) > LEFT and RIGHT[0] < min(right) and max(right) < RIGHT[1] and most < OFF and fed < IDLE_A


INK, LINE, RED, ORANGE, BLACK, GREY = "#223344", "#334455", "#c0392b", "#b9770e", "#222222", "#95a5a6"
BUSES = {  # x, colour, label
    "LRC": (300, "#7d3c98", "LRC"), "BCLK": (322, "#2471a3", "BCLK"), "1": (344, "#1e8449", "line 1"), "2": (366, "#1e8449", "line 2"),
    "3": (388, "#1e8449", "line 3"), "4": (410, "#1e8449", "line 4"), "L": (440, ORANGE, "node L"), "R": (462, ORANGE, "node R"),
    "GND": (496, BLACK, "GND"), "5 V": (518, RED, "5 V"), "5 V, 5 to 8": (540, RED, "")}
# From the far end to the USB socket, which is drawn below: so the pins lie on the right as they do in the hand.
PICO = [("GND", 13, None), ("GP9", 12, None), ("GP8", 11, None), ("GP7", 10, "LRC"), ("GP6", 9, "BCLK"), ("GND", 8, None), ("GP5", 7, "4"), ("GP4", 6, "3"),
        ("GP3", 5, "2"), ("GP2", 4, "1"), ("GND", 3, "GND")]
TOP, PITCH, PIN = 150, 112, 14  # of the amplifiers
DASHES = ' stroke-dasharray="6 4"'  # of what only eight channels have
END = TOP + 8 * PITCH + 6


def text(x, y, words, size=12, anchor="start", colour=INK, more=""):
    return f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" fill="{colour}"{more}>{words}</text>'


def wire(path, colour, width=2.0, more=""):
    return f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width}"{more}/>'


def dot(x, y, colour):
    return f'<circle cx="{x}" cy="{y}" r="4" fill="{colour}"/>'


def box(x, y, wide, high, dashed=False):
    return f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" rx="6" fill="#fff" stroke="{LINE}" stroke-width="2"{DASHES if dashed else ""}/>'


def resistor(x, y, colour, flat=False):
    wide, high = (34, 12) if flat else (12, 34)
    return f'<rect x="{x - wide / 2}" y="{y - high / 2}" width="{wide}" height="{high}" fill="#fff" stroke="{colour}" stroke-width="2"/>'


def fuse(x, y, colour, flat=False):
    """A box over a wire that goes through it."""
    wide, high = (26, 12) if flat else (14, 26)
    return f'<rect x="{x - wide / 2}" y="{y - high / 2}" width="{wide}" height="{high}" fill="none" stroke="{colour}" stroke-width="2"/>'


# Wires of the Pico lie half a PIN beside those of the amplifiers, so that none covers another.
FIRST, STEP = TOP + 29.5 * PIN, 2 * PIN
GAP = TOP + PITCH - PIN  # the middle between amplifiers 1 and 2: no dots are near


def pico():
    top = FIRST - 36
    low = FIRST + STEP * (len(PICO) - 1)
    yield box(40, top, 150, low + 82 - top)
    yield text(115, low + 40, "Pico", 15, "middle", more=' font-weight="bold"') + text(115, low + 58, "seen from above", 11, "middle")
    yield f'<rect x="90" y="{low + 68}" width="50" height="26" rx="3" fill="#d5dbdf" stroke="{LINE}" stroke-width="2"/>' + text(115, low + 85, "USB", 11, "middle")
    for row, (name, number, bus) in enumerate(PICO):
        y, colour = FIRST + STEP * row, GREY if number == 8 else INK
        yield text(180, y + 5, f"{name}{', free' if number == 8 else ''}  (pin {number})", anchor="end", colour=colour)
        yield dot(190, y, GREY if number == 8 else LINE)
        if bus:
            x, colour, _ = BUSES[bus]
            yield wire(f"M190 {y} L{x} {y}", colour, 1.5 if bus == "GND" else 2, DASHES if bus in "34" else "") + dot(x, y, colour)
    nine = FIRST + STEP
    yield wire(f"M190 {nine} h20 v{-STEP} h-20", LINE, more=' stroke-dasharray="2 4"')
    for row, words in enumerate(("leave open;", "wire: full", "scale")):
        yield text(214, FIRST + 4 + 14 * row, words, 11)
    for row, words in enumerate(("Turn the USB socket towards you: pins 1 to 20", "are the right edge, pin 1 nearest to you. The", "left edge stays free, pins 39 and 40 too.")):
        yield text(40, low + 116 + 14 * row, words, 11)


def shut_down():
    """The pin GP8 with its four resistors, nodes L and R: ground above, so that the pin's wire crosses none of them."""
    eight, low, middle, rail = FIRST + STEP * 2, GAP, GAP + PITCH, GAP + 2 * PITCH
    yield wire(f"M190 {eight} L284 {eight} L284 {rail + 2 * PIN} L150 {rail + 2 * PIN} L150 {rail}", ORANGE)
    left, right, ground = BUSES["L"][0], BUSES["R"][0], BUSES["GND"][0]
    yield wire(f"M60 {rail} L{left} {rail} M150 {rail} L150 {low}", ORANGE) + wire(f"M60 {rail} L60 {low}", ORANGE)
    yield wire(f"M150 {middle} L{right} {middle}", ORANGE) + wire(f"M60 {low} L{ground} {low}", BLACK)
    for x, y, ohms in ((60, middle, DOWN), (150, middle + PITCH / 2, UPPER), (150, low + PITCH / 2, LOWER)):
        yield resistor(x, y, ORANGE) + text(x + 10, y + 4, f"{ohms / 1000:g} kohm", 11)
    yield resistor(240, rail, ORANGE, True) + text(240, rail - 10, f"{SERIES / 1000:g} kohm", 11, "middle")
    for x, y, colour in ((150, rail, ORANGE), (left, rail, ORANGE), (150, middle, ORANGE), (right, middle, ORANGE), (150, low, BLACK), (ground, low, BLACK)):
        yield dot(x, y, colour)
    (l_low, r_low), (l_high, r_high) = nodes(PIN_V, 4, False), nodes(PIN_V, 1, True)
    yield text(40, low - 64, "Playing:", 11) + text(40, low - 50, f"L {l_low:.1f} to {l_high:.1f} V, R {r_low:.1f} to {r_high:.1f} V.", 11)
    yield text(40, low - 36, "Silent: both below 0.08 V.", 11)


def amplifier(number):
    y = TOP + PITCH * (number - 1)
    bus = str((number + 1) // 2)
    side, rail = "L" if number % 2 else "R", "5 V" if number <= 4 else "5 V, 5 to 8"
    yield box(640, y - 8, 144, 7 * PIN + 2, number > 4)
    yield text(726, y + 30, f"amplifier {number}", anchor="middle", more=' font-weight="bold"')
    yield text(726, y + 47, f"{'left' if number % 2 else 'right'} word of line {bus}", 10, "middle")
    for row, (pin, to) in enumerate((("LRC", "LRC"), ("BCLK", "BCLK"), ("DIN", bus), ("GAIN", None), ("SD", side), ("GND", "GND"), ("VIN", rail))):
        line = y + PIN * row
        yield text(645, line + 4, pin, 9)
        if to:
            x, colour, _ = BUSES[to]
            yield wire(f"M{x} {line} L640 {line}", colour, 1.5) + dot(x, line, colour)
    gain, vin = y + 3 * PIN, y + 6 * PIN
    yield wire(f"M640 {gain} L560 {gain} L560 {vin}", RED, 1.5) + dot(560, vin, RED) + resistor(598, gain, RED, True) + text(598, gain + 3.5, "100 k", 9, "middle")
    for sign, rise in (("+", 22), ("&#8722;", 54)):
        yield wire(f"M784 {y + rise} L862 {y + rise}", "#7f8c8d") + text(790, y + rise - 4, sign)
    yield fuse(832, y + 22, "#7f8c8d", True)
    yield f'<circle cx="882" cy="{y + 38}" r="26" fill="#fff" stroke="{LINE}" stroke-width="2"/>'
    yield text(882, y + 43, "ABCDEFGH"[number - 1], 14, "middle", more=' font-weight="bold"') + text(916, y + 43, f"channel {number}")


def supply():
    """The rails' way down: the capacitor and the fuses on the amplifiers' side of the switch, then the supply."""
    ground, plus, second = BUSES["GND"][0], BUSES["5 V"][0], BUSES["5 V, 5 to 8"][0]
    start, plates, fuses, switch = TOP + 4 * PITCH + 6 * PIN, END + 26, END + 74, END + 112
    yield wire(f"M{plus} {END} L{plus} {switch} M{plus} {switch + 38} L{plus} {END + 176}", RED, 4) + wire(f"M{ground} {END} L{ground} {END + 176}", BLACK, 4)
    yield wire(f"M{second} {start} L{second} {switch - 16} L{plus} {switch - 16}", RED, 4, DASHES) + dot(plus, switch - 16, RED)
    yield fuse(plus, fuses, RED) + fuse(second, fuses, RED) + text(second + 16, fuses + 4, "3 A fuse for amplifiers 1 to 4, another for 5 to 8")
    yield dot(plus, switch, RED) + dot(plus, switch + 38, RED) + wire(f"M{plus} {switch + 38} l22 -34", RED, 3)
    yield text(plus + 38, switch + 14, "switch, within reach of") + text(plus + 38, switch + 30, "the person who feels it")
    yield wire(f"M{plus} {plates - 20} L620 {plates - 20} L620 {plates - 4}", RED) + dot(plus, plates - 20, RED)
    yield wire(f"M606 {plates - 4} h28", RED, 3) + wire(f"M606 {plates + 4} q14 -7 28 0", BLACK, 3)
    yield wire(f"M620 {plates + 2} L620 {plates + 18} L{ground} {plates + 18}", BLACK) + dot(ground, plates + 18, BLACK)
    yield text(640, plates - 6, "+") + text(656, plates - 4, "470 uF, physically near the amplifiers;") + text(656, plates + 12, "its striped lead to GND")
    yield box(430, END + 176, 200, 54) + text(530, END + 198, "supply of the amplifiers", anchor="middle", more=' font-weight="bold"')
    yield text(530, END + 216, "5 V: 3 A for four, 6 A for eight", 11, "middle")
    yield text(40, END + 172, "USB alone feeds the Pico:", more=' font-weight="bold"') + text(40, END + 188, "the 5 V go to amplifiers only.", more=' font-weight="bold"')
    yield text(40, END + 208, "Thick GND: supply to amplifiers. From there a thin wire to pin 3.", 11)


def drawn():
    high = END + 250
    yield f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1020 {high}" font-family="sans-serif" font-size="13" fill="{INK}" role="img">'
    yield "<title>Wiring: a Raspberry Pi Pico to four or eight MAX98357A amplifiers, their supply and actuators</title>"
    yield f'<rect width="1020" height="{high}" fill="#f4f6f8"/>'
    yield text(20, 28, "Raspberry Pi Pico to MAX98357A amplifiers", 18, more=' font-weight="bold"')
    yield text(20, 50, "Four channels: amplifiers 1 to 4 (physvib-pico4.uf2). Eight: the dashed ones too (physvib-pico8.uf2).", 13)
    yield text(20, 70, "Wires that cross without a dot are not connected.", 13)
    yield text(570, 96, "at each GAIN: 100 kohm to VIN (3 dB)") + text(570, 114, "in each actuator's + wire a fuse; neither end goes to ground")
    for x, colour, label in (bus for bus in BUSES.values() if bus[2]):
        yield wire(f"M{x} {TOP - 10} L{x} {END}", colour, 4 if label in ("GND", "5 V") else 2, DASHES if label in ("line 3", "line 4") else "") + text(x + 4, TOP - 16, label, 11, colour=colour, more=f' transform="rotate(-55 {x + 4} {TOP - 16})"')
    yield from pico()
    yield from shut_down()
    for number in range(1, 9):
        yield from amplifier(number)
    yield from supply()
    yield "</svg>"


if __name__ == "__main__":
    check()
    lines = list(drawn())
    lines.insert(0, "<!-- SPDX-License-Identifier: MIT -->")
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")
