# SPDX-License-Identifier: GPL-3.0-or-later
"""Hits to the left and to the right by the library: ears.py play SECONDS; and the judge of recordings of four actuators and two ears:
ears.py judge RECORDING NAME. Actuators A and C of phone4 are left, B and D right."""
import sys
import time

import numpy as np


def play(seconds: float) -> None:
    import physvib
    with physvib.Live("JACK:system", field_m=(1.0, 1.0), level_db=0.0, sound_output=4, sound_db=0.0) as live:
        for k in range(int(seconds * 5)):
            live.impact(0.1 if k % 2 else 0.9, 0.5, 0.5, material="wooden board")
            time.sleep(0.2)
        try:
            physvib.Live("JACK:system", first_output=5)
        except physvib.PhysVibError as error:
            assert "sound_output" in str(error), error
        else:
            raise AssertionError("an actuator on an ear's output")


def judge(recording: str, name: str) -> None:
    samples = np.fromfile(recording, np.float32).reshape(-1, 6).astype(float)
    hand, ear = samples[:, :4], samples[:, 4:]
    felt, heard = hand.sum(axis=1), ear.sum(axis=1)
    reach = 240
    fits = [np.dot(felt[reach:-reach], heard[reach + lag:len(heard) - reach + lag]) for lag in range(-reach, reach + 1)]
    lag = int(np.argmax(fits)) - reach
    tiles = len(hand) // 2400
    power = np.square(samples[:tiles * 2400]).reshape(tiles, 2400, 6).sum(axis=1)
    loud = power[:, 4:].sum(axis=1) > 0.01 * power[:, 4:].sum(axis=1).max()
    place = 10 * np.log10((power[loud, 0] + power[loud, 2] + 1e-12) / (power[loud, 1] + power[loud, 3] + 1e-12))
    sides = 10 * np.log10((power[loud, 4] + 1e-12) / (power[loud, 5] + 1e-12))
    alike = np.corrcoef(place, sides)[0, 1]
    print(f"{name}: ear {lag} frames behind hand; left over right {sides.min():.0f} to {sides.max():.0f} dB, with the hand's by {alike:.2f}")
    assert lag == 0 and np.ptp(sides) > 6 and alike > 0.8


if sys.argv[1] == "play":
    play(float(sys.argv[2]))
else:
    judge(sys.argv[2], sys.argv[3])
