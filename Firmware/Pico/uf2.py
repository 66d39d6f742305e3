#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The file that is dropped onto a Pico: uf2.py PLATFORM IMAGE.bin IMAGE.uf2 (https://github.com/microsoft/uf2)."""
import struct
import sys

FAMILIES = {"rp2040": 0xE48BFF56, "rp2350-arm-s": 0xE48BFF59}
FLASH, PAGE = 0x10000000, 256


def main(platform, image, out):
    data = open(image, "rb").read()
    pages = [data[at : at + PAGE].ljust(PAGE, b"\0") for at in range(0, len(data), PAGE)]
    with open(out, "wb") as file:
        for number, page in enumerate(pages):
            head = (0x0A324655, 0x9E5D5157, 0x2000, FLASH + PAGE * number, PAGE, number, len(pages), FAMILIES[platform])
            file.write(struct.pack("<8I", *head) + page.ljust(476, b"\0") + struct.pack("<I", 0x0AB16F30))


if len(sys.argv) != 4 or sys.argv[1] not in FAMILIES:
    sys.exit(f"expected: uf2.py {'|'.join(FAMILIES)} IMAGE.bin IMAGE.uf2")
main(*sys.argv[1:])
