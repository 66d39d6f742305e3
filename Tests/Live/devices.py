# SPDX-License-Identifier: GPL-3.0-or-later
"""Two worlds, two game controllers, a sound device and a board at once: each body is felt on a device of its own. Writes what the sound device should
have played; controllers and board are judged here. Usage: devices.py EXPECTED.raw SECONDS VIRTUAL_BOARD IMAGE.elf"""
import ctypes
import signal
import subprocess
import sys
import tempfile
import time
from ctypes import CFUNCTYPE, Structure, c_char_p, c_int, c_uint16, c_uint32, c_void_p
from pathlib import Path

import numpy as np
import physvib

path, seconds, virtual_board, image = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4]
SECOND, RATE, STEP, FIELD = 1_000_000_000, 48000, 0.01, (1.0, 1.0)
SOUND, FIRST_PAD, SECOND_PAD, BOARD = range(4)

RUMBLE = CFUNCTYPE(c_int, c_void_p, c_uint16, c_uint16)


class Description(Structure):  # SDL_VirtualJoystickDesc of SDL 2.24
    _fields_ = [("version", c_uint16), ("type", c_uint16), ("naxes", c_uint16), ("nbuttons", c_uint16), ("nhats", c_uint16), ("vendor_id", c_uint16),
                ("product_id", c_uint16), ("padding", c_uint16), ("button_mask", c_uint32), ("axis_mask", c_uint32), ("name", c_char_p), ("userdata", c_void_p),
                ("update", c_void_p), ("set_player", c_void_p), ("rumble", RUMBLE), ("triggers", c_void_p), ("led", c_void_p), ("effect", c_void_p)]


sdl = ctypes.CDLL("libSDL2-2.0.so.0")
sdl.SDL_SetHint(b"SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS", b"1")
assert sdl.SDL_InitSubSystem(0x200 | 0x2000) == 0  # joysticks and controllers
kept = []  # what SDL calls has to stay
version = (ctypes.c_uint8 * 3)()
sdl.SDL_GetVersion(version)
TAKEN = 0 if version[2] < 50 else 1  # sdl2-compat asks SDL 3, to which 0 is a failure


def virtual_pad(name: str) -> "list[tuple[int, int]]":
    told: "list[tuple[int, int]]" = []

    def rumble(_: object, low: int, high: int) -> int:
        told.append((low, high))
        return TAKEN

    description = Description(version=1, type=1, naxes=6, nbuttons=15, name=name.encode(), rumble=RUMBLE(rumble))
    kept.append(description)
    assert sdl.SDL_JoystickAttachVirtualEx(ctypes.byref(description)) >= 0
    return told


def changes(commands: "list[tuple[int, int]]") -> "list[tuple[int, int]]":
    """Without repeats, from the first that is not at rest."""
    found = [(0, 0)]
    for command in commands:
        if command != found[-1]:
            found.append(command)
    return found


def world_of(devices: "tuple[int, int]") -> physvib.World:
    """A floor, and two bodies that each hit it every 0.6 s."""
    world = physvib.World(normalisation_s_per_m=0.2, hand_mass_kg=0.0)
    world.set_body(0)
    for body, device in enumerate(devices, 1):
        world.set_body(body, mass_kg=0.2, is_camera=True, frequency_hz=150.0 + 20 * body, decay_per_s=40.0, device=device)
    return world


def step(world: physvib.World, number: int, shift: int) -> None:
    with world.step(STEP):
        for body in (1, 2):
            if (number + shift + 30 * body) % 60 == 0:
                world.touch(0, body, x_m=0.2 * body + 0.1, y_m=0.4, approach_m_per_s=2.0, restitution=0.5, gap_m=0.0037 * body)


def until(is_true, told) -> None:
    for _ in range(2000):
        if is_true():
            return
        time.sleep(0.01)
    raise AssertionError(told())


with tempfile.TemporaryDirectory() as folder:
    port, log = Path(folder, "port"), Path(folder, "log")
    board = subprocess.Popen([virtual_board, image, "--link", port, "--log", log], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        told = [virtual_pad("left hand"), virtual_pad("right hand")]
        until(port.exists, lambda: "the virtual board does not start")
        names = [device.name for device in physvib.devices()]
        assert {"JACK:system", "PAD:left hand", "PAD:right hand"} <= set(names), names
        lives = [physvib.Live(name, field_m=FIELD, level_db=0.0, steps_per_s=100, longest_gap_s=0.3)
                 for name in ("JACK:system", "PAD:left hand", "PAD:right hand", f"BOARD:{port}")]
        latencies = [live.latency_ns for live in lives]
        until(lambda: all(live.now_ns > SECOND for live in lives), lambda: [live.status for live in lives])

        worlds = [world_of((SOUND, FIRST_PAD)), world_of((SECOND_PAD, BOARD))]
        twins = [world_of((SOUND, FIRST_PAD)), world_of((SECOND_PAD, BOARD))]  # the same, to be asked what was made
        starts: "list[list[int]]" = [[], []]
        firsts: "list[list[int] | None]" = [None, None]
        began = time.monotonic()
        for number in range(int((seconds - 2) / STEP)):
            for which, world in enumerate(worlds):
                step(world, number, 17 * which)
                step(twins[which], number, 17 * which)
                starts[which] = physvib.follow_each(lives, world, starts[which])
                firsts[which] = firsts[which] or starts[which]
            time.sleep(max(0.0, began + (number + 1) * STEP - time.monotonic()))
        assert starts == firsts, "a world was held up"
        made: "list[np.ndarray]" = [np.zeros(0, dtype=physvib.EVENT)] * 4
        for which, twin in enumerate(twins):
            events = twin.take(at_once=True)
            for device in range(4):
                own = events[[twin.device_of(int(body)) == device for body in events["fixture"]]].copy()
                own["time_ns"] += starts[which][device]
                made[device] = np.sort(np.concatenate([made[device], own]), order="time_ns")
        assert all(len(own) >= (seconds - 3) / 0.6 - 1 for own in made), [len(own) for own in made]
        time.sleep(1.5)
        statuses = [live.status for live in lives]
        print("events", [len(own) for own in made], "late", [status.late for status in statuses], "L ms", [round(ns * 1e-6, 1) for ns in latencies])
        assert all(status.late == 0 and status.rejected == 0 and not status.trouble for status in statuses), statuses

        # One device silent, the others not.
        lives[FIRST_PAD].silence()
        assert [live.status.is_silent for live in lives] == [False, True, False, False]
        until(lambda: not told[0] or told[0][-1] == (0, 0), lambda: told[0][-3:])
        for live in lives:
            live.close()
    finally:
        board.send_signal(signal.SIGINT)
        board.wait()
    sounds = [int(line.split(",")[0]) for line in log.read_text().splitlines()[1:] if line.endswith(",sound")]

# The controllers: the commands of the model for their own events, each once.
for pad, device in enumerate((FIRST_PAD, SECOND_PAD)):
    model = physvib.Pads(1, field_m=FIELD)
    model.strike(0, made[device])
    first, last = int(made[device]["time_ns"][0]), int(made[device]["time_ns"][-1])
    expected = [tuple(int(65535 * motor + 0.5) for motor in model.pull(at)[0]) for at in range(first - SECOND // 10, last + SECOND, SECOND // 1000)]
    assert changes(told[pad]) == changes(expected), (pad, changes(told[pad])[:12], changes(expected)[:12])
    print(f"controller {pad + 1}: {len(changes(expected)) - 1} commands, as the model's")

# The board: its events, at their times.
apart = np.diff(sounds) - np.diff(made[BOARD]["time_ns"])
assert len(sounds) == len(made[BOARD]) and np.abs(apart).max() < 2_000_000, (len(sounds), len(made[BOARD]), apart)
print(f"board: {len(sounds)} onsets, at most {np.abs(apart).max() * 1e-6:.2f} ms from their distances")

samples = physvib.render(made[SOUND], (starts[0][SOUND] / SECOND) + seconds + 2, field_m=FIELD, rate_hz=RATE)
np.ascontiguousarray(samples.T).tofile(path)
