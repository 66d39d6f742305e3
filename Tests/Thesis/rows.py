#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Each call of `physvib thesis` runs, in the order of the table, in an empty folder: rows.py PHYSVIB. Recordings and music, which only people have, are tones here. Each file that a call names is there afterwards,
and each equation, figure, table and section of chapters 3 to 6 has a row. Prints what is not so; exit code 1 if anything is."""
import csv
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import wave
from pathlib import Path

bad = []


def tone(path: Path, seconds: float, at) -> None:
    rate = 8000
    with wave.open(str(path), "wb") as out:
        channels = len(at(0.0))
        out.setparams((channels, 2, rate, 0, "NONE", ""))
        out.writeframes(b"".join(struct.pack("<h", round(32000 * x)) for n in range(round(seconds * rate)) for x in at(n / rate)))


def isolation(folder: Path) -> None:
    """Four layers and none, at three voltages that make no difference."""
    folder.mkdir()
    lines = ["file,material,softener_percent,thickness_mm,frequency_hz,voltage_v,axis"]
    for number, (material, softener, thickness, hz, axis, volts) in enumerate((m, s, t, f, a, v) for m, s, t in (("reference", "", ""), ("0010", "15", "3"), ("0030", "5", "3"), ("0030", "15", "3"), ("0030", "15", "6"))
                                                                             for f in (50, 150, 250, 350, 450) for a in "xz" for v in ("0.6", "1.8", "3")):
        passed = 1.0 if material == "reference" else (0.35 if material == "0010" else 0.2) * (60 / (hz + 10)) ** 0.5 * (1.2 if softener == "5" else 1.0) * (3 / float(thickness)) ** 0.5 * (1 + number * 7 % 11 / 15)
        tone(folder / f"{number}.wav", 0.1, lambda t: [float(volts) / 6 * share * passed * math.sin(2 * math.pi * hz * t) for share in (1.0, 0.6, 0.3)])
        lines.append(f"{number}.wav,{material},{softener},{thickness},{hz},{volts},{axis}")
    (folder / "conditions.csv").write_text("\n".join(lines) + "\n")


def parts() -> list:
    figures = [f"Fig. {chapter}.{n}" for chapter, most in ((3, 12), (4, 9), (5, 14), (6, 1)) for n in range(1, most + 1)]
    equations = [f"Eq. {chapter}.{n}" for chapter, most in ((3, 2), (4, 5), (5, 7), (6, 2)) for n in range(1, most + 1)]
    sections = "2.2.5 3.1 3.1.1 3.1.2 3.2.1 3.2.2 3.2.3 4.1 4.1.2 4.2 4.2.2 5.1.1 5.1.2 5.1.3 5.1.4 5.1.6 5.2 5.2.1 5.2.2 5.3 5.3.2 6.1 6.2.1 6.3".split()
    return figures + equations + ["Table 4.1", "Table 5.1"] + sections


def run(call: str, folder: Path) -> None:
    done = subprocess.run(["sh", "-c", call], cwd=folder, capture_output=True, encoding="utf-8")
    if done.returncode != 0:
        bad.append(f"{call}: exit code {done.returncode}: {done.stderr.strip()[-300:]}")
    for name in re.findall(r"--(?:out|events|picture|counts|pattern|export|render) (\S+)", call):
        if not (folder / name).exists():
            bad.append(f"{call}: expected {name} afterwards")


def scenes(folder: Path, gains: str) -> None:
    """Each hit of twelve scenes has the amplitude of Eq. 5.4 and 5.7 with one m_h, times the drive_gain that the row tells (1 is what is left), and the length of Eq. 5.5."""
    pairs = [f"{scene} --set pair={pair}" for scene in ("drop", "box-study") for pair in ("rubber-concrete", "wood-wood", "steel-steel")]
    for call in ["shake-the-box", "fruit-basket", "driving", "marbles", "drawing", "drop --set height=3", *pairs, "drop --set screen=2.9 --set drive_gain=1", "box-study --set walls=0.02 --set drive_gain=1"]:
        run(f"physvib render {call} --timing release --gamma 0.1 --seconds 6 --out scene.wav --events scene.csv", folder)
        scene = call.split()[0]
        gain = re.search(r"drive_gain=(1)" if "drive_gain" in call else rf"{scene} ([\d.]+)", call + gains)
        lines = (folder / "scene.csv").read_text().splitlines()
        width = float(re.search(r"field_m=([\d.]+),", lines[0])[1])
        hits = [hit for hit in csv.DictReader(lines[1:]) if hit.get("contact", "hit") in ("", "hit")]
        masses = [float(gain[1] if gain else 1) * float(hit["impulse_ns"]) / float(hit["amplitude"]) / (2 * width) - float(hit["mass_kg"]) for hit in hits]
        heaviest = max(float(hit["mass_kg"]) for hit in hits)
        if len(hits) < 5 or min(masses) < heaviest * 0.99 or max(masses) - min(masses) > 1e-3 * max(masses):
            bad.append(f"{call}: expected a drive_gain as the row tells and one m_h, found m_h of {min(masses)} to {max(masses)} kg")
        if any(abs(float(hit["duration_s"]) - math.log(10) / float(hit["decay_per_s"])) > 2e-9 for hit in hits):
            bad.append(f"{call}: expected lengths by Eq. 5.5")


def samples(path: Path) -> list:
    """Of each channel, of a 32-bit float WAV."""
    data = path.read_bytes()
    channels = struct.unpack_from("<H", data, data.index(b"fmt ") + 10)[0]
    found = struct.unpack_from(f"<{struct.unpack_from('<I', data, data.index(b'data') + 4)[0] // 4}f", data, data.index(b"data") + 8)
    return [found[j::channels] for j in range(channels)]


def table(path: Path) -> list:
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))


def of_isolation(folder: Path) -> None:
    """One curve per voltage of one layer; U counted by hand, what differs, and Bonferroni's correction."""
    told = (folder / "fig3-5.svg").read_text()
    if not all(f">0030, 15 %, 3 mm, {volts} V<" in told for volts in ("0.6", "1.8", "3")):
        bad.append("fig3-5.svg: expected curves of 0.6, 1.8 and 3 V")
    if not shutil.which("Rscript"):
        return
    means = {}
    for row in table(folder / "gammas.csv"):
        means.setdefault(row["material"], []).append(float(row["gamma"]))
    tests = table(folder / "isolation-tests.csv")
    above = sum((a > b) + 0.5 * (a == b) for a in means["0010"] for b in means["0030"])
    if [float(row["statistic"]) for row in tests if row["test"] == "Mann-Whitney U"] != [above]:
        bad.append(f"isolation-tests.csv: expected U = {above}")
    differ = {row["factor"]: float(row["p"]) < 0.01 for row in tests if row["test"].startswith("Kruskal")}
    if differ != {"frequency_hz": True, "axis": False, "softener_percent": False, "thickness_mm": True, "voltage_v": False}:
        bad.append(f"isolation-tests.csv: expected frequency and thickness to differ, found {differ}")
    for factor in differ:
        pairs = [row for row in tests if row["factor"] == factor and row["test"] == "Wilcoxon V"]
        if any(abs(float(row["p_bonferroni"]) - min(1.0, len(pairs) * float(row["p"]))) > 1e-12 for row in pairs):
            bad.append(f"isolation-tests.csv: expected Bonferroni's correction of {len(pairs)} pairs of {factor}")
    bars = re.findall(r'<text [^>]*font-weight="bold">([^<]*)</text>', (folder / "fig3-4.svg").read_text())
    if [words for words in bars if words.startswith("Gamma")] != [f"Gamma by {factor}" for factor in ("silicone", "frequency (Hz)", "axis", "softener (%)", "thickness (mm)", "voltage (V)")]:
        bad.append(f"fig3-4.svg: expected six factors, found {bars}")
    letters = {factor: [words for words in bars[bars.index(f"Gamma by {factor}") + 1 :][:count]] for factor, count in (("silicone", 2), ("axis", 2), ("thickness (mm)", 2))}
    if letters != {"silicone": ["B", "A"], "axis": ["", ""], "thickness (mm)": ["B", "A"]}:
        bad.append(f"fig3-4.svg: expected letters where levels differ, found {letters}")


def release_delays(folder: Path) -> None:
    """Each contact of the falls of study 1 lasts a physics step of 10 ms or more, from the step in which it began, and at most 50 ms (5.1.3)."""
    for pair in ("rubber-concrete", "wood-wood", "steel-steel"):
        for height in (1, 2, 3):
            times = []
            for timing in ("onset", "release"):
                run(f"physvib render drop --set pair={pair} --set height={height} --set falls=once --seconds 3 --timing {timing} --events fall.csv --out fall.wav", folder)
                times.append([float(row["time_s"]) for row in table(folder / "fall.csv")])
            if len(times[0]) != len(times[1]) or any(round(100 * end) <= math.floor(100 * begin) or end - begin > 0.05 + 1e-9 for begin, end in zip(*times)):
                bad.append(f"drop of {pair} from {height} m: expected contacts of 10 to 50 ms, found {times}")


def static_masses(folder: Path) -> None:
    """Of a static source that states no mass it follows from density and area, as those of Table 5.1 do (5.1.2)."""
    scene = (Path(__file__).parents[2] / "Source/Scene/Scenes/drop.json").read_text()
    (folder / "no-mass.json").write_text(re.sub(r'"(/bodies/0/)?mass_kg": [\d.]+,?', "", scene))
    for pair, mass in (("rubber-concrete", 870), ("wood-wood", 739.5), ("steel-steel", 6803.4)):
        run(f"physvib render no-mass.json --set pair={pair} --seconds 3 --events fall.csv --out fall.wav", folder)
        found = {round(float(row["mass_kg"]), 6) for row in table(folder / "fall.csv")}
        if found != {mass}:
            bad.append(f"drop of {pair} without mass_kg: expected a plate of {mass} kg, found {found}")


def what_they_print(folder: Path) -> None:
    """What some of the calls are told to have."""
    of_isolation(folder)
    release_delays(folder)
    static_masses(folder)
    if not all(f'stroke="{colour}"' in (folder / "fig4-6.svg").read_text() for colour in ("#00f", "#000", "#f00", "#0cc")):
        bad.append("fig4-6.svg: expected blue, black, red and cyan columns")
    if shutil.which("Rscript"):
        for report, kind in (("report-places", "t"), ("report-choices", "W")):
            pairs = [(row["statistic"], row["correction"].split(",")[0]) for row in table(folder / report / "tests.csv") if row["test"].startswith("pairs by") and row["p"]]
            if set(pairs) != {(kind, "Bonferroni")}:
                bad.append(f"{report}/tests.csv: expected pairs by {kind} with Bonferroni's correction, found {set(pairs)}")
    levels = {(row["stimulus"], f"{float(row['level_db']):.9f}") for row in table(folder / "levels.csv")}
    if {(row["stimulus"], f"{float(row['level_db']):.9f}") for row in table(folder / "by-experts/by-experts-P20.csv")} - levels:
        bad.append("by-experts: expected the mean levels of three experts")
    run("physvib render box-study --method AF-FF-DRV --fixed-level each --limiter off --seconds 3 --out free.wav", folder)
    asked, live = ([max(map(abs, channel)) for channel in samples(folder / name)] for name in ("free.wav", "live.wav"))
    if max(asked) < 1.5 or any(abs(found - min(1.0, peak)) > 1e-6 for peak, found in zip(asked, live)):
        bad.append(f"live.wav: expected each output within 1 by itself, of peaks of {asked}, found {live}")
    nearest = [max(map(abs, samples(folder / name)[2])) for name in ("linear-law.wav", "outer.wav")]
    if not nearest[0] < nearest[1] < 1.0:
        bad.append(f"outer.wav: expected more than the linear law's at the nearest actuator, found {nearest}")
    onsets = [next(n for n, x in enumerate(channel) if x) for channel in samples(folder / "gap.wav")]
    if onsets not in ([1, 240], [1, 241]):
        bad.append(f"gap.wav: expected outputs 5 ms apart, found them begin at {onsets}")
    run("physvib render box-study --method AF-FF-DRV --fixed-level each --limiter off --rate 5000 --seconds 4 --out free.wav", folder)
    for asked, got in zip(samples(folder / "free.wav"), samples(folder / "limited.wav")):
        def differs(first: int) -> float:  # blocks begin somewhere, as the limiter's look-ahead is cut off
            blocks = [range(max(0, n), min(n + 50, len(asked))) for n in range(first - 50, len(asked), 50)]
            peaks = [max([1.0, *(abs(asked[n]) for n in block)]) for block in blocks]
            return max(abs(asked[n] / peak - got[n]) for block, peak in zip(blocks, peaks) for n in block)

        if min(map(differs, range(1, 51))) > 1e-6:
            bad.append("limited.wav: expected each 10 ms of each output divided by its own peak, where that is above 1")
    run("physvib render box-study --set pair=wood-wood --limiter off --seconds 4 --out mode.wav --events mode.csv", folder)
    line, (first, second) = samples(folder / "linear.wav")[0], [float(row["time_s"]) for row in csv.DictReader((folder / "mode.csv").read_text().splitlines()[1:])][:2]
    mode, length, begin = samples(folder / "mode.wav")[0], math.log(10) / 106.99, math.ceil(first * 48000)
    if not 0.9 < max(map(abs, line)) / max(map(abs, mode)) < 1.2 or any(line[begin + round(length * 48000) + 2 : math.floor(second * 48000)]):
        bad.append("linear.wav: expected hits as high as the mode's, of 21.5 ms")
    tests = list(csv.DictReader((folder / "report-places/tests.csv").read_text().splitlines()[1:])) if shutil.which("Rscript") else []
    single = [(row["df1"], row["df2"]) for row in tests if "single trials" in row["test"]]
    if tests and single != [("6", "2750"), ("4", "2750"), ("24", "2750")] * 8:
        bad.append(f"report-places/tests.csv: expected the degrees of freedom of Table 4.1, found {single}")
    if '"of the median, by ranks"' not in (folder / "report-choices/choices.csv").read_text():
        bad.append("report-choices: expected medians, as Fig. 5.8 has them")
    hits = [row for row in csv.DictReader((folder / "amplitudes.csv").read_text().splitlines()[1:])]
    if not hits or float(hits[0]["amplitude"]) > 0.1:
        bad.append("amplitudes.csv: expected rubber's fall of 3 m, by Eq. 5.7 alone")


physvib = Path(sys.argv[1]).resolve()
os.environ["PATH"] = f"{physvib.parent}:{os.environ['PATH']}"
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    isolation(folder / "isolation")
    tone(folder / "song.wav", 4.0, lambda t: [0.9 * math.sin(2 * math.pi * 80 * t) * math.exp(-20 * (t % 0.5))])
    subprocess.run([physvib, "thesis", "--out", "thesis"], cwd=folder, check=True, capture_output=True)
    with open(folder / "thesis/thesis.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in rows:
        if not row["run"] and not row["needs"]:
            bad.append(f"{row['at']}: expected a call, or what it needs")
        if not row["run"].startswith("Rscript") or shutil.which("Rscript"):
            run(row["run"], folder)
    scenes(folder, next(row["differs"] for row in rows if row["at"].startswith("Eq. 5.4")))
    what_they_print(folder)
    told = ", ".join(row["at"] for row in rows)
    bad += [f"expected a row of {part}" for part in parts() if not re.search(rf"(?:^|, ){re.escape(part)}(?:[, ]|$)", told)]
    if keep := os.environ.get("PHYSVIB_KEEP"):  # to look at what was drawn
        shutil.copytree(folder, keep)
if bad:
    sys.exit("\n".join(bad))
print(f"{len(rows)} rows, {sum(bool(row['run']) for row in rows)} calls")
