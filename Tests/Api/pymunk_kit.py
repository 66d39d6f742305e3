# SPDX-License-Identifier: MIT
"""pymunk in the hands of the kit: lines in, answers out, as Tests/Engines/Kit.h has it for the engines of C. PHYSVIB_LIBRARY names the library."""
import math
import sys

import physvib
import pymunk

UNITS = 100.0  # a metre
TYPES = (pymunk.Body.STATIC, pymunk.Body.KINEMATIC, pymunk.Body.DYNAMIC)
SOURCE = {"is_camera": True, "frequency_hz": 200.0, "decay_per_s": 30.0}


class Kit:
    def __init__(self):
        self.bodies, self.ids = {}, {}

    def world(self, g, restitution, friction, _rate):
        self.space = pymunk.Space()
        self.space.gravity, self.space.iterations, self.space.collision_slop = (0, -g * UNITS), 30, 0.1
        self.haptics = physvib.attach(self.space, metres_per_unit=1 / UNITS, full_scale_impulse_n_s=1.0, hand_mass_kg=0.0)
        self.restitution, self.friction = restitution, friction

    def body(self, number, is_box, x, y, angle, width, height, kg, vx, vy, spin, kind, is_locked, is_sensor, _bullet):
        moves, size = kg > 0 and kind == 2, (width * UNITS, height * UNITS)
        moment = (pymunk.moment_for_box(kg, size) if is_box else pymunk.moment_for_circle(kg, 0, size[0] / 2)) if kg > 0 else 0
        body = pymunk.Body(kg, math.inf if is_locked else moment) if moves else pymunk.Body(body_type=TYPES[1 if kind == 1 else 0])
        body.made = (kg, moment)
        body.position, body.angle = (x * UNITS, y * UNITS), angle
        if body.body_type != pymunk.Body.STATIC:
            body.velocity, body.angular_velocity = (vx * UNITS, vy * UNITS), spin
        shape = pymunk.Poly.create_box(body, size) if is_box else pymunk.Circle(body, size[0] / 2)
        shape.elasticity, shape.friction, shape.sensor = self.restitution if moves else 1.0, math.sqrt(self.friction), bool(is_sensor)  # a pair's are products
        self.space.add(body, shape)
        self.bodies[number] = shape

    def feel(self, number):
        self.ids[self.haptics.set(self.bodies[number], **SOURCE)] = int(number)

    def step(self, seconds):
        self.haptics.step(seconds)

    def get(self, number):
        body = self.bodies[number].body
        return (*(value / UNITS for value in (*body.position, *body.velocity)), body.angle, body.angular_velocity)

    def take(self):
        return [value for event in self.haptics.take(at_once=True) for value in (event["time_ns"], self.ids.get(event["fixture"], 0), event["impulse_n_s"], event["kind"])]

    def explain(self):
        return (self.haptics.explain(),)

    def pin(self, a, b, x, y):
        joint = pymunk.PivotJoint(self.bodies[a].body, self.bodies[b].body if b else self.space.static_body, (x * UNITS, y * UNITS))
        joint.collide_bodies = False
        self.space.add(joint)

    def gravity(self, _number, g, *_):
        self.space.gravity = (0, -g * UNITS)

    def type(self, number, kind, *_):
        body = self.bodies[number].body
        body.body_type = TYPES[int(kind)]
        if kind == 2:
            body.mass, body.moment = body.made

    def put(self, number, x, y, _):
        self.bodies[number].body.position = (x * UNITS, y * UNITS)
        self.space.reindex_shapes_for_body(self.bodies[number].body)

    def fling(self, number, vx, vy, spin):
        self.bodies[number].body.velocity, self.bodies[number].body.angular_velocity = (vx * UNITS, vy * UNITS), spin

    moves = fling

    def mass(self, number, kg, *_):
        self.bodies[number].body.mass = kg

    def lockTurn(self, number, *_):
        self.bodies[number].body.moment = math.inf

    def remove(self, number, *_):
        self.space.remove(self.bodies[number], self.bodies[number].body)

    def sensor(self, number, is_sensor, *_):
        self.bodies[number].sensor = bool(is_sensor)

    def passes(self, number, does_pass, *_):
        self.bodies[number].filter = pymunk.ShapeFilter(mask=0) if does_pass else pymunk.ShapeFilter()

    def sleep(self, number, *_):
        self.space.sleep_time_threshold = 100
        self.bodies[number].body.sleep()


kit = Kit()
print("> type put fling moves mass lockTurn gravity remove sensor passes sleep", flush=True)
for line in sys.stdin:
    word, *told = line.split()
    answer = getattr(kit, word)(*(float(value) for value in told))
    if answer is not None:
        print("> " + " ".join(map(str, answer)), flush=True)
