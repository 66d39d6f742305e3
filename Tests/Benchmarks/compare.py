#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Medians of the figures that ComparedRun has told of two commits. Usage: compare.py SET BEFORE.tsv AFTER.tsv"""
import statistics
import sys


def figures(path):
    found = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            name, value = line.rstrip("\n").split("\t")
            found.setdefault(name, []).append(float(value))
    return {name: statistics.median(values) for name, values in found.items()}


def main(instructions, before, after):
    old, new = figures(before), figures(after)
    print(f"| {instructions} | before | after | after / before |\n| --- | --- | --- | --- |")
    for name, value in new.items():
        print(f"| {name} | {old[name]:.4g} | {value:.4g} | {value / old[name]:.2f} |")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
