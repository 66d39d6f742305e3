/* SPDX-License-Identifier: MIT */
/* Box3D (0.1 and its state of August 2026). physvib_box3d_set assigns a body its number (from 0) and its
 * values; call physvib_box3d_step instead of b3World_Step. Shapes need no hit events: contacts are read after
 * the step, those in space; the field is the x, y plane, and z goes across it. C and C++; one world, one
 * thread. */
#ifndef PHYSVIB_BOX3D_H
#define PHYSVIB_BOX3D_H
#include <box3d/box3d.h>
#include <math.h>
#include <physvib/physvib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** In the world's axes. */
typedef struct physvib_box3d_vector {
    double of[3]; /**< x, y, z */
} physvib_box3d_vector;

/** A body of Box3D and its number. */
typedef struct physvib_box3d_number {
    b3BodyId body;                 /**< the body when it got its number */
    int id;                        /**< -1: removed, or it never had one */
    int is_told;                   /**< its error was returned */
    physvib_body values;           /**< as they were set */
    physvib_box3d_vector centre;   /**< m, before the step; after it: as the step left it, as the next */
    physvib_box3d_vector velocity; /**< m/s, see centre */
    physvib_box3d_vector spin;     /**< rad/s, before the step */
    physvib_box3d_vector free;     /**< m/s, what the velocity becomes in the step if nothing is touched */
    physvib_box3d_vector lost;     /**< m, see physvib_box3d_stop */
    physvib_box3d_vector lost_rad; /**< see physvib_box3d_stop */
} physvib_box3d_number;

/** State between two steps; zero it, and set `world` and `box3d`. */
typedef struct physvib_box3d {
    physvib_world world;                       /**< PhysVib's world */
    b3WorldId box3d;                           /**< Box3D's world */
    double (*mix_restitution)(double, double); /**< of two shapes; NULL: the larger, Box3D's default */
    int code;                                  /**< an error of the last step, or PHYSVIB_OK */
    char error[160];                           /**< text of that error, or "" */
    int is_new;                                /**< it was not told by an earlier step */
    physvib_box3d_number* numbers;             /**< by Box3D's index, from 1 */
    int capacity;                              /**< of `numbers` */
    b3ContactData* found;                      /**< contacts of one body */
    int found_capacity;                        /**< of `found` */
    double sub_step_s;                         /**< length of a sub-step */
    double last_step_s;                        /**< length of the step before */
} physvib_box3d;

#define PHYSVIB_BOX3D_VECTOR(name, from) physvib_box3d_vector name = {{(from).x, (from).y, (from).z}}

PHYSVIB_UNUSED static double physvib_box3d_dot(const physvib_box3d_vector* a, const physvib_box3d_vector* b) {
    return a->of[0] * b->of[0] + a->of[1] * b->of[1] + a->of[2] * b->of[2];
}

#define PHYSVIB_BOX(name) physvib_box3d##name
#define PHYSVIB_BOX_STATE physvib_box3d
#define PHYSVIB_BOX_WORLD(haptics) ((haptics)->box3d)
#define PHYSVIB_BOX_NAME "Box3D"
#define PHYSVIB_BOX_INERTIA(body) 0 /* told with each step, about each axis */
#define PHYSVIB_B(name) b3##name
#define PHYSVIB_B_EQUALS B3_ID_EQUALS
#include <physvib/engines/physvib_boxes.h>
#undef PHYSVIB_BOX
#undef PHYSVIB_BOX_STATE
#undef PHYSVIB_BOX_WORLD
#undef PHYSVIB_BOX_NAME
#undef PHYSVIB_BOX_INERTIA
#undef PHYSVIB_B
#undef PHYSVIB_B_EQUALS

/** What a contact sees of one of its two bodies, along the normal. */
typedef struct physvib_box3d_side {
    double lost_m; /**< how far the last step would have moved its point on, had it not been stopped */
    double pull;   /**< m/s^2 of that point, by gravity and towards the centre as it turns */
    double fall;   /**< the same by gravity alone */
} physvib_box3d_side;

/* `arm`: from the centre of mass to the point. */
PHYSVIB_UNUSED static physvib_box3d_side physvib_box3d_look(const physvib_box3d* haptics, b3BodyId body,
                                                            const physvib_box3d_vector* normal, b3Vec3 from) {
    PHYSVIB_BOX3D_VECTOR(arm, from);
    PHYSVIB_BOX3D_VECTOR(g, b3World_GetGravity(haptics->box3d));
    const physvib_box3d_number* number = &haptics->numbers[body.index1];
    const double *turn = number->lost_rad.of, *r = arm.of, *n = normal->of;
    physvib_box3d_side side;
    side.lost_m = physvib_box3d_dot(&number->lost, normal) + (turn[1] * r[2] - turn[2] * r[1]) * n[0] +
                  (turn[2] * r[0] - turn[0] * r[2]) * n[1] + (turn[0] * r[1] - turn[1] * r[0]) * n[2];
    side.fall = b3Body_GetType(body) == b3_dynamicBody
                    ? (double)b3Body_GetGravityScale(body) * physvib_box3d_dot(&g, normal)
                    : 0;
    side.pull = side.fall +
                physvib_box3d_dot(&number->spin, &arm) * physvib_box3d_dot(&number->spin, normal) -
                physvib_box3d_dot(&number->spin, &number->spin) * physvib_box3d_dot(&arm, normal);
    return side;
}

PHYSVIB_UNUSED static void physvib_box3d_point(physvib_box3d* haptics, const b3ContactData* found,
                                               const b3Manifold* manifold, int index, double seconds) {
    const b3ManifoldPoint* point = &manifold->points[index];
    const b3BodyId a = b3Shape_GetBody(found->shapeIdA), b = b3Shape_GetBody(found->shapeIdB);
    const double one = b3Shape_GetRestitution(found->shapeIdA),
                 other = b3Shape_GetRestitution(found->shapeIdB), speed = -point->normalVelocity,
                 gap = fmax(0, point->separation);
    physvib_contact contact;
    if (point->totalNormalImpulse <= 0 && point->separation > 0) return; /* near, but not touching yet */
    physvib_contact_init(&contact, sizeof contact);
    contact.a = physvib_box3d_id(haptics, a), contact.b = physvib_box3d_id(haptics, b);
    if (contact.a < 0 || contact.b < 0) {
        physvib_box3d_number* none = physvib_box3d_entry(haptics, contact.a < 0 ? a : b);
        physvib_box3d_fail(haptics, none, none ? PHYSVIB_ERROR_ARGUMENT : PHYSVIB_ERROR_MEMORY,
                           "expected a number (physvib_box3d_set) of every body that touches");
        return;
    }
    {
        PHYSVIB_BOX3D_VECTOR(normal, manifold->normal);
        PHYSVIB_BOX3D_VECTOR(centre, b3Body_GetWorldCenter(b));
        const physvib_box3d_side from = physvib_box3d_look(haptics, a, &normal, point->anchorA),
                                 to = physvib_box3d_look(haptics, b, &normal, point->anchorB);
        /* Box3D's speed is that at the step's start; gravity adds until they meet */
        const double root = speed * speed + 2 * (from.fall - to.fall) * gap;
        contact.x_m = centre.of[0] + (double)point->anchorB.x;
        contact.y_m = centre.of[1] + (double)point->anchorB.y;
        contact.z_m = centre.of[2] + (double)point->anchorB.z;
        contact.normal_x = normal.of[0], contact.normal_y = normal.of[1], contact.normal_z = normal.of[2];
        contact.approach_m_per_s = speed > 0 && root > 0 ? sqrt(root) : speed;
        contact.restitution =
            haptics->mix_restitution ? haptics->mix_restitution(one, other) : fmax(one, other);
        contact.restitution = speed > (double)b3World_GetRestitutionThreshold(haptics->box3d)
                                  ? fmin(1, fmax(0, contact.restitution))
                                  : 0;
        contact.is_soft = PHYSVIB_SOFT_WHOLE;
        contact.point_id = PHYSVIB_POINT_BY_PLACE;
        if (speed > 0)
            contact.fraction =
                physvib_box3d_fraction(haptics, point->separation + fmin(0, to.lost_m - from.lost_m), speed,
                                       from.pull - to.pull, seconds);
        else
            contact.gap_m = point->separation;
    }
    physvib_box3d_fail(haptics, &haptics->numbers[b.index1], physvib_world_touch(haptics->world, &contact),
                       physvib_error());
}

PHYSVIB_UNUSED static void physvib_box3d_contact(physvib_box3d* haptics, const b3ContactData* found,
                                                 double seconds) {
    int m, p;
    for (m = 0; m < found->manifoldCount; ++m)
        for (p = 0; p < found->manifolds[m].pointCount; ++p)
            physvib_box3d_point(haptics, found, &found->manifolds[m], p, seconds);
}

PHYSVIB_UNUSED static double physvib_box3d_gravity(const physvib_box3d* haptics) {
    PHYSVIB_BOX3D_VECTOR(g, b3World_GetGravity(haptics->box3d));
    return sqrt(physvib_box3d_dot(&g, &g));
}

/* Before the step: a body's motion, and its velocity as it would be without contacts. */
PHYSVIB_UNUSED static void physvib_box3d_before(physvib_box3d* haptics, physvib_box3d_number* number,
                                                double seconds) {
    const b3BodyId body = number->body;
    PHYSVIB_BOX3D_VECTOR(g, b3World_GetGravity(haptics->box3d));
    PHYSVIB_BOX3D_VECTOR(centre, b3Body_GetWorldCenter(body));
    PHYSVIB_BOX3D_VECTOR(velocity, b3Body_GetLinearVelocity(body));
    PHYSVIB_BOX3D_VECTOR(spin, b3Body_GetAngularVelocity(body));
    const b3Matrix3 i = b3Body_GetWorldInverseRotationalInertia(body);
    const b3MotionLocks locks = b3Body_GetMotionLocks(body);
    const double mass = b3Body_GetType(body) == b3_dynamicBody ? b3Body_GetMass(body) : 0,
                 scale = b3Body_GetGravityScale(body), x = locks.angularX ? 0 : 1, y = locks.angularY ? 0 : 1,
                 z = locks.angularZ ? 0 : 1;
    const double turning[6] = {x * i.cx.x,     y * i.cy.y,     z * i.cz.z,
                               x * y * i.cx.y, x * z * i.cx.z, y * z * i.cy.z};
    const int is_locked[3] = {locks.linearX, locks.linearY, locks.linearZ};
    int axis;
    if (mass != number->values.mass_kg || scale != number->values.gravity_scale)
        physvib_box3d_fail(haptics, number, physvib_box3d_set(haptics, body, number->id, number->values),
                           physvib_error());
    if (memcmp(&number->centre, &centre, sizeof centre) != 0 ||
        memcmp(&number->velocity, &velocity, sizeof velocity) != 0) { /* the game has moved it */
        memset(&number->lost, 0, sizeof number->lost);
        memset(&number->lost_rad, 0, sizeof number->lost_rad);
    }
    number->centre = centre, number->velocity = number->free = velocity, number->spin = spin;
    for (axis = 0; axis < 3 && mass > 0; ++axis)
        if (!is_locked[axis]) number->free.of[axis] += seconds * scale * g.of[axis];
    physvib_box3d_fail(
        haptics, number,
        physvib_world_move_in_space(haptics->world, number->id, centre.of, number->free.of, spin.of, turning),
        physvib_error());
}

/* Continuous collision stops a body where it first touches, with its velocity at the step's end; it collides
 * in the next step. What it would have moved on is lost: physvib_box3d_point adds it to the overlap. What
 * contacts of this step may have moved is no loss; less than Box3D's slop, 5 mm, is not stopped. */
PHYSVIB_UNUSED static void physvib_box3d_stop(const physvib_box3d* haptics, physvib_box3d_number* number,
                                              double seconds) {
    PHYSVIB_BOX3D_VECTOR(centre, b3Body_GetWorldCenter(number->body));
    PHYSVIB_BOX3D_VECTOR(velocity, b3Body_GetLinearVelocity(number->body));
    PHYSVIB_BOX3D_VECTOR(spin, b3Body_GetAngularVelocity(number->body));
    const double late = 0.5 * (seconds - haptics->sub_step_s); /* velocities change before bodies move */
    physvib_box3d_vector way, moved, struck;
    double path, lost, pushed, rounding;
    int i;
    for (i = 0; i < 3; ++i) {
        way.of[i] = seconds * velocity.of[i] - late * (velocity.of[i] - number->velocity.of[i]);
        moved.of[i] = centre.of[i] - number->centre.of[i];
        struck.of[i] = velocity.of[i] - number->free.of[i];
    }
    path = sqrt(physvib_box3d_dot(&way, &way));
    pushed = 0.5 * seconds * sqrt(physvib_box3d_dot(&struck, &struck));
    rounding = 1e-6 * (fabs(centre.of[0]) + fabs(centre.of[1]) + fabs(centre.of[2]));
    lost = path > 0 ? path - physvib_box3d_dot(&moved, &way) / path : 0;
    if (path < 0.005 || lost > path || lost < 0.005 * path + pushed + rounding) lost = 0;
    if (lost > 0) lost /= path; /* share of the step */
    for (i = 0; i < 3; ++i)
        number->lost.of[i] = lost * way.of[i], number->lost_rad.of[i] = lost * seconds * spin.of[i];
    number->centre = centre, number->velocity = velocity;
}

/* After the step. Impulses follow from changes of momentum: Box3D's own sums count what its sub-steps give
 * again and again. */
PHYSVIB_UNUSED static void physvib_box3d_after(physvib_box3d* haptics, const b3BodyEvents* moved) {
    int i;
    for (i = 0; i < moved->moveCount; ++i) {
        const b3BodyId body = moved->moveEvents[i].bodyId;
        PHYSVIB_BOX3D_VECTOR(velocity, b3Body_GetLinearVelocity(body));
        PHYSVIB_BOX3D_VECTOR(spin, b3Body_GetAngularVelocity(body));
        if (physvib_box3d_id(haptics, body) < 0) continue;
        physvib_box3d_fail(haptics, &haptics->numbers[body.index1],
                           physvib_world_moved_in_space(haptics->world, physvib_box3d_id(haptics, body),
                                                        velocity.of, spin.of),
                           physvib_error());
    }
}

#endif
