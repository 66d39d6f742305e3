# SPDX-License-Identifier: MIT
"""A ball of 0.2 kg falls from 0.8 m onto a floor, bounces and comes to rest: drop.wav, four channels."""
import physvib

g, dt, e, height = 9.81, 0.01, 0.6, 0.8
speed = -0.5 * g * dt  # between two steps
world = physvib.World(full_scale_impulse_n_s=physvib.AUTOMATIC)  # the hardest usual hit: half of full scale
world.set_body(0)  # the floor: no mass, so nothing moves it
world.set_body(1, mass_kg=0.2, is_camera=True, frequency_hz=200.0, decay_per_s=30.0)  # it feels
for _ in range(300):  # your engine does this
    speed += g * dt
    with world.step(dt, g):
        if height < speed * dt:
            world.touch(0, 1, x_m=0.3, approach_m_per_s=speed, restitution=e, gap_m=height)
            if speed > 0.3:
                speed = -e * speed
            else:
                speed = height = 0.0  # it rests
    height -= speed * dt
events = world.take(at_once=True)
physvib.save_wav("drop.wav", physvib.render(events, 3.0, field_m=(1.0, 1.0)))
print(len(events), "hits, the first at", events["time_ns"][0] * 1e-9, "s: drop.wav")
