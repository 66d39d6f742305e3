/* SPDX-License-Identifier: MIT */
/* MuJoCo 2: bodies are numbered by their body ids (0: the world); call physvib_mujoco_step instead of
 * mj_step. The field is the x, z plane. All integrators but RK4. MuJoCo's contacts are soft and spread their
 * impulse over many steps, so an impact is computed from its speed and a restitution that the caller sets. */
#ifndef PHYSVIB_MUJOCO_H
#define PHYSVIB_MUJOCO_H
#include <math.h>
#include <mujoco/mujoco.h>
#include <physvib/physvib.h>

PHYSVIB_UNUSED static int physvib_mujoco_move(const mjModel* m, const mjData* d, physvib_world world,
                                              int body) {
    mjtNum v[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, body, v, 0);
    return physvib_world_move(world, body, d->xipos[3 * body], d->xipos[3 * body + 2], v[3], v[5], -v[1]);
}

PHYSVIB_UNUSED static int physvib_mujoco_touch(const mjModel* m, const mjData* d, physvib_world world,
                                               int index, double restitution) {
    const mjContact* found = &d->contact[index];
    mjtNum force[6];
    physvib_contact contact;
    if (found->dist > 0) return PHYSVIB_OK; /* near, but not touching yet */
    physvib_contact_init(&contact, sizeof contact);
    contact.a = m->geom_bodyid[found->geom1], contact.b = m->geom_bodyid[found->geom2];
    contact.x_m = found->pos[0], contact.y_m = found->pos[2], contact.normal_x = found->frame[0],
    contact.normal_y = found->frame[2];
    mj_contactForce(m, d, index, force);
    contact.impulse_n_s = force[0] * m->opt.timestep;
    contact.restitution = restitution;
    contact.gap_m = found->dist; /* at the start of the step */
    contact.is_soft = 1;
    contact.point_id = PHYSVIB_POINT_BY_PLACE;
    return physvib_world_touch(world, &contact);
}

PHYSVIB_UNUSED static int physvib_mujoco_step(const mjModel* m, mjData* d, physvib_world world,
                                              double restitution) {
    int i, code, refused = PHYSVIB_OK;
    mj_step1(m, d); /* contacts at the current positions, and the velocities that led there */
    code = physvib_world_begin_step(world, m->opt.timestep, sqrt(mju_dot3(m->opt.gravity, m->opt.gravity)));
    if (code < 0) refused = code;
    for (i = 1; i < m->nbody; ++i)
        if ((code = physvib_mujoco_move(m, d, world, i)) < 0) refused = code;
    mj_step2(m, d);
    for (i = 0; i < d->ncon; ++i)
        if ((code = physvib_mujoco_touch(m, d, world, i, restitution)) < 0) refused = code;
    code = physvib_world_end_step(world);
    return code < 0 ? code : refused; /* PHYSVIB_OK, or an error, with its text in physvib_error() */
}
#endif
