# SPDX-License-Identifier: MIT
"""The Python package, against the command line and by hand: python.py LIBRARY PHYSVIB, PYTHONPATH set to the package."""
import inspect
import os
import re
import resource
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

os.environ["PHYSVIB_LIBRARY"] = sys.argv[1]
import numpy as np  # noqa: E402

import physvib  # noqa: E402
from physvib.layout import LAWS  # noqa: E402

program = sys.argv[2]


def many(count: int) -> np.ndarray:
    random = np.random.default_rng(1)
    return physvib.events(random.uniform(0.0, 9.0, count), frequency_hz=random.choice([80.0, 150.0, 220.0, 333.3], count), decay_per_s=random.uniform(20, 80, count),
                          amplitude=random.uniform(0.0, 0.01, count), x_m=random.uniform(0.0, 0.1, count), y_m=random.uniform(0.0, 0.06, count))


class Package(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_hundred_thousand_events_are_the_command_lines_bytes(self) -> None:
        events = many(100_000)
        physvib.save_events(self.folder / "events.csv", events)
        subprocess.run([program, "render", "--from-events", self.folder / "events.csv", "--out", self.folder / "out.wav", "--seconds", "10"], check=True,
                       capture_output=True)
        frames = (self.folder / "out.wav").read_bytes()
        samples = physvib.render(physvib.load_events(self.folder / "events.csv"), 10.0)
        self.assertEqual(samples.shape, (4, 480000))
        self.assertTrue(frames.find(samples.T.tobytes()) > 0)

    def test_lists_come_back_to_the_bit(self) -> None:
        events = many(1000)
        for kinds in (physvib.HIT, np.arange(1000) % 3):  # bodies that meet, and grains
            events["kind"] = kinds
            physvib.save_events(self.folder / "events.csv", events)
            self.assertEqual(physvib.load_events(self.folder / "events.csv").tobytes(), events.tobytes())

    def saved(self, events: np.ndarray, **how: object) -> Path:
        physvib.save_events(self.folder / "events.csv", events, **how)
        return self.folder / "events.csv"

    def test_a_list_knows_its_field_and_render_takes_it(self) -> None:
        events = many(100)
        events["x_m"] *= 50.0
        loaded = physvib.load_events(self.saved(events, field_m=(6.0, 0.06)))
        self.assertEqual((loaded.field_m, loaded[5:].field_m, loaded[loaded["amplitude"] > 0].copy().field_m), ((6.0, 0.06),) * 3)
        self.assertEqual(physvib.parse_events(self.folder.joinpath("events.csv").read_text()).field_m, (6.0, 0.06))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            samples = physvib.render(loaded, 10.0)
        np.testing.assert_array_equal(samples, physvib.render(events, 10.0, field_m=(6.0, 0.06)))
        subprocess.run([program, "render", "--from-events", self.folder / "events.csv", "--out", self.folder / "out.wav", "--seconds", "10"], check=True,
                       capture_output=True)
        self.assertTrue((self.folder / "out.wav").read_bytes().find(samples.T.tobytes()) > 0)
        self.assertEqual(physvib.load_events(self.saved(loaded[:50])).field_m, (6.0, 0.06))
        self.assertIsNone(physvib.load_events(self.saved(events)).field_m)
        with self.assertWarnsRegex(UserWarning, r"^\d+ of 100 hits lie outside the field of 0.12 x 0.06 m"):
            physvib.render(events, 0.1)
        with self.assertRaisesRegex(physvib.PhysVibError, "^field: expected 0.001 to 1e6 m"):
            self.saved(events, field_m=(-1.0, 1.0))

    def test_tables_of_pandas_come_back_to_the_bit(self) -> None:
        import pandas

        events = many(100)
        events["kind"], events["fixture"], events["impulse_n_s"] = np.arange(100) % 3, np.arange(100), 0.5
        self.assertEqual(physvib.events_of(physvib.frame(events)).tobytes(), events.tobytes())
        bound = physvib.events([0.0, 0.01], frequency_hz=200.0, decay_per_s=30.0, z_m=[0.0, 0.02], part=["thumb", ""])
        self.assertEqual(physvib.events_of(physvib.frame(bound)).tobytes(), bound.tobytes())
        physvib.save_events(self.folder / "bound.csv", bound)
        self.assertEqual(physvib.events_of(pandas.read_csv(self.folder / "bound.csv", comment="#")).tobytes(), bound.tobytes())
        physvib.save_events(self.folder / "events.csv", physvib.frame(events))
        table = pandas.read_csv(self.folder / "events.csv", comment="#", float_precision="round_trip")
        self.assertEqual(physvib.events_of(table).tobytes(), events.tobytes())
        self.assertEqual(physvib.events_of(physvib.frame(physvib.load_events(self.folder / "events.csv"))).tobytes(), events.tobytes())
        quick = pandas.read_csv(self.folder / "events.csv", comment="#")  # pandas rounds
        np.testing.assert_allclose(quick["x_m"], events["x_m"], rtol=1e-12)
        table = physvib.frame(physvib.load_events(self.saved(events, field_m=(0.2, 0.1))))
        self.assertEqual(table.attrs["field_m"], (0.2, 0.1))
        np.testing.assert_array_equal(physvib.render(table, 0.1), physvib.render(events, 0.1, field_m=(0.2, 0.1)))
        with self.assertRaisesRegex(physvib.PhysVibError, "x_m: expected this column"):
            physvib.render(physvib.frame(events).drop(columns="x_m"), 0.1)

    def test_layouts_come_back(self) -> None:
        layout = physvib.Layout([(0.0, 0.0), (0.1, 0.05)], (0.1, 0.05))
        layout.save(self.folder / "mine.json", "mine")
        self.assertEqual(physvib.Layout.load(self.folder / "mine.json"), layout)
        self.assertEqual(layout.parts, [0, 0])
        glove = physvib.Layout([(0.0, 0.0, -0.03), (0.1, 0.05)], (0.1, 0.05), ["thumb", "left elbow"])
        glove.save(self.folder / "glove.json", "glove")
        self.assertEqual(physvib.Layout.load(self.folder / "glove.json"), glove)
        self.assertEqual((glove.places_m[1], glove.parts[1]), ((0.1, 0.05, 0.0), physvib.part("left elbow")))
        bound = physvib.events([0.0, 0.01], frequency_hz=200.0, decay_per_s=30.0, z_m=[0.0, 0.02], part=["thumb", ""])
        self.assertEqual(bound["part"].tolist(), [physvib.part("thumb"), 0])
        self.assertTrue((physvib.render(bound[:1], 0.01, layout=glove)[1] == 0.0).all())
        self.assertEqual(physvib.render(many(10), 0.1, layout=str(self.folder / "mine.json")).shape, (2, 4800))

    def test_a_strike_is_on_its_frame_however_blocks_fall(self) -> None:
        event = physvib.events(0.0123, frequency_hz=1000.0, decay_per_s=10.0, amplitude=0.5)
        whole = physvib.render(event, 0.1, limiter=False)
        with physvib.Renderer(limiter=False) as renderer:
            renderer.strike(event)
            parts = [renderer.pull(n) for n in (1, 63, 511, 4000, 225 + renderer.latency_frames)]
            late = renderer.latency_frames
            self.assertEqual(renderer.status.played, 1)
        pulled = np.concatenate(parts, axis=1)[:, late:]
        np.testing.assert_array_equal(pulled, whole[:, :pulled.shape[1]])
        first = int(np.argmax(np.abs(pulled).max(axis=0) > 0))
        self.assertEqual(first, int(np.ceil(0.0123 * 48000)))

    def test_a_landing_is_felt(self) -> None:
        with physvib.World(normalisation_s_per_m=1.0, hand_mass_kg=0.0) as world, physvib.Renderer() as renderer:
            world.set_body(0)
            world.set_body(1, mass_kg=2.0, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
            with world.step(0.01):
                world.touch(0, 1, x_m=0.02, impulse_n_s=1.0)
            events = world.take(at_once=True)
            self.assertEqual(len(events), 1)
            self.assertEqual((events["amplitude"][0], events["fixture"][0], events["other"][0]), (0.5, 1, 0))
            with world.step(0.01):
                pass
            with world.step(0.01):
                world.touch(0, 1, impulse_n_s=1.0)
            self.assertEqual(world.send(renderer, physvib.play_out_s(), at_once=True), 1)
            self.assertGreater(np.abs(renderer.pull(9600)).max(), 0.1)

    def test_materials_and_impacts_have_names(self) -> None:
        self.assertIn("wooden board", physvib.materials())
        with physvib.World(full_scale_impulse_n_s=physvib.AUTOMATIC, settling_s=0.015) as world:
            world.set_body(0)
            world.set_body(1, mass_kg=0.2, is_camera=True, **physvib.material("steel plate"))
            for step in range(10):
                with world.step(0.01):
                    if step in (0, 5):
                        world.touch(0, 1, impulse_n_s=7.0)
            events = world.take(at_once=True)
        self.assertEqual([(event["frequency_hz"], round(event["amplitude"], 9)) for event in events], [(430.0, 0.5)])
        hit = physvib.impact(0.1, 0.2, 0.3, material="wooden board")
        self.assertEqual((hit["frequency_hz"][0], hit["amplitude"][0], hit["sound"][0]), (349.0, 0.3, physvib.sound("wooden board")))
        with physvib.Renderer(layout="phone1", limiter=False) as renderer:
            renderer.pull(1000)
            renderer.impact(0.0, 0.0, 0.5)
            renderer.impact(0.0, 0.0, 0.1, material="steel plate")
            self.assertAlmostEqual(np.abs(renderer.pull(4800)).max(), 0.55, delta=0.05)
            self.assertEqual((renderer.status.played, renderer.status.late), (2, 0))
            for wrong, words in ((lambda: renderer.impact(0.0, 0.0, 2.0), "strength: expected 0 to 1"), (lambda: renderer.impact(0.0, 0.0, 1.0, material="jam"), 'found "jam"'),
                                 (lambda: physvib.material("jam"), 'found "jam"'), (lambda: physvib.material("ice", self.folder / "none.json"), "none.json"),
                                 (lambda: physvib.World(full_scale_impulse_n_s=-3.0), "-1 (automatic)")):
                with self.assertRaisesRegex(physvib.PhysVibError, re.escape(words)):
                    wrong()

    def test_laws_are_those_of_the_program(self) -> None:
        shown = subprocess.run([program, "render", "--help"], capture_output=True, text=True, check=True).stdout
        self.assertIn("panning law: " + ", ".join(LAWS), " ".join(shown.split()))

    def test_sounds_are_scaled_by_their_type_or_refused(self) -> None:
        def saved(samples: object) -> np.ndarray:
            physvib.save_wav(self.folder / "s.wav", samples)
            content = (self.folder / "s.wav").read_bytes()
            return np.frombuffer(content[content.index(b"data") + 8:], "<f4")

        quiet = np.array([0.0, 0.01, -0.01, -1.0])
        for kind, half in (("i1", 128), ("<i2", 32768), (">i2", 32768), ("i4", 2**31)):
            whole = np.rint(quiet * half).astype(kind)
            self.assertEqual(saved(whole).tolist(), (whole.astype(float) / half).astype("f4").tolist(), kind)
        self.assertEqual(saved(np.array([128, 0, 255, 192], "u1")).tolist(), [0.0, -1.0, 127 / 128, 0.5])
        self.assertEqual(saved(np.array([1 << 15, 0], "u2")).tolist(), [0.0, -1.0])
        for kind in ("f2", "f4", "f8", ">f8"):
            self.assertEqual(saved(np.array([[0.5, -2.0]], kind)).tolist(), [0.5, -2.0], kind)
        self.assertEqual(saved(np.ma.array([0.5, 0.25], mask=[0, 0])).tolist(), [0.5, 0.25])
        (self.folder / "s.wav").unlink()
        for bad, words in ((np.zeros(4, bool), "found bool"), (np.zeros(4, complex), "found complex128"), (np.array([0.5, None]), "found object"), (["a"], "found <U1"),
                           ([0, 1], "floats, or integers of 8, 16 or 32 bits, found int64"), (np.zeros((1, 2, 3)), "shape"), (np.ma.array([0.0, 1.0], mask=[0, 1]), "masked"),
                           ([0.0, np.nan], "expected finite samples, found NaN or infinity in frame 1 of channel 0"), ([[0.0, 0.0], [np.inf, 0.0]], "in frame 0 of channel 1"), ([1e300], "finite")):
            with self.assertRaisesRegex(physvib.PhysVibError, words):
                physvib.save_wav(self.folder / "s.wav", bad)
        self.assertFalse((self.folder / "s.wav").exists())

    def test_events_are_not_masked_and_of_one_dimension(self) -> None:
        with self.assertRaisesRegex(physvib.PhysVibError, "masked"):
            physvib.events(np.ma.array([0.0, 0.05], mask=[0, 1]), frequency_hz=200.0, decay_per_s=30.0)
        with self.assertRaisesRegex(physvib.PhysVibError, "masked"):
            physvib.events([0.0, 0.05], frequency_hz=200.0, decay_per_s=30.0, amplitude=np.ma.array([1.0, 0.5], mask=[1, 0]))
        self.assertEqual(len(physvib.events(np.ma.array([0.0, 0.05]), frequency_hz=200.0, decay_per_s=30.0)), 2)
        with self.assertRaisesRegex(physvib.PhysVibError, r"shape \(2, 2\)"):
            physvib.events(np.zeros((2, 2)), frequency_hz=200.0, decay_per_s=30.0)

    def test_refusals_say_what_was_expected(self) -> None:
        for wrong, line in ((lambda: physvib.Layout.preset("phone9"), "expected phone1 to phone"), (lambda: physvib.Renderer(rate_hz=1), "5000 to 192000"),
                            (lambda: physvib.render(many(2)[::-1], 1.0), "order of their times"), (lambda: physvib.render(np.zeros(3), 1.0), "physvib.EVENT"),
                            (lambda: physvib.load_events("/nowhere.csv"), "/nowhere.csv"),
                            (lambda: physvib.events(np.nan, frequency_hz=1.0, decay_per_s=1.0), "10^8 s")):
            with self.assertRaises(physvib.PhysVibError) as caught:
                wrong()
            self.assertIn(line, str(caught.exception))
        closed = physvib.World()
        closed.close()
        closed.close()
        with self.assertRaises(physvib.PhysVibError):
            closed.take()

    def test_without_the_library_of_devices_it_says_so_in_a_line(self) -> None:
        os.environ["PHYSVIB_LIVE_LIBRARY"] = "/nowhere/libphysvib-live.so.1"
        self.addCleanup(os.environ.pop, "PHYSVIB_LIVE_LIBRARY")
        with self.assertRaisesRegex(physvib.PhysVibError, r"^expected /nowhere/.*, the library with devices.*\Z"):
            physvib.Live()

    def test_why_nothing_is_felt_is_counted_and_said(self) -> None:
        world = physvib.World(normalisation_s_per_m=1.0, hand_mass_kg=0.0)
        world.set_body(0)
        self.assertIn("No step", world.explain())
        with self.assertRaises(physvib.PhysVibError) as caught:
            world.set_body(1, mass_kg=1.0, is_camera=True, frequency_hz=200.0)
        self.assertTrue(str(caught.exception).startswith("decay:"))
        world.set_body(1, mass_kg=1.0, is_camera=True, frequency_hz=200.0, decay_per_s=30.0, overtones=[(410.0, 60.0, 0.5)])
        for muted in (False, True):
            world.configure(is_muted=muted)
            with world.step(0.01):
                world.touch(0, 1, impulse_n_s=2.0)
            with world.step(0.01):
                pass
        events = world.take(at_once=True)
        self.assertEqual(list(events["frequency_hz"]), [200.0, 410.0])
        self.assertEqual(list(events["amplitude"]), [2.0, 1.0])
        self.assertEqual((world.counts.contacts, world.counts.events, world.counts.muted, world.drops), (2, 2, 1, 0))
        self.assertIn("2 contacts, 2 events", repr(world))

    def test_a_flat_landing_at_two_corners_is_the_landing(self) -> None:
        world = physvib.World(normalisation_s_per_m=1.0, hand_mass_kg=0.0)
        world.set_body(0)
        world.set_body(1, mass_kg=0.5, inertia_kg_m2=0.05, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
        world.move(1, 0.0, 0.25, vy_m_per_s=-2.426)
        with world.step(0.01):
            for x in (-0.5, 0.5):
                world.touch(0, 1, x_m=x, point_id=physvib.POINT_BY_PLACE, is_soft=True)
        self.assertAlmostEqual(float(world.take(at_once=True)["impulse_n_s"][0]), 1.213, delta=0.01)

    def test_an_impact_in_space_follows_from_the_inverse_inertia(self) -> None:
        world = physvib.World(normalisation_s_per_m=1.0, hand_mass_kg=0.0)
        world.set_body(0)
        world.set_body(1, mass_kg=2.0, is_camera=True, frequency_hz=200.0, decay_per_s=30.0, part=7)
        world.move_in_space(1, (0.0, 0.0, 0.0), (0.0, -1.8, -2.4), inverse_inertia_per_kg_m2=(4.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        with world.step(0.01):
            world.touch(0, 1, y_m=-0.8, z_m=0.6, normal_y=0.6, normal_z=0.8)
        self.assertAlmostEqual(float(world.take(at_once=True)["impulse_n_s"][0]), 3.0 / 4.5, places=5)
        with self.assertRaisesRegex(physvib.PhysVibError, "centre_m: expected 3 numbers"):
            world.move_in_space(1, (0.0, 0.0))
        with world.step(0.01):
            world.moved_in_space(1, (0.0, 1.0, 0.0))

    def test_layouts_and_lists_are_read_from_text(self) -> None:
        layout = physvib.Layout.parse('{"name": "one", "extent_m": [0.2, 0.1], "enchanters": [{"label": "A", "x_m": 0.1, "y_m": 0}]}')
        self.assertEqual(repr(layout), "Layout([(0.1, 0.0)], extent_m=(0.2, 0.1))")
        events = physvib.parse_events("time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.5,200,30,0.5,0,0\n")
        self.assertEqual(list(events["time_ns"]), [500_000_000])

    def test_motors_get_the_commands_of_the_program(self) -> None:
        random = np.random.default_rng(2)
        events = physvib.events(np.cumsum(random.uniform(0.0, 0.08, 1000)) + 1.0, frequency_hz=random.uniform(20.0, 500.0, 1000), decay_per_s=random.uniform(5.0, 100.0, 1000),
                                amplitude=random.uniform(0.0, 1.0, 1000), x_m=random.uniform(0.0, 1.0, 1000))
        self.saved(events, field_m=(1.0, 1.0))
        seconds = int(events["time_ns"][-1] * 1e-9) + 2
        subprocess.run([program, "render", "--from-events", self.folder / "events.csv", "--pad", "pad-xbox", "--out", self.folder / "motors.csv", "--seconds", str(seconds)],
                       check=True, capture_output=True)
        lines = (self.folder / "motors.csv").read_text().splitlines()
        written = [(float(time_s), (float(low), float(high))) for time_s, low, high in (line.split(",") for line in lines if line[0].isdigit())]
        self.assertGreater(len(written), 1000)
        with physvib.Pads(2, field_m=(1.0, 1.0), profile="pad-xbox") as pads:
            pulled, last, told, frame_ns = [], (0.0, 0.0), 0, 4_000_000  # at most one command a frame
            for now_ns in range(0, seconds * 1_000_000_000, frame_ns):
                while told < 1000 and events["time_ns"][told] < now_ns + 100_000_000:
                    pads.strike(1, events[told:told + 1])
                    told += 1
                still, motors = pads.pull(now_ns)
                self.assertEqual(still, (0.0, 0.0))
                if motors != last:
                    pulled.append((now_ns * 1e-9, motors))
                    last = motors
            self.assertEqual([(0.0, 0.0)] + [motors for _, motors in pulled], [motors for _, motors in written])
            self.assertLess(max(abs(a[0] - b[0]) for a, b in zip(pulled, written[1:])), frame_ns * 1e-9)
            self.assertRaisesRegex(physvib.PhysVibError, "time: expected none before", pads.pull, 0)
            pads.stop()
            self.assertEqual(pads.pull(0), [(0.0, 0.0)] * 2)
            pads.set_level(0.5)
            self.assertEqual(pads.send(0, physvib.World()), 0)
        self.assertRaisesRegex(physvib.PhysVibError, "pad-dualshock", physvib.Pads, profile="none")

    def test_every_public_name_is_described_and_has_types(self) -> None:
        functions = {name: getattr(physvib, name) for name in physvib.__all__ if callable(getattr(physvib, name))}
        for owner, what in list(functions.items()):
            for name, member in vars(what).items() if inspect.isclass(what) else ():
                function = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
                if inspect.isfunction(function) and (name == "__init__" or not name.startswith("_")):
                    functions[f"{owner}.{name}"] = function
        for name, function in functions.items():
            self.assertTrue(function.__doc__ or name.endswith(".__init__"), f"{name}: expected a docstring")
            if inspect.isfunction(function):
                untyped = [p.name for p in inspect.signature(function).parameters.values() if p.annotation is p.empty and p.name not in ("self", "cls")]
                self.assertEqual(untyped, [], f"{name}: expected types")
                self.assertIn("return", function.__annotations__, f"{name}: expected a type of what it returns")

    def test_no_call_leaves_memory_behind(self) -> None:
        calls = int(os.environ.get("PHYSVIB_CALLS", "8000"))  # a million by hand
        world, event = physvib.World(), physvib.events(0.0, frequency_hz=200.0, decay_per_s=30.0)
        world.set_body(0)
        world.set_body(1, mass_kg=1.0, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)

        def kilobytes() -> int:
            return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() // 1024

        def some(count: int) -> None:
            for _ in range(8):
                physvib.Renderer().close()  # megabytes each, of which the allocator keeps some for the next
            for i in range(count // 4):
                with world.step(0.01):
                    if i % 2 == 0:
                        world.touch(0, 1, impulse_n_s=1.0)
                world.take()

        with physvib.Renderer() as renderer:
            out = np.empty((4, 16), dtype=np.float32)
            some(2000)
            before = kilobytes()
            some(calls)
            for _ in range(calls // 100):
                renderer.strike(event)
                renderer.pull(16, out)
            self.assertLess(kilobytes() - before, 40_000)  # one renderer may lie elsewhere


unittest.main(argv=sys.argv[:1])
