# SPDX-License-Identifier: MIT
"""MuJoCo's Python package with PhysVib, to be copied into a simulation of your own: `model` and `data` are yours, step() stands for mujoco.mj_step(model, data).
As physvib_mujoco.h does in C; untried with the package itself. The plane of x and z is felt. Afterwards world.take() and physvib.render, or live.follow(world)."""
import mujoco
import numpy as np
import physvib

model = mujoco.MjModel.from_xml_path("mine.xml")
data = mujoco.MjData(model)
world = physvib.World(full_scale_impulse_n_s=physvib.AUTOMATIC)
world.set_body(0)  # MuJoCo's world body
for body in range(1, model.nbody):
    world.set_body(body, mass_kg=model.body_mass[body], is_camera=True, frequency_hz=200.0, decay_per_s=30.0)
force, velocity = np.zeros(6), np.zeros(6)


def step(restitution=0.5):  # instead of mujoco.mj_step(model, data); any integrator but RK4
    mujoco.mj_step1(model, data)
    with world.step(model.opt.timestep, np.linalg.norm(model.opt.gravity)):
        for body in range(1, model.nbody):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, velocity, 0)
            world.move(body, data.xipos[body][0], data.xipos[body][2], velocity[3], velocity[5], -velocity[1])
        mujoco.mj_step2(model, data)
        for i in range(data.ncon):
            contact = data.contact[i]
            if contact.dist > contact.includemargin:
                continue  # close, but not touching yet
            mujoco.mj_contactForce(model, data, i, force)
            world.touch(model.geom_bodyid[contact.geom1], model.geom_bodyid[contact.geom2], contact.pos[0], contact.pos[2],
                        normal_x=contact.frame[0], normal_y=contact.frame[2], impulse_n_s=force[0] * model.opt.timestep,
                        restitution=restitution, gap_m=contact.dist - contact.includemargin, is_soft=True, point_id=physvib.POINT_BY_PLACE)
