# SPDX-License-Identifier: MIT
"""pymunk (6 and 7): what touches in a space is felt. pymunk itself is not imported."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .renderer import Renderer
from .world import POINT_BY_PLACE, World


class SpaceHaptics:
    """Of `attach`. Shapes have numbers, in the order in which they were first met, that stand in events."""

    def __init__(self, space: Any, metres_per_unit: float, y_down_from_m: float | None, **settings: Any) -> None:
        self.space, self.world, self.metres = space, World(**settings), metres_per_unit
        self._top, self._turn = (0.0, 1.0) if y_down_from_m is None else (y_down_from_m, -1.0)
        self._ids: dict[Any, int] = {}
        self._values: dict[Any, dict[str, Any]] = {}
        self._met: dict[Any, Any] = {}  # velocities before the solver
        self._last = -1
        self._error: Exception | None = None
        if hasattr(space, "on_collision"):  # pymunk 7
            space.on_collision(None, None, pre_solve=lambda arbiter, *_: self._guard(self.look, arbiter), post_solve=lambda arbiter, *_: self._guard(self.push, arbiter))
        else:
            handler = space.add_default_collision_handler()
            handler.pre_solve = lambda arbiter, *_: self._guard(self.look, arbiter)
            handler.post_solve = lambda arbiter, *_: self._guard(self.push, arbiter)

    def __repr__(self) -> str:
        return f"<physvib.SpaceHaptics of {len(self._ids)} shapes, {self.world!r}>"

    def set(self, shape: Any, **values: Any) -> int:
        """Values of a shape, at first or again (is_camera, frequency_hz, decay_per_s...: see World.set_body); masses are the space's. Its number."""
        before, known = self._values.get(shape), shape in self._ids
        self._values[shape] = values
        if not known:
            self._ids[shape], self._last = self._last + 1, self._last + 1
        try:
            self._tell(shape)
        except Exception:
            if before is not None:
                self._values[shape] = before
            else:
                del self._values[shape]
            if not known:
                del self._ids[shape]
            raise
        return self._ids[shape]

    def id(self, shape: Any) -> int:
        """The number of a shape in events."""
        if shape not in self._ids:
            self.set(shape)
        return self._ids[shape]

    def step(self, seconds: float) -> None:
        """Instead of space.step."""
        self._sweep()
        self._met.clear()
        with self.world.step(seconds, self.metres * math.hypot(*self.space.gravity)):
            self.space.step(seconds)
        if self._error is not None:
            error, self._error = self._error, None
            raise error

    def take(self, at_once: bool = False) -> NDArray[np.void]:
        """See World.take."""
        return self.world.take(at_once)

    def explain(self, renderer: Renderer | None = None, **output: float | str) -> str:
        """See World.explain. It looks at all shapes of the space."""
        for shape, number in self._ids.items():
            if self._values[shape].get("is_camera") and (note := self._note(shape)):
                self.world.note(number, note)
        return self.world.explain(renderer, **output)

    def _note(self, shape: Any) -> str | None:
        if shape.sensor:
            return "sensor"
        own, others = shape.filter, [other.filter for other in self.space.shapes if other.body is not shape.body]
        if others and all(own.group == other.group != 0 or not own.categories & other.mask or not other.categories & own.mask for other in others):
            return "filtered"
        return "asleep" if shape.body.is_sleeping else None

    def look(self, arbiter: Any) -> None:
        """Before the solver. If you have callbacks for a pair of collision types in pymunk 6, call this and `push` from yours."""
        for shape in arbiter.shapes:
            body, number = shape.body, self.id(shape)
            self.world.set_mass(number, self._values[shape].get("mass_kg", self._mass(body)))
            at, v = body.local_to_world(body.center_of_gravity), body.velocity
            self._met[body] = v
            self.world.move(number, *self._place(at), v[0] * self.metres, self._turn * v[1] * self.metres, self._turn * body.angular_velocity)

    def push(self, arbiter: Any) -> None:
        """Behind the solver."""
        a, b = arbiter.shapes
        points = arbiter.contact_point_set
        nx, ny = points.normal
        pushed = arbiter.total_impulse
        impulse = self.metres * abs(pushed[0] * nx + pushed[1] * ny)
        if arbiter.is_first_contact:  # what gravity adds in this step is a load, and no part of an impact
            impulse -= self._load(a.body, b.body, nx, ny)
            # a pair that meets again within three steps has the impulse of before, too, which moved nobody
            impulse = min(impulse, max(self._gained(body, nx, ny) for body in (a.body, b.body)))
        for point in points.points:
            self.world.touch(self.id(a), self.id(b), *self._place(point.point_a), normal_x=nx, normal_y=self._turn * ny, impulse_n_s=impulse,
                             is_impulse_of_pair=1, restitution=min(1.0, max(0.0, arbiter.restitution)), gap_m=point.distance * self.metres,
                             gap_fraction=1.0, point_id=POINT_BY_PLACE)  # pymunk moves first, then looks; it tells no other impulse

    def _place(self, at: Any) -> tuple[float, float]:
        return at[0] * self.metres, self._top + self._turn * at[1] * self.metres

    def _load(self, a: Any, b: Any, nx: float, ny: float) -> float:
        gravity = self.space.gravity
        pull = self.metres * (gravity[0] * nx + gravity[1] * ny) * self.space.current_time_step
        falls_a, falls_b = (body.body_type == body.DYNAMIC for body in (a, b))
        if falls_a == falls_b:
            return 0.0
        return max(0.0, pull * a.mass if falls_a else -pull * b.mass)

    def _gained(self, body: Any, nx: float, ny: float) -> float:
        before, now = self._met.get(body, body.velocity), body.velocity
        return self.metres * self._mass(body) * abs((now[0] - before[0]) * nx + (now[1] - before[1]) * ny)

    @staticmethod
    def _mass(body: Any) -> float:
        return body.mass if body.body_type == body.DYNAMIC else 0.0

    def _guard(self, call: Any, arbiter: Any) -> bool:
        """pymunk prints what its callbacks raise, and goes on: step raises it."""
        try:
            call(arbiter)
        except Exception as error:
            self._error = self._error or error
        return True

    def _tell(self, shape: Any) -> None:
        body, values = shape.body, dict(self._values[shape])
        mass = self._mass(body)
        values.setdefault("mass_kg", mass)
        values.setdefault("inertia_kg_m2", body.moment * self.metres ** 2 if mass > 0 and math.isfinite(body.moment) else 0.0)
        self.world.set_body(self._ids[shape], **values)

    def _sweep(self) -> None:
        gone = [shape for shape in self._ids if shape.space is None]
        for shape in gone:
            self.world.remove_body(self._ids.pop(shape))
            del self._values[shape]


def attach(space: Any, *, metres_per_unit: float = 1.0, y_down_from_m: float | None = None, **settings: Any) -> SpaceHaptics:
    """A pymunk.Space whose contacts are felt: `set(shape, is_camera=True, frequency_hz=200, decay_per_s=30)`, then `step(seconds)` instead of
    space.step, and `take()`. `metres_per_unit`: 0.01 if a metre is 100 of the space's units. `y_down_from_m`: the field's height (m) if y points down, as in pygame. `settings`: see World. It takes the space's callback of
    collisions between any types."""
    return SpaceHaptics(space, metres_per_unit, y_down_from_m, **settings)
