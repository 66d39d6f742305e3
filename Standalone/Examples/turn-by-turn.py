#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Turn-by-turn cues on four enchanters: what a navigation program says becomes a path that one feels.

    navigation | turn-by-turn.py --device JACK:system [further options of physvib play]

A line says where and how far: `left 200`, `right 15`, `arrived`. A turn ahead is one slow path across the palm to its side; within
30 m it is two quick ones, and what the turn ahead still had to say is not said any more. Arriving is felt on all four in turn.
"""
import sys
import time

from player import Player

NEAR_METRES = 30


def cue(player, field, side, metres):
    width, height = field
    start, end = (width, 0) if side == "left" else (0, width)
    places = [[start, height / 2], [end, height / 2]]
    player.say("stop")
    if metres > NEAR_METRES:
        player.say("path", places=places, seconds=1.2, level=0.4)
        return
    for again in range(2):
        player.say("path", places=places, seconds=0.4, level=0.8, **{"in": 0.5 * again})


def main():
    player = Player(*sys.argv[1:])
    field = player.ask("layout")["field_m"]
    for number, line in enumerate(sys.stdin, 1):
        words = line.split()
        if words[:1] == ["arrived"]:
            player.say("pattern", enchanters="ABDC", pulse_s=0.12, gap_s=0.03)
        elif len(words) == 2 and words[0] in ("left", "right") and words[1].isdigit():
            cue(player, field, words[0], int(words[1]))
        elif words:
            print(f"turn-by-turn: line {number}: expected left METRES, right METRES or arrived", file=sys.stderr)
    player.ask("status")
    time.sleep(2)  # what was said last is felt; then the end of what we say is the end of the player
    player.process.stdin.close()
    sys.exit(player.process.wait())


if __name__ == "__main__":
    main()
