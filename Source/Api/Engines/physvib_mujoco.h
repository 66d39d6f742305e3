/* SPDX-License-Identifier: MIT */
/* MuJoCo 2: bodies are numbered by their body ids (0: the world); call physvib_mujoco_step instead of
 * mj_step. Contacts are those in space. The field is the x, z plane: an event's y is MuJoCo's z, upwards, and
 * its z is MuJoCo's -y, towards the viewer. physvib_mujoco_step_in_plane is for a model whose bodies stay in
 * that plane: all contacts then count at y = 0, and a normal that is not in the plane is an error.
 * All integrators but RK4. MuJoCo's contacts are soft, their impulse lasts: an impact follows from speed and
 * a restitution that the caller sets. Masses are the model's. */
#ifndef PHYSVIB_MUJOCO_H
#define PHYSVIB_MUJOCO_H
#include <math.h>
#include <mujoco/mujoco.h>
#include <physvib/physvib.h>

/* MuJoCo's axes as the field has them: y up, z towards the viewer. */
PHYSVIB_UNUSED static void physvib_mujoco_turned(const mjtNum* from, double to[3]) {
    to[0] = from[0], to[1] = from[2], to[2] = -from[1];
}

/* The inverse of a body's moments of inertia: its principal axes are the columns of ximat. */
PHYSVIB_UNUSED static void physvib_mujoco_turning(const mjModel* m, const mjData* d, int body, double to[6]) {
    int i;
    for (i = 0; i < 6; ++i) to[i] = 0;
    for (i = 0; i < 3 && m->body_invweight0[2 * body + 1] > 1e-12; ++i) { /* joints let it turn */
        const mjtNum inertia = m->body_inertia[3 * body + i], *turned = d->ximat + 9 * body + i;
        const mjtNum column[3] = {turned[0], turned[3], turned[6]};
        double axis[3];
        if (!(inertia > 0)) continue;
        physvib_mujoco_turned(column, axis);
        to[0] += axis[0] * axis[0] / inertia, to[1] += axis[1] * axis[1] / inertia;
        to[2] += axis[2] * axis[2] / inertia, to[3] += axis[0] * axis[1] / inertia;
        to[4] += axis[0] * axis[2] / inertia, to[5] += axis[1] * axis[2] / inertia;
    }
}

PHYSVIB_UNUSED static int physvib_mujoco_move(const mjModel* m, const mjData* d, physvib_world world,
                                              int body, int is_plane) {
    const int is_still = m->body_weldid[body] == 0 || m->body_mocapid[body] >= 0;
    const int code = physvib_world_set_mass(world, body, is_still ? 0 : m->body_mass[body]);
    double centre[3], velocity[3], spin[3], turning[6];
    mjtNum v[6];
    if (code < 0) return code;
    mj_objectVelocity(m, d, mjOBJ_BODY, body, v, 0);
    physvib_mujoco_turned(d->xipos + 3 * body, centre);
    physvib_mujoco_turned(v + 3, velocity);
    physvib_mujoco_turned(v, spin);
    if (is_plane)
        return physvib_world_move(world, body, centre[0], centre[1], velocity[0], velocity[1], spin[2]);
    physvib_mujoco_turning(m, d, body, turning);
    return physvib_world_move_in_space(world, body, centre, velocity, spin, turning);
}

PHYSVIB_UNUSED static int physvib_mujoco_touch(const mjModel* m, const mjData* d, physvib_world world,
                                               int index, double restitution, int is_plane) {
    const mjContact* found = &d->contact[index];
    double at[3], normal[3];
    mjtNum force[6];
    /* before 3.4 boxes overlap half as deep; with a margin geoms push before they do */
    const int is_box = m->geom_type[found->geom1] == mjGEOM_BOX && m->geom_type[found->geom2] == mjGEOM_BOX;
    const mjtNum deeper = mjVERSION_HEADER < 340 && is_box ? mju_min(found->dist, 0) : 0,
                 gap = found->dist + deeper - found->includemargin;
    physvib_contact contact;
    if (gap > 0) return PHYSVIB_OK; /* near, but not touching yet */
    physvib_contact_init(&contact, sizeof contact);
    contact.a = m->geom_bodyid[found->geom1], contact.b = m->geom_bodyid[found->geom2];
    physvib_mujoco_turned(found->pos, at);
    physvib_mujoco_turned(found->frame, normal);
    contact.x_m = at[0], contact.y_m = at[1], contact.normal_x = normal[0], contact.normal_y = normal[1];
    if (!is_plane) contact.z_m = at[2], contact.normal_z = normal[2];
    mj_contactForce(m, d, index, force);
    contact.impulse_n_s = force[0] * m->opt.timestep;
    contact.restitution = restitution;
    contact.gap_m = gap; /* at the start of the step */
    contact.is_soft = 1;
    contact.point_id = PHYSVIB_POINT_BY_PLACE;
    return physvib_world_touch(world, &contact);
}

PHYSVIB_UNUSED static int physvib_mujoco_step_of(const mjModel* m, mjData* d, physvib_world world,
                                                 double restitution, int is_plane) {
    int i, code, refused = PHYSVIB_OK;
    mj_step1(m, d); /* contacts at the current positions, and the velocities that led there */
    code = physvib_world_begin_step(world, m->opt.timestep, sqrt(mju_dot3(m->opt.gravity, m->opt.gravity)));
    if (code < 0) refused = code;
    for (i = 1; i < m->nbody; ++i)
        if ((code = physvib_mujoco_move(m, d, world, i, is_plane)) < 0) refused = code;
    mj_step2(m, d);
    for (i = 0; i < d->ncon; ++i)
        if ((code = physvib_mujoco_touch(m, d, world, i, restitution, is_plane)) < 0) refused = code;
    code = physvib_world_end_step(world);
    return code < 0 ? code : refused; /* PHYSVIB_OK, or an error, with its text in physvib_error() */
}

PHYSVIB_UNUSED static int physvib_mujoco_step(const mjModel* m, mjData* d, physvib_world world,
                                              double restitution) {
    return physvib_mujoco_step_of(m, d, world, restitution, 0);
}

PHYSVIB_UNUSED static int physvib_mujoco_step_in_plane(const mjModel* m, mjData* d, physvib_world world,
                                                       double restitution) {
    return physvib_mujoco_step_of(m, d, world, restitution, 1);
}
#endif
