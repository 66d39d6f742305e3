# SPDX-License-Identifier: MIT
"""Sessions in Python, against the command line: sessions.py LIBPHYSVIB_LIVE PHYSVIB SCENE.json, PYTHONPATH set to the package."""
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

os.environ["PHYSVIB_LIVE_LIBRARY"] = sys.argv[1]
os.environ["PHYSVIB_LIBRARY"] = str(Path(sys.argv[1]).parent / "libphysvib.so.1")
import numpy as np  # noqa: E402

import physvib  # noqa: E402

program, scene = sys.argv[2], Path(sys.argv[3])
NOWHERE = "None:no device"  # plays in time, for nobody


def hits(count: int) -> np.ndarray:
    chance = np.random.default_rng(1)
    return physvib.events(np.sort(chance.uniform(0.0, 0.9, count)), frequency_hz=chance.choice([80.0, 150.0, 333.3], count), decay_per_s=chance.uniform(20, 80, count),
                          amplitude=chance.uniform(0.0, 0.3, count), x_m=chance.uniform(0.0, 2.0, count), y_m=chance.uniform(0.0, 1.0, count))


class Sessions(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def rendered(self, path: Path, seconds: float) -> "tuple[bytes, np.ndarray]":
        """What the command line makes of it."""
        subprocess.run([program, "render", path, "--out", self.folder / "out.wav", "--events", self.folder / "out.csv", "--seconds", str(seconds)], check=True, capture_output=True)
        return (self.folder / "out.wav").read_bytes(), physvib.load_events(self.folder / "out.csv")

    def test_strikes_become_a_session_and_come_back(self) -> None:
        events = hits(100)
        made = physvib.Session(events, 1.0, layout="ring4", law="energy", field_m=(2.0, 1.0))
        made.save(self.folder / "made.json")
        with physvib.Session.load(self.folder / "made.json") as session:
            self.assertEqual((session.seconds, session.channels, session.law, session.field_m), (1.0, 4, "energy", (2.0, 1.0)))
            self.assertEqual(session.layout, physvib.Layout.preset("ring4"))
            self.assertTrue((session.events()[["time_ns", "frequency_hz", "decay_per_s", "amplitude", "x_m", "y_m"]]
                             == events[["time_ns", "frequency_hz", "decay_per_s", "amplitude", "x_m", "y_m"]]).all())
            samples = session.render()
        self.assertEqual(samples.shape, (4, 48000))
        self.assertEqual(samples.tobytes(), physvib.render(events, 1.0, layout="ring4", law="energy", field_m=(2.0, 1.0)).tobytes())
        self.assertIn(samples.T.tobytes(), self.rendered(self.folder / "made.json", 1.0)[0])

    def test_a_played_world_is_felt_again_as_the_command_line_does(self) -> None:
        played, world = self.folder / "played.json", json.loads(scene.read_text())
        del world["physvib_scene"]
        played.write_text(json.dumps({"physvib_session": 1, "seconds": 1.5, "steps_per_second": 100, "timing": "onset", "location": "contact", "limiter": True, "channels": 2,
                                      "panning": {"layout": {"name": "two", "extent_m": [0.1, 0.1], "enchanters": [
                                          {"label": name, "x_m": x, "y_m": 0, "actuator": "none", "full_scale_g": 1} for name, x in (("A", 0), ("B", 0.1))]},
                                          "law": "linear", "exponent": 1, "field_m": [4, 2]},
                                      "takes": [{"start_s": 0.25, "world_end_s": 1.25, "seed": 3, "scene": world}],
                                      "controls": [{"time_s": 0.7, "control": "gain", "channel": 1, "value": 0.5}]}))
        session = physvib.Session.load(played)
        self.assertEqual((session.seconds, session.channels), (1.5, 2))
        sound, events = self.rendered(played, 2.0)
        self.assertGreater(len(events), 0)
        self.assertEqual(session.events(2.0).tobytes(), events.tobytes())
        self.assertIn(session.render(2.0).T.tobytes(), sound)
        session.save(self.folder / "again.json")  # and is as good as it was
        self.assertEqual(physvib.Session.load(self.folder / "again.json").events(2.0).tobytes(), events.tobytes())

    def test_what_is_struck_live_is_a_session(self) -> None:
        with physvib.Live(NOWHERE, field_m=(2.0, 1.0), save=self.folder / "live.json") as live:
            now = hits(50)
            now["time_ns"] += live.now_ns + 50_000_000
            live.strike(now)
            while live.status.played < len(now):
                pass
        session = physvib.Session.load(self.folder / "live.json")
        self.assertEqual(session.events()["time_ns"].tolist(), now["time_ns"].tolist())
        self.assertEqual(session.render().tobytes(), physvib.render(now, session.seconds, field_m=(2.0, 1.0)).tobytes())

    def test_an_impact_is_one_call(self) -> None:
        with physvib.Live(NOWHERE, field_m=(2.0, 1.0), save=self.folder / "live.json") as live:
            before = live.now_ns
            live.impact(0.5, 0.25, 0.8)
            live.impact(1.5, 0.75, 0.4, material="wooden board")
            after = live.now_ns
            for wrong, line in ((lambda: live.impact(0.0, 0.0, 1.5), "strength"), (lambda: live.impact(0.0, 0.0, 1.0, material="jam"), 'found "jam"')):
                with self.assertRaisesRegex(physvib.PhysVibError, line):
                    wrong()
            while live.status.played < 2:
                pass
            self.assertEqual(live.status.late, 0)
        events = physvib.Session.load(self.folder / "live.json").events()
        self.assertEqual([(e["frequency_hz"], e["amplitude"], e["x_m"], e["y_m"], e["sound"]) for e in events],
                         [(200.0, 0.8, 0.5, 0.25, 0), (349.0, 0.4, 1.5, 0.75, physvib.sound("wooden board"))])
        self.assertTrue(all(before <= e["time_ns"] <= after for e in events))

    def test_a_world_goes_with_time_and_a_stall_is_told(self) -> None:
        with physvib.Live(NOWHERE, longest_gap_s=0.5) as live:
            world, start = physvib.World(), 0
            with world.step(10.0):
                pass
            start = live.follow(world, start)  # ten seconds ahead
            self.assertLess(start, -9_000_000_000)
            self.assertEqual(live.follow(world, start), start)
            while live.now_ns < start + 10_000_000_000 + 600_000_000:
                pass
            self.assertGreater(live.follow(world, start), start)  # it stood still for longer than the gap

    def test_silence_of_a_device_is_explained(self) -> None:
        world, hit = physvib.World(), dict(x_m=0.5, y_m=0.5, normal_y=-1.0, approach_m_per_s=3.0)
        world.set_body(0)
        world.set_body(1, mass_kg=2.0, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
        with physvib.Live(NOWHERE, field_m=(1.0, 1.0)) as live:

            def explained() -> str:
                with world.step(0.01):
                    pass
                with world.step(0.01):
                    world.touch(1, 0, **hit)
                return live.explain(world)

            while not live.status.is_running:
                time.sleep(0.02)
            self.assertIn("1 event was made", explained())
            live.silence()
            self.assertIn("Silence is held by Live.silence", explained())
            live.silence(False)
            for j in range(4):
                live.set_mute(j, True)
            self.assertIn("channels that play these places are muted", explained())
            for j in range(4):
                live.set_mute(j, False)
            live.set_level(-80.0)
            self.assertIn("level of the output is -80 dB", explained())
            live.set_level(-12.0)
            live.set_layout("phone4")
            self.assertIn("which is not set and so the layout's", explained())

    def test_refusals_say_what_was_expected(self) -> None:
        (self.folder / "bad.json").write_text('{"physvib_session": 1}')
        for wrong, line in ((lambda: physvib.Session.load("/nowhere.json"), "/nowhere.json"), (lambda: physvib.Session.load(self.folder / "bad.json"), "bad.json"),
                            (lambda: physvib.Session(hits(2)[::-1], 1.0), "order of their times"), (lambda: physvib.Session(hits(2), float("nan")), "86400"),
                            (lambda: physvib.Live("BOARD:/nowhere"), "/nowhere"), (lambda: physvib.Live(NOWHERE, save="/nowhere/run.json"), "/nowhere"),
                            (lambda: physvib.Live(NOWHERE, save="x" * 2000), "1023"), (lambda: physvib.Live("BOARD:auto", channels=5), "four")):
            with self.assertRaises(physvib.PhysVibError) as caught:
                wrong()
            self.assertIn(line, str(caught.exception))
        closed = physvib.Session(hits(1), 1.0)
        closed.close()
        with self.assertRaises(physvib.PhysVibError):
            closed.render()


unittest.main(argv=sys.argv[:1])
