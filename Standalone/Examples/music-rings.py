#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A song shared at one table: its beats on the rings of four friends, while others hear it.

    PLAYER=aplay music-rings.py song.wav --device JACK:system [further options of physvib play]

Low beats are felt by all four at once; all others go round the table, from ring to ring. PLAYER is what plays the song aloud, if anything
does: it is started so that what it plays and what is felt begin together.
"""
import csv
import os
import subprocess
import sys
import tempfile
import time

from player import PROGRAM, Player

RINGS = "ABCD"
LOW_DECAY = 15  # per second: by it a strike says that it is of the low band
AHEAD_SECONDS = 2.0


def beats(song):
    """Of a single enchanter, in time order."""
    with tempfile.TemporaryDirectory() as folder:
        events = os.path.join(folder, "beats.csv")
        found = subprocess.run([PROGRAM, "beats", song, "--layout", "phone1", "--out", events], stdout=subprocess.DEVNULL)
        if found.returncode != 0:
            sys.exit(found.returncode)
        with open(events, newline="") as lines:
            return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def strikes(rows):
    """Second, rings and values of each."""
    turn = 0
    for row in rows:
        values = {"frequency_hz": float(row["frequency_hz"]), "decay_per_s": float(row["decay_per_s"]), "level": float(row["amplitude"])}
        everybody = values["decay_per_s"] == LOW_DECAY
        yield float(row["time_s"]), RINGS if everybody else RINGS[turn % len(RINGS)], values
        turn += not everybody


def main():
    if len(sys.argv) < 2:
        sys.exit("music-rings: expected SONG.wav and options of physvib play")
    rows = beats(sys.argv[1])
    seconds = AHEAD_SECONDS + float(rows[-1]["time_s"]) + 2.0
    player = Player("--keep-playing", "--layout", "ring4", "--seconds", f"{seconds:.1f}", *sys.argv[2:])
    start = player.ask("status")["session_s"] + AHEAD_SECONDS
    begins = time.monotonic() + AHEAD_SECONDS + player.ask("latency")["play_out_s"]
    for second, rings, values in strikes(rows):
        for ring in rings:
            player.say("strike", place=ring, law="alone", at=start + second, **values)
    if "PLAYER" in os.environ:
        time.sleep(max(0.0, begins - time.monotonic()))
        subprocess.Popen([*os.environ["PLAYER"].split(), sys.argv[1]])
    player.process.stdin.close()
    sys.exit(player.process.wait())


if __name__ == "__main__":
    main()
