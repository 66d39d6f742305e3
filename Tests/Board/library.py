# SPDX-License-Identifier: GPL-3.0-or-later
"""The library's door to a board, from Python: what is struck leaves the virtual board at its time. library.py VIRTUAL_BOARD IMAGE.elf, PYTHONPATH and
PHYSVIB_LIVE_LIBRARY set."""
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Callable

import numpy as np
import physvib


def onsets(log: Path) -> np.ndarray:
    """When the board began to sound, nanoseconds of its own clock."""
    rows = [line.split(",") for line in log.read_text().splitlines()[1:] if "," in line]
    return np.array([int(at) for at, what in rows if what == "sound"])


def until(is_true: Callable[[], bool], told: Callable[[], object]) -> None:
    """Waits, far longer than it takes; 30 s of nothing is a failure."""
    for _ in range(3000):
        if is_true():
            return
        time.sleep(0.01)
    raise AssertionError(told())


with tempfile.TemporaryDirectory() as folder:
    port, log = Path(folder, "port"), Path(folder, "log")
    board = subprocess.Popen([sys.argv[1], sys.argv[2], "--link", port, "--log", log], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        until(port.exists, lambda: "the virtual board does not start")
        live = physvib.Live(f"BOARD:{port}", field_m=(1.0, 1.0), level_db=0.0, longest_gap_s=0.1)
        assert live.status.board == "plays", live.status
        count = 60  # more than the link holds at once
        hits = physvib.events(np.cumsum(0.1 + 0.013 * (np.arange(count) % 5)), frequency_hz=200.0, decay_per_s=90.0, amplitude=0.5, x_m=0.5, y_m=0.5)
        hits["time_ns"] += live.now_ns + 300_000_000
        live.strike(hits)
        until(lambda: live.status.board_sent + live.status.board_lost >= count, lambda: live.status)
        assert live.status.board_lost == 0, live.status
        until(lambda: len(onsets(log)) >= count, lambda: (len(onsets(log)), live.status))
        apart = (onsets(log) - onsets(log)[0]) - (hits["time_ns"] - hits["time_ns"][0])
        print(f"{count} strikes, L {live.latency_ns * 1e-6:.1f} ms: at most {np.abs(apart).max() * 1e-6:.2f} ms from their times on the board")
        assert np.abs(apart).max() < 2_000_000, apart
        live.close()

        live = physvib.Live(f"None:no device+BOARD:{port}")  # beside a device; and its plug is pulled
        board.send_signal(signal.SIGSTOP)
        until(lambda: live.status.board == "sought" and live.status.trouble != "", lambda: live.status)
        print("pulled:", live.status.trouble)
        board.send_signal(signal.SIGCONT)
        until(lambda: live.status.board == "plays", lambda: live.status)
        live.close()
    finally:
        board.send_signal(signal.SIGCONT)
        board.send_signal(signal.SIGINT)
        board.wait()
