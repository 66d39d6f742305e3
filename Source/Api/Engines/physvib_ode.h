/* SPDX-License-Identifier: MIT */
/* ODE: number the geoms (dGeomSetData, integers from 1); call physvib_ode_touch_contact for each contact
 * joint in the near callback, then physvib_ode_step. Bodies and geoms may be destroyed between the two,
 * joints may not. A touching geom without a number is an error. Define PHYSVIB_NUMBERS_FROM_0 for numbers
 * from 0, as in earlier versions; a geom without a number is then body 0. Contacts are those in space; the
 * field is the x, y plane, and z goes across it. A game in that plane (dJointCreatePlane2D) sets `is_plane`:
 * all contacts then count at z = 0, and a normal that is not in the plane is an error. C99 and later, C++11
 * and later. */
#ifndef PHYSVIB_ODE_H
#define PHYSVIB_ODE_H
#include <math.h>
#include <ode/ode.h>
#include <physvib/physvib.h>
#include <stdint.h>
#include <string.h>
#define PHYSVIB_ODE_MOST 1024 /**< joints in a step */

/** State between two steps; zero it, and set `world`. */
typedef struct physvib_ode {
    physvib_world world; /**< PhysVib's world */
    int count;           /**< joints in this step; more than PHYSVIB_ODE_MOST are an error */
    dJointFeedback feedback[PHYSVIB_ODE_MOST]; /**< of each joint */
    physvib_contact contact[PHYSVIB_ODE_MOST]; /**< of each joint */
    double pull[PHYSVIB_ODE_MOST]; /**< of a falling body against a fixed one: 1 if it is the second geom's,
                                      -1 if the first's; else 0 */
    int code;                      /**< the first error so far, or PHYSVIB_OK */
    char error[160];               /**< text of that error */
    dContactGeom geom[PHYSVIB_ODE_MOST]; /**< of each joint */
    int is_plane;                        /**< 1: contacts in the x, y plane alone (0) */
    dJointID joint[PHYSVIB_ODE_MOST];    /**< each joint */
    dBodyID body[PHYSVIB_ODE_MOST][2];   /**< bodies of each joint's first and second geom, or NULL */
} physvib_ode;

PHYSVIB_UNUSED static void physvib_ode_check(physvib_ode* ode, int code, const char* line) {
    if (code >= 0 || ode->code != PHYSVIB_OK) return;
    ode->code = code;
    strncpy(ode->error, line, sizeof ode->error - 1);
}

PHYSVIB_UNUSED static int physvib_ode_is_numbered(dGeomID geom) {
#ifdef PHYSVIB_NUMBERS_FROM_0
    return (int)(intptr_t)dGeomGetData(geom) >= 0;
#else
    return (int)(intptr_t)dGeomGetData(geom) > 0;
#endif
}

PHYSVIB_UNUSED static double physvib_ode_mass(dGeomID geom) { /* 0: nothing moves it */
    dBodyID body = dGeomGetBody(geom);
    dMass mass;
    if (!body || dBodyIsKinematic(body)) return 0;
    dBodyGetMass(body, &mass);
    return mass.mass;
}

/* Reports a body's motion; `turning`: as physvib_world_move_in_space has it. */
PHYSVIB_UNUSED static void physvib_ode_motion(physvib_ode* ode, dBodyID body, int id, const double* turning) {
    const dReal *at = dBodyGetPosition(body), *v = dBodyGetLinearVel(body), *turns = dBodyGetAngularVel(body);
    const double centre[3] = {at[0], at[1], at[2]}, velocity[3] = {v[0], v[1], v[2]},
                 spin[3] = {turns[0], turns[1], turns[2]};
    physvib_ode_check(ode,
                      ode->is_plane
                          ? physvib_world_move(ode->world, id, at[0], at[1], v[0], v[1], turns[2])
                          : physvib_world_move_in_space(ode->world, id, centre, velocity, spin, turning),
                      physvib_error());
}

/* Reports mass and motion of the geom's body. How easily it turns does not matter, as ODE reports impulses.
 */
PHYSVIB_UNUSED static void physvib_ode_move(physvib_ode* ode, dGeomID geom) {
    const int id = (int)(intptr_t)dGeomGetData(geom);
    physvib_ode_check(ode, physvib_world_set_mass(ode->world, id, physvib_ode_mass(geom)), physvib_error());
    if (dGeomGetBody(geom)) physvib_ode_motion(ode, dGeomGetBody(geom), id, NULL);
}

/* Along the normal. `moved_s`: the length of a step that has moved the body since; its point moved with it.
 */
PHYSVIB_UNUSED static double physvib_ode_speed(dBodyID body, const dContactGeom* at, double moved_s) {
    dVector3 v = {0, 0, 0, 0};
    const dReal *by = body ? dBodyGetLinearVel(body) : v, s = (dReal)moved_s;
    if (body)
        dBodyGetPointVel(body, at->pos[0] + s * by[0], at->pos[1] + s * by[1], at->pos[2] + s * by[2], v);
    return dCalcVectorDot3(v, at->normal);
}

/* The impact's part of a contact's impulse: gravity of the step adds a load. ODE's error correction
 * (dWorldSetERP) moves overlaps apart by a speed that the bodies keep: what should stay leaves up to a fifth
 * as fast as it came. What parts no faster does not bounce: a restitution below that counts as 0. */
PHYSVIB_UNUSED static double physvib_ode_share(const physvib_ode* ode, int index, dWorldID world,
                                               double seconds) {
    const dContactGeom* geom = &ode->geom[index];
    const double approach = ode->contact[index].approach_m_per_s,
                 parts = physvib_ode_speed(ode->body[index][0], geom, seconds) -
                         physvib_ode_speed(ode->body[index][1], geom, seconds),
                 most = dWorldGetContactMaxCorrectingVel(world);
    double corrects = dWorldGetERP(world) * geom->depth / seconds, falls;
    dVector3 g;
    dWorldGetGravity(world, g);
    falls = ode->pull[index] * dCalcVectorDot3(g, geom->normal) * seconds;
    if (corrects > most) corrects = most;
    return (approach + (parts > 1.1 * corrects ? parts : 0)) /
           (approach + (falls > 0 ? falls : 0) + (parts > 0 ? parts : 0));
}

/* Call in the near callback, after dJointCreateContact(...) and dJointAttach(joint, ...), for contacts that
 * are not soft. ODE's normals point into the first geom. */
PHYSVIB_UNUSED static void physvib_ode_touch(physvib_ode* ode, dJointID joint, const dContactGeom* geom) {
    physvib_contact* contact = &ode->contact[ode->count < PHYSVIB_ODE_MOST ? ode->count : 0];
    const double a = physvib_ode_mass(geom->g1), b = physvib_ode_mass(geom->g2);
    if (ode->count == PHYSVIB_ODE_MOST) {
        physvib_ode_check(ode, PHYSVIB_ERROR_FULL, "joints: expected at most PHYSVIB_ODE_MOST in a step");
        return;
    }
    if (!physvib_ode_is_numbered(geom->g1) || !physvib_ode_is_numbered(geom->g2)) {
        physvib_ode_check(ode, PHYSVIB_ERROR_ARGUMENT,
                          "geom: expected a number (dGeomSetData, from 1 on) of every geom that touches");
        return;
    }
    physvib_ode_move(ode, geom->g1);
    physvib_ode_move(ode, geom->g2);
    physvib_contact_init(contact, sizeof *contact);
    contact->a = (int)(intptr_t)dGeomGetData(geom->g1), contact->b = (int)(intptr_t)dGeomGetData(geom->g2);
    contact->x_m = geom->pos[0], contact->y_m = geom->pos[1], contact->normal_x = -geom->normal[0],
    contact->normal_y = -geom->normal[1];
    if (!ode->is_plane) contact->z_m = geom->pos[2], contact->normal_z = -geom->normal[2];
    contact->approach_m_per_s = physvib_ode_speed(dGeomGetBody(geom->g2), geom, 0) -
                                physvib_ode_speed(dGeomGetBody(geom->g1), geom, 0);
    contact->gap_m = -geom->depth; /* at the start of the step */
    contact->point_id = PHYSVIB_POINT_BY_PLACE;
    ode->geom[ode->count] = *geom;
    ode->pull[ode->count] = (b > 0) - (a > 0);
    ode->joint[ode->count] = joint;
    ode->body[ode->count][0] = dGeomGetBody(geom->g1), ode->body[ode->count][1] = dGeomGetBody(geom->g2);
    /* ODE writes none for bodies that sleep */
    memset(&ode->feedback[ode->count], 0, sizeof ode->feedback[ode->count]);
    dJointSetFeedback(joint, &ode->feedback[ode->count++]);
}

/* The inverse of a body's moments of inertia, xx, yy, zz, xy, xz, yz in the world's axes, by Cholesky's
 * factors. All 0 (nothing turns it) if they are those of no body. */
PHYSVIB_UNUSED static void physvib_ode_turning(dBodyID body, double to[6]) {
    const dReal* turned = dBodyGetRotation(body);
    double factor[3][3], solved[3][3];
    dMass mass;
    int i, j, k;
    for (i = 0; i < 6; ++i) to[i] = 0;
    dBodyGetMass(body, &mass);
    for (i = 0; i < 3; ++i)
        for (j = 0; j <= i; ++j) {
            double left = mass.I[4 * i + j];
            for (k = 0; k < j; ++k) left -= factor[i][k] * factor[j][k];
            if (i == j && !(left > 0)) return;
            factor[i][j] = i == j ? sqrt(left) : left / factor[j][j];
        }
    for (i = 0; i < 3; ++i) /* each of the world's axes, in the body's */
        for (j = 0; j < 3; ++j) {
            solved[i][j] = turned[4 * i + j];
            for (k = 0; k < j; ++k) solved[i][j] -= factor[j][k] * solved[i][k];
            solved[i][j] /= factor[j][j];
        }
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < 3; ++i) to[i] += solved[i][k] * solved[i][k];
        to[3] += solved[0][k] * solved[1][k], to[4] += solved[0][k] * solved[2][k];
        to[5] += solved[1][k] * solved[2][k];
    }
}

PHYSVIB_UNUSED static void physvib_ode_soften(physvib_ode* ode, dBodyID body, int id) {
    double turning[6];
    if (!body || ode->is_plane) return;
    physvib_ode_turning(body, turning);
    physvib_ode_motion(ode, body, id, turning);
}

/* The same, with what the surfaces are made of. A soft contact's impulse (dContactSoftERP or dContactSoftCFM
 * in `mode`) is a spring's over many steps, or pushes an overlap apart: no impact. That follows from speed,
 * masses and `bounce`. In a plane that needs inertia_kg_m2 of the bodies. */
PHYSVIB_UNUSED static void physvib_ode_touch_contact(physvib_ode* ode, dJointID joint, const dContact* from) {
    const int mode = from->surface.mode, before = ode->count;
    physvib_contact* contact;
    physvib_ode_touch(ode, joint, &from->geom);
    if (ode->count == before || !(mode & (dContactSoftERP | dContactSoftCFM))) return;
    contact = &ode->contact[before];
    contact->is_soft = PHYSVIB_SOFT;
    if ((mode & dContactBounce) && contact->approach_m_per_s > from->surface.bounce_vel)
        contact->restitution = from->surface.bounce < 1 ? from->surface.bounce : 1;
    physvib_ode_soften(ode, ode->body[before][0], contact->a);
    physvib_ode_soften(ode, ode->body[before][1], contact->b);
}

/* Whether the joint still holds the bodies that touched: a body that is destroyed leaves its joints. */
PHYSVIB_UNUSED static int physvib_ode_is_there(const physvib_ode* ode, int index) {
    dBodyID first = dJointGetBody(ode->joint[index], 0), second = dJointGetBody(ode->joint[index], 1);
    int i;
    for (i = 0; i < 2; ++i)
        if (ode->body[index][i] && ode->body[index][i] != first && ode->body[index][i] != second) return 0;
    return 1;
}

/* Call instead of dWorldStep. Returns PHYSVIB_OK, or the first error so far, with its text in ode->error. */
PHYSVIB_UNUSED static int physvib_ode_step(physvib_ode* ode, dWorldID world, double seconds) {
    dVector3 g;
    int i;
    for (i = 0; i < ode->count; ++i)
        if (!physvib_ode_is_there(ode, i)) ode->joint[i] = NULL;
    dWorldGetGravity(world, g);
    physvib_ode_check(ode, physvib_world_begin_step(ode->world, seconds, dCalcVectorLength3(g)),
                      physvib_error());
    dWorldStep(world, seconds);
    for (i = 0; i < ode->count; ++i) {
        physvib_contact* contact = &ode->contact[i];
        const dReal* f = ode->feedback[i].f1;
        if (!ode->joint[i]) continue;
        contact->impulse_n_s = seconds * fabs(f[0] * contact->normal_x + f[1] * contact->normal_y +
                                              f[2] * contact->normal_z); /* of either of the two */
        if (contact->approach_m_per_s > 0.1 && !contact->is_soft)
            contact->impulse_n_s *= physvib_ode_share(ode, i, world, seconds);
        physvib_ode_check(ode, physvib_world_touch(ode->world, contact), physvib_error());
    }
    ode->count = 0;
    physvib_ode_check(ode, physvib_world_end_step(ode->world), physvib_error());
    return ode->code;
}

/* PHYSVIB_NOTE_..., or -1. */
PHYSVIB_UNUSED static int physvib_ode_note(dSpaceID space, dGeomID geom) {
    dBodyID body = dGeomGetBody(geom);
    int i, others = 0, may_touch = 0;
    if (!dGeomIsEnabled(geom)) return PHYSVIB_NOTE_DISABLED;
    for (i = 0; i < dSpaceGetNumGeoms(space); ++i) {
        dGeomID other = dSpaceGetGeom(space, i);
        if (other == geom || dGeomIsSpace(other) || (body && dGeomGetBody(other) == body)) continue;
        others = 1;
        if ((dGeomGetCategoryBits(geom) & dGeomGetCollideBits(other)) ||
            (dGeomGetCategoryBits(other) & dGeomGetCollideBits(geom)))
            may_touch = 1;
    }
    if (others && !may_touch) return PHYSVIB_NOTE_FILTERED;
    return body && !dBodyIsEnabled(body) ? PHYSVIB_NOTE_ASLEEP : -1;
}

/* Writes to `text` why nothing is felt since the last call: an error of this header, or what
 * physvib_world_explain says after a look at the geoms of `space`. */
PHYSVIB_UNUSED static void physvib_ode_explain(physvib_ode* ode, dSpaceID space, char* text, size_t size) {
    int i, note;
    if (size == 0) return;
    if (ode->code != PHYSVIB_OK) {
        strncpy(text, ode->error, size - 1), text[size - 1] = 0;
        return;
    }
    for (i = 0; i < dSpaceGetNumGeoms(space); ++i) {
        dGeomID geom = dSpaceGetGeom(space, i);
        if (dGeomIsSpace(geom) || !physvib_ode_is_numbered(geom)) continue;
        note = physvib_ode_note(space, geom);
        if (note >= 0) physvib_world_note(ode->world, (int)(intptr_t)dGeomGetData(geom), note);
    }
    physvib_world_explain(ode->world, text, size);
}
#endif
