# SPDX-License-Identifier: MIT
"""pymunk through physvib.attach: a drop, a pole, a body that goes. pymunk_space.py LIBRARY; without pymunk it is skipped (exit code 77)."""
import math
import os
import sys
import unittest

os.environ["PHYSVIB_LIBRARY"] = sys.argv[1]
try:
    import pymunk
except ImportError:
    print("no pymunk here")
    sys.exit(77)
import physvib  # noqa: E402

G, UNITS = 9.81, 100.0  # a metre


class Space(unittest.TestCase):
    def room(self, rate: int) -> "tuple[pymunk.Space, physvib.SpaceHaptics]":
        space = pymunk.Space()
        space.gravity, space.iterations, space.collision_slop = (0, -G * UNITS), 30, 0.1
        haptics = physvib.attach(space, metres_per_unit=1 / UNITS, normalisation_s_per_m=1.0, hand_mass_kg=0.0)
        floor = pymunk.Segment(space.static_body, (-1000, 0), (1000, 0), 0)
        floor.friction, floor.elasticity = 1.0, 1.0
        space.add(floor)
        self.dt = 1 / rate
        return space, haptics

    def test_a_drop_is_felt_when_and_as_hard_as_it_lands(self) -> None:
        for rate in (60, 240, 1000):
            space, haptics = self.room(rate)
            ball = pymunk.Body(1.0, pymunk.moment_for_circle(1.0, 0, 10))
            ball.position, ball.velocity = (0, 90), (0, -0.5 * G * UNITS * self.dt)
            shape = pymunk.Circle(ball, 10)
            shape.elasticity = 0.5
            space.add(ball, shape)
            number = haptics.set(shape, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
            for _ in range(int(0.6 * rate)):
                haptics.step(self.dt)
            events = haptics.take(at_once=True)
            self.assertEqual((len(events), events["fixture"][0]), (1, number))
            self.assertAlmostEqual(events["time_ns"][0] * 1e-9, math.sqrt(2 * 0.8 / G), delta=1e-4)
            self.assertAlmostEqual(events["impulse_n_s"][0] / (1.5 * math.sqrt(2 * 0.8 * G)), 1.0, delta=0.02)
            self.assertAlmostEqual(events["x_m"][0], 0.0, delta=1e-3)

    def test_where_y_points_down_the_floor_is_below(self) -> None:
        space = pymunk.Space()
        space.gravity = (0, G * UNITS)
        haptics = physvib.attach(space, metres_per_unit=1 / UNITS, y_down_from_m=6.0)
        space.add(pymunk.Segment(space.static_body, (0, 590), (800, 590), 0))
        ball = pymunk.Body(1.0, pymunk.moment_for_circle(1.0, 0, 10))
        ball.position = (200, 500)
        shape = pymunk.Circle(ball, 10)
        space.add(ball, shape)
        haptics.set(shape, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
        for _ in range(60):
            haptics.step(1 / 60)
        event = haptics.take(at_once=True)[0]
        self.assertAlmostEqual(event["x_m"], 2.0, delta=0.01)
        self.assertAlmostEqual(event["y_m"], 0.1, delta=0.15)  # of 6 m

    def test_a_pole_is_felt_where_its_head_lands(self) -> None:
        space, haptics = self.room(240)
        body = pymunk.Body(3.0, pymunk.moment_for_box(3.0, (10, 200)))
        body.position, body.velocity, body.angular_velocity = (0, 100), (30, 0), -0.3
        shape = pymunk.Poly.create_box(body, (10, 200))
        shape.friction = 1.0
        space.add(body, shape)
        haptics.set(shape, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
        fastest = 0.0
        for _ in range(4 * 240):
            haptics.step(self.dt)
            fastest = max(fastest, abs(body.angular_velocity))
        events = haptics.take(at_once=True)
        head = events[events["x_m"] > 1.5]
        self.assertGreater(len(head), 0, haptics.explain())
        self.assertAlmostEqual(head["impulse_n_s"].max() / (3 / 3 * 2 * fastest), 1.0, delta=0.2)

    def test_what_goes_is_forgotten_and_what_is_wrong_is_raised(self) -> None:
        space, haptics = self.room(240)
        ball = pymunk.Body(1.0, 100.0)
        shape = pymunk.Circle(ball, 10)
        with self.assertRaisesRegex(physvib.PhysVibError, "decay"):
            haptics.set(shape, is_camera=True, frequency_hz=200.0)
        ball.position = (0, 9)
        space.add(ball, shape)
        haptics.set(shape, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
        haptics.step(self.dt)
        space.remove(ball, shape)
        haptics.step(self.dt)
        self.assertIn("1 shapes", repr(haptics))


unittest.main(argv=sys.argv[:1])
