#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns the JSON of physvib-bench into the table and the plot of Docs/speed.md.

usage: report.py BENCH.json Docs/speed.md Docs/speed.svg
Replaces what stands between the two marks in the document; needs nothing but Python."""
import json
import math
import re
import sys

BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"
COLOURS = {"avx512": "#0b5394", "avx2": "#c55a11", "sse4": "#38761d", "neon": "#741b47", "scalar": "#666666"}


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as info:
        lines = [line.split(":", 1)[1].strip() for line in info if re.match(r"model name|cpu family|model\s*:", line)]
    family, model, name = lines[:3]
    return f"{name} (family {family}, model {model})"


def kernels(runs, name="kernel"):
    """{(set, channels, modes): run} at a block of 64."""
    found = {}
    for run in runs:
        match = re.match(rf"{name}/(\w+)/channels:(\d+)/modes:(\d+)/block:64/", run["name"])
        if match and "share" in run:
            found[match[1], int(match[2]), int(match[3])] = run
    return found


def kernel_rows(runs):
    low, high = kernels(runs), kernels(runs, "kernel_800_1000Hz")
    sets = [s for s in COLOURS if (s, 4, 64) in low]
    yield "| mode bank, 64-frame blocks: share (10^9 msc/s) | " + " | ".join(sets) + " |"
    yield "| --- |" + " --- |" * len(sets)
    for title, table, channels, modes in [("N = 4, V = 64", low, 4, 64), ("N = 4, V = 1024", low, 4, 1024), ("N = 8, V = 64", low, 8, 64),
                                          ("N = 8, V = 1024", low, 8, 1024), ("N = 8, V = 1024, all 800 to 1000 Hz", high, 8, 1024)]:
        cells = [table[s, channels, modes] for s in sets]
        yield f"| {title} | " + " | ".join(rate_of(s, c) for s, c in zip(sets, cells)) + " |"
    yield "| peak, 10^9 multiply-adds/s | " + " | ".join(f"{low[s, 4, 64]['peak_Gmadd/s']:.1f}" if s != "scalar" else "" for s in sets) + " |"


def rate_of(name, run):
    share = f"{run['share']:.2f} " if name != "scalar" else ""  # double precision: the peak is not its own
    return f"{share}({run['Gmsc/s']:.1f})"


def other_rows(runs):
    by_name = {run["name"]: run for run in runs if not run.get("error_occurred")}

    def starting(start):
        return [run for name, run in by_name.items() if name.startswith(start)]

    yield "| what | figure |"
    yield "| --- | --- |"
    for run in starting("block/"):
        channels, modes, cold = re.findall(r":(\d+)", run["name"])[:3]
        yield (f"| % of 64 frames' time (median), {modes} modes x {channels} channels, {'cold' if cold == '1' else 'warm'} | "
               f"{run['median_%']:.3f}, p99.9 of processor time {run['cpu_p99.9_%']:.2f} |")
    for run in starting("silence"):
        yield f"| one silent 64-frame block, 8 channels | {run['cpu_time']:.0f} ns |"
    for run in starting("strikes/"):
        rate = int(re.search(r":(\d+)", run["name"])[1])
        if rate >= 1000:
            yield f"| {rate:,} strikes/s, 16 materials, 8 channels | {run['ns_per_strike']:.0f} ns a strike |"
    for run in starting("headroom/"):
        channels, modes = re.findall(r":(\d+)", run["name"])[:2]
        yield f"| whole chain, {modes} modes x {channels} channels | {run['x_real_time']:,.0f} times real time |"
    for run in (run for name in ("shake-the-box", "driving", "marbles") for run in starting(f"sceneToWav/{name}")):
        yield f"| {run['name'].split('/')[1]}, 4 channels, scene to file | {run['times_real_time']:,.0f} times real time |"


def plot(runs):
    """Share of the peak over the number of modes, for 8 channels (full) and 2 (dashed)."""
    table = kernels(runs)
    left, top, width, height, most = 64, 30, 560, 300, 2.0
    x = lambda modes: left + width * math.log2(modes / 4) / 10
    y = lambda share: top + height * (1 - share / most)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 400" font-family="sans-serif" font-size="13" fill="#222">',
           '<rect width="760" height="400" fill="#fff"/>']
    for i in range(5):
        share = i / 2
        out.append(f'<line x1="{left}" x2="{left + width}" y1="{y(share):.1f}" y2="{y(share):.1f}" stroke="{"#222" if share == 1 else "#ddd"}"/>')
        out.append(f'<text x="{left - 10}" y="{y(share) + 4:.1f}" text-anchor="end">{share:g}</text>')
    for modes in (4, 16, 64, 256, 1024, 4096):
        out.append(f'<text x="{x(modes):.1f}" y="{top + height + 20}" text-anchor="middle">{modes}</text>')
    out.append(f'<text x="{left + width / 2}" y="{top + height + 44}" text-anchor="middle">modes that sound</text>')
    out.append(f'<text x="{left}" y="18">mode-sample-channels per multiply-add that the core can do at most</text>')
    out.append(f'<text x="{left + 6}" y="{y(1) - 6:.1f}" font-size="11">one multiply-add each</text>')
    ends = []
    for name, colour in COLOURS.items():
        for channels, dash in ((8, ""), (2, ' stroke-dasharray="5 4"')):
            points = [(modes, table[name, channels, modes]["share"]) for modes in (4, 16, 64, 256, 1024, 4096) if (name, channels, modes) in table]
            if points and name != "scalar":
                path = " ".join(f"{x(m):.1f},{y(s):.1f}" for m, s in points)
                out.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
                ends.append((y(points[-1][1]), f"{name}, {channels} channels", colour))
    place = top - 100.0
    for at, text, colour in sorted(ends):  # labels do not overlap
        place = max(at + 4, place + 15)
        out.append(f'<text x="{left + width + 8}" y="{place:.1f}" fill="{colour}" font-size="12">{text}</text>')
    return "\n".join(out + ["</svg>", ""])


def main(bench, document, picture):
    with open(bench, encoding="utf-8") as file:
        result = json.load(file)
    runs = [run for run in result["benchmarks"] if not run.get("error_occurred")]
    loads = ", ".join(f"{load:.1f}" for load in result["context"].get("load_avg", []))
    text = [BEGIN, f"Machine: {processor()}, one core; load of the machine meanwhile (1, 5, 15 minutes): {loads}.", "",
            *kernel_rows(runs), "", *other_rows(runs), END]
    with open(document, encoding="utf-8") as file:
        old = file.read()
    with open(document, "w", encoding="utf-8") as file:
        file.write(old[:old.index(BEGIN)] + "\n".join(text) + old[old.index(END) + len(END):])
    with open(picture, "w", encoding="utf-8") as file:
        file.write(plot(runs))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
