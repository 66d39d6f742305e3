#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A presentation's time, felt by the hand that holds the presenter: one enchanter on it, no glance at a clock.

    presentation-timer.py 20 10,5,1 --device JACK:system [further options of physvib play]

Of twenty minutes, one pulse is felt when ten are left, two at five, three at one, and a long one at the end. The whole plan is handed
over at once, so that nothing here has to be in time. `again` on standard input starts it anew, `stop` gives it up, `status` says
how many vibrations are still to come; where the input ends, all of them are felt.
"""
import signal
import sys
import time

from player import Player

PULSE_SECONDS, GAP_SECONDS, LAST_SECONDS = 0.15, 0.15, 1.5
DAY = "86400"


def plan(player, seconds, left):
    player.say("stop")
    for pulses, before in enumerate(sorted(left, reverse=True), 1):
        player.say("pattern", enchanters="A" * pulses, pulse_s=PULSE_SECONDS, gap_s=GAP_SECONDS, level=0.8, **{"in": seconds - before})
    player.say("phantom", place="A", seconds=LAST_SECONDS, level=0.8, **{"in": seconds})


def main():
    try:
        seconds = 60.0 * float(sys.argv[1])
        left = [60.0 * float(minutes) for minutes in sys.argv[2].split(",")]
        if not all(0 < before < seconds for before in left):
            raise ValueError
    except (IndexError, ValueError):
        sys.exit("presentation-timer: expected MINUTES LEFT,LEFT,... and options of physvib play, like 20 10,5,1 --device JACK:system")
    player = Player("--layout", "phone1", "--seconds", DAY, *sys.argv[3:])
    plan(player, seconds, left)
    for number, line in enumerate(sys.stdin, 1):
        word = line.strip()
        if word == "again":
            plan(player, seconds, left)
        elif word == "stop":
            player.say("stop")
        elif word == "status":
            print(f"{player.ask('status')['waiting']:.0f} vibrations to come", flush=True)
        elif word:
            print(f"presentation-timer: line {number}: expected again, stop or status", file=sys.stderr)
    while player.ask("status")["waiting"] > 0:
        time.sleep(0.2)
    time.sleep(LAST_SECONDS + 0.5)
    player.process.send_signal(signal.SIGINT)
    sys.exit(player.process.wait())


if __name__ == "__main__":
    main()
