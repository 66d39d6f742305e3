# SPDX-License-Identifier: MIT
"""A game with pymunk and pygame: balls fall into a box, each click adds one, and all of them are felt. python3 pymunk_game.py [DEVICE]: "PAD:auto", "JACK:system"; without
one, each hit is printed."""
import os
import sys

os.environ.setdefault("SDL_JOYSTICK_HIDAPI", "0")  # before pygame.init: a controller stops by itself if the game is killed
import physvib
import pygame
import pymunk

UNITS, WIDE, HIGH = 100, 800, 600  # a metre, and the window, in pixels
pygame.init()
window, clock, space = pygame.display.set_mode((WIDE, HIGH)), pygame.time.Clock(), pymunk.Space()
space.gravity = (0, 9.81 * UNITS)  # pixels point down
haptics = physvib.attach(space, metres_per_unit=1 / UNITS, field_width_m=WIDE / UNITS, y_down_from_m=HIGH / UNITS, full_scale_impulse_n_s=physvib.AUTOMATIC)
live = physvib.Live(sys.argv[1], field_m=(WIDE / UNITS, HIGH / UNITS)) if len(sys.argv) > 1 else None
corners = [(0, 0), (0, HIGH), (WIDE, HIGH), (WIDE, 0)]
for start, end in zip(corners, corners[1:]):
    wall = pymunk.Segment(space.static_body, start, end, 5)
    wall.elasticity = wall.friction = 0.7
    space.add(wall)


def drop(x, y):
    body = pymunk.Body(0.2, pymunk.moment_for_circle(0.2, 0, 20))
    body.position = x, y
    ball = pymunk.Circle(body, 20)
    ball.elasticity = ball.friction = 0.7
    space.add(body, ball)
    haptics.set(ball, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)


for x in range(100, WIDE, 200):
    drop(x, 100)
began = 0
while True:
    for event in pygame.event.get():
        if event.type == pygame.QUIT:
            sys.exit()
        if event.type == pygame.MOUSEBUTTONDOWN:
            drop(*event.pos)
    haptics.step(1 / 60)
    if live:
        began = live.follow(haptics.world, began)
    else:
        for hit in haptics.take():
            print(f"{hit['time_ns'] * 1e-9:.3f} s: {hit['impulse_n_s']:.2f} N s at {hit['x_m']:.2f}, {hit['y_m']:.2f} m", flush=True)
    window.fill("black")
    for shape in space.shapes:
        if isinstance(shape, pymunk.Circle):
            pygame.draw.circle(window, "orange", shape.body.position, shape.radius)
    pygame.display.flip()
    clock.tick(60)
