# SPDX-License-Identifier: MIT
"""Worlds from which nothing is felt, each for one reason: the explanation names it, in Python's words. silent_worlds.py"""
import unittest
from types import SimpleNamespace

import physvib


class Thing(SimpleNamespace):
    """Of an engine: what has its fields, and is itself alone."""
    __eq__, __hash__ = object.__eq__, object.__hash__


class Silent:
    """A floor (0) and a ball (1) that is a haptic source; nothing is wrong with them."""

    def __init__(self, **settings):
        self.world = physvib.World(**settings)
        self.world.set_body(0)
        self.body = {"mass_kg": 2.0, "is_camera": True, "frequency_hz": 200.0, "decay_per_s": 30.0}
        self.contact = {"a": 1, "b": 0, "x_m": 0.5, "y_m": 0.5, "normal_y": -1.0, "approach_m_per_s": 3.0}
        self.renderer = None

    def hit(self, seconds=0.01, gravity=9.81, **changed):
        self.world.set_body(1, **self.body)
        with self.world.step(seconds, gravity):
            pass
        with self.world.step(seconds, gravity):
            contact = {**self.contact, **changed}
            self.world.touch(*[contact.pop(name) for name in "ab"], **{name: value for name, value in contact.items() if value is not None})
        return self

    def play(self, prepare=lambda renderer: None, **settings):
        self.renderer = physvib.Renderer(**{"field_m": (1.0, 1.0), **settings})
        prepare(self.renderer)
        self.renderer.pull(64)
        self.hit()
        self.world.send(self.renderer, 0.0, at_once=True)
        self.renderer.pull(64)
        return self

    def explain(self):
        return self.world.explain(self.renderer)


def outside_a_step(silent):
    try:
        silent.world.touch(1, 0)
    except physvib.PhysVibError:
        return silent
    raise AssertionError("expected to be refused")


def unknown_body(silent):
    try:
        silent.hit(b=7)
    except physvib.PhysVibError:
        return silent
    raise AssertionError("expected to be refused")


def noted(note):
    silent = Silent()
    silent.world.set_body(1, **silent.body)
    with silent.world.step(0.01):
        pass
    silent.world.note(1, note)
    return silent


def of(body=None, settings=None, **contact):
    silent = Silent(**(settings or {}))
    silent.body.update(body or {})
    return silent.hit(**contact)


def stepped(seconds):
    silent = Silent()
    silent.world.set_body(1, **silent.body)
    with silent.world.step(seconds):
        pass
    return silent


REASONS = {
    "never stepped": (lambda: Silent(), "No step has been made: make one for each step of the engine (World.step)"),
    "outside a step": (lambda: outside_a_step(Silent()), "within a step (World.step)"),
    "step of 0 s": (lambda: stepped(0.0), "Steps were 0 s long"),
    "milliseconds": (lambda: stepped(16.7), "seconds, not milliseconds"),
    "no contact": (lambda: stepped(0.01), "World.touch"),
    "not told": (lambda: unknown_body(Silent()), "(7): call World.set_body"),
    "no source": (lambda: of({"is_camera": False}), "set is_camera"),
    "sensor": (lambda: noted("sensor"), "body 1 is a sensor"),
    "filtered": (lambda: noted("filtered"), "body 1 is filtered"),
    "disabled": (lambda: noted("disabled"), "body 1 is disabled"),
    "asleep": (lambda: noted("asleep"), "body 1 is asleep"),
    "both masses 0": (lambda: of({"mass_kg": 0.0, "static_mass_kg": 2.0}), "set mass_kg"),
    "normal reversed": (lambda: of(approach_m_per_s=-3.0), "part along the reported normal"),
    "no speed": (lambda: of(approach_m_per_s=None), "call World.move"),
    "below the threshold": (lambda: of(approach_m_per_s=0.08), "0.15 m/s (the strongest impact had 0.08 m/s)"),
    "pixels": (lambda: of(x_m=400.0, y_m=300.0), "metres_per_unit"),
    "field not set": (lambda: of(x_m=3.0), "set field_width_m"),
    "outside the field": (lambda: of(settings={"field_width_m": 2.0}, x_m=3.0), "outside the field of 2 m"),
    "outside the renderer's field": (lambda: Silent().play(field_m=(0.3, 0.3)), "outside the renderer's field"),
    "muted": (lambda: of(settings={"is_muted": True}), "is_muted"),
    "gain of 0": (lambda: of({"gain": 0.0}), "gain of 0"),
    "no sound": (lambda: of({"frequency_hz": 0.0, "decay_per_s": 0.0}), "frequency_hz and decay_per_s"),
    "level of 0": (lambda: Silent().play(lambda r: r.set_level(0.0)), "level of the output is 0"),
    "channels muted": (lambda: Silent().play(lambda r: [r.set_mute(j, True) for j in range(4)]), "channels that play these places are muted"),
    "silence held": (lambda: Silent().play(lambda r: r.silence(10_000_000_000)), "Silence is held by Renderer.silence"),
}


class SilentWorlds(unittest.TestCase):
    def test_each_is_explained(self) -> None:
        for name, (make, said) in REASONS.items():
            with self.subTest(name):
                self.assertIn(said, make().explain())

    def test_the_facts_of_any_output_are_used(self) -> None:
        silent = of()
        self.assertIn("No device plays the events (gone)", silent.world.explain(is_missing=1, trouble="gone"))
        self.assertIn("Nothing was stepped since the last explanation; before: Silence is held by OSC", silent.world.explain(is_silent=1, silent_by="OSC"))

    def test_a_space_is_looked_at(self) -> None:
        space = Thing(gravity=(0.0, -9.0), shapes=[], on_collision=lambda *_, **__: None, step=lambda seconds: None)
        every = Thing(group=0, categories=~0, mask=~0)

        def shape(**changed):
            body = Thing(DYNAMIC=0, body_type=0, mass=1.0, moment=1.0, is_sleeping=changed.pop("is_sleeping", False))
            space.shapes.append(Thing(**{"space": space, "body": body, "sensor": False, "filter": every, **changed}))
            return space.shapes[-1]

        def explained(**changed):
            space.shapes.clear()
            haptics = physvib.attach(space)
            shape()
            haptics.set(shape(), frequency_hz=200.0, decay_per_s=30.0)
            haptics.set(shape(**changed), is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
            haptics.step(0.01)
            return haptics.explain()

        self.assertIn("body 1 is a sensor", explained(sensor=True))
        self.assertIn("body 1 is filtered", explained(filter=Thing(group=0, categories=1, mask=0)))
        self.assertIn("body 1 is asleep", explained(is_sleeping=True))
        self.assertIn("No contact has begun in 1 step", explained())


if __name__ == "__main__":
    unittest.main()
