/* SPDX-License-Identifier: MIT */
/* Box2D 3 (3.0, 3.1 and its state of August 2026). physvib_box2d3_set assigns a body its number (from 0) and
 * its values; call physvib_box2d3_step instead of b2World_Step. Shapes need no hit events: contacts are read
 * after the step. C and C++; one world, one thread. */
#ifndef PHYSVIB_BOX2D3_H
#define PHYSVIB_BOX2D3_H
#include <box2d/box2d.h>
#include <math.h>
#include <physvib/physvib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names that differ between versions. */
#if defined(b2_maxPolygonVertices) /* 3.0 */
/* maximum of the sub-steps: a lower bound */
#define PHYSVIB_BOX2D3_PUSHED(point) ((double)(point)->maxNormalImpulse)
#define PHYSVIB_BOX2D3_INERTIA(body) b2Body_GetInertiaTensor(body)
#elif defined(B2_NULL_INDEX) /* after 3.1 */
#define PHYSVIB_BOX2D3_INERTIA(body)                                                                         \
    (b2Body_GetMotionLocks(body).angularZ ? 0 : b2Body_GetRotationalInertia(body))
#else
#define PHYSVIB_BOX2D3_INERTIA(body) b2Body_GetRotationalInertia(body)
#endif
#if defined(B2_NULL_INDEX)
#define PHYSVIB_BOX2D3_PUSHED(point) ((double)(point)->totalNormalImpulse)
#define PHYSVIB_BOX2D3_CENTRE(body) b2Body_GetWorldCenter(body)
#else
#define PHYSVIB_BOX2D3_CENTRE(body) b2Body_GetWorldCenterOfMass(body)
#endif
/* 3.1 counts each sub-step twice: when it is solved and when it is relaxed */
#if !defined(PHYSVIB_BOX2D3_PUSHED)
#define PHYSVIB_BOX2D3_PUSHED(point) (0.5 * (double)(point)->totalNormalImpulse)
#endif

/** A body of Box2D and its number. */
typedef struct physvib_box2d3_number {
    b2BodyId body;       /**< the body when it got its number */
    int id;              /**< -1: removed, or it never had one */
    int is_told;         /**< its error was returned */
    physvib_body values; /**< as they were set */
    double x_m;          /**< before the step; after it: as the step left it, as the next */
    double y_m;          /**< see x_m */
    double vx;           /**< see x_m */
    double vy;           /**< see x_m */
    double spin;         /**< before the step */
    double free_vx;      /**< what the velocity becomes in the step if nothing is touched */
    double free_vy;      /**< see free_vx */
    double lost_x_m;     /**< see physvib_box2d3_stop */
    double lost_y_m;     /**< see physvib_box2d3_stop */
    double lost_rad;     /**< see physvib_box2d3_stop */
} physvib_box2d3_number;

/** State between two steps; zero it, and set `world` and `box2d`. */
typedef struct physvib_box2d3 {
    physvib_world world;                       /**< PhysVib's world */
    b2WorldId box2d;                           /**< Box2D's world */
    double restitution_threshold;              /**< of box2d, m/s; 0: 1, Box2D's default */
    double (*mix_restitution)(double, double); /**< of two shapes; NULL: the larger, Box2D's default */
    int code;                                  /**< an error of the last step, or PHYSVIB_OK */
    char error[160];                           /**< text of that error, or "" */
    int is_new;                                /**< it was not told by an earlier step */
    physvib_box2d3_number* numbers;            /**< by Box2D's index, from 1 */
    int capacity;                              /**< of `numbers` */
    b2ContactData* found;                      /**< contacts of one body */
    int found_capacity;                        /**< of `found` */
    double sub_step_s;                         /**< length of a sub-step */
    double last_step_s;                        /**< length of the step before */
} physvib_box2d3;

#define PHYSVIB_BOX(name) physvib_box2d3##name
#define PHYSVIB_BOX_STATE physvib_box2d3
#define PHYSVIB_BOX_WORLD(haptics) ((haptics)->box2d)
#define PHYSVIB_BOX_NAME "Box2D"
#define PHYSVIB_BOX_INERTIA(body) PHYSVIB_BOX2D3_INERTIA(body)
#define PHYSVIB_B(name) b2##name
#define PHYSVIB_B_EQUALS B2_ID_EQUALS
#include <physvib/engines/physvib_boxes.h>
#undef PHYSVIB_BOX
#undef PHYSVIB_BOX_STATE
#undef PHYSVIB_BOX_WORLD
#undef PHYSVIB_BOX_NAME
#undef PHYSVIB_BOX_INERTIA
#undef PHYSVIB_B
#undef PHYSVIB_B_EQUALS

/* Acceleration by gravity along the normal, m/s^2. */
PHYSVIB_UNUSED static double physvib_box2d3_pull(b2WorldId world, b2BodyId body, b2Vec2 normal) {
    const b2Vec2 g = b2World_GetGravity(world);
    return b2Body_GetType(body) == b2_dynamicBody
               ? (double)b2Body_GetGravityScale(body) * (g.x * normal.x + g.y * normal.y)
               : 0;
}

/* How far the last step would have moved a body's point on along the normal, had it not been stopped. `arm`:
 * from the centre of mass to the point. */
PHYSVIB_UNUSED static double physvib_box2d3_lost(const physvib_box2d3* haptics, b2BodyId body, b2Vec2 normal,
                                                 b2Vec2 arm) {
    const physvib_box2d3_number* number = &haptics->numbers[body.index1];
    return (number->lost_x_m - number->lost_rad * arm.y) * normal.x +
           (number->lost_y_m + number->lost_rad * arm.x) * normal.y;
}

/* Acceleration of a point towards its body's centre, along the normal. */
PHYSVIB_UNUSED static double physvib_box2d3_turn(const physvib_box2d3* haptics, b2BodyId body, b2Vec2 normal,
                                                 b2Vec2 arm) {
    const double spin = haptics->numbers[body.index1].spin;
    return -spin * spin * (arm.x * normal.x + arm.y * normal.y);
}

PHYSVIB_UNUSED static void physvib_box2d3_point(physvib_box2d3* haptics, const b2ContactData* found,
                                                int index, double seconds) {
    const b2ManifoldPoint* point = &found->manifold.points[index];
    const b2BodyId a = b2Shape_GetBody(found->shapeIdA), b = b2Shape_GetBody(found->shapeIdB);
    const b2Vec2 normal = found->manifold.normal;
    const double pull =
        physvib_box2d3_pull(haptics->box2d, a, normal) - physvib_box2d3_pull(haptics->box2d, b, normal);
    const double speed = -point->normalVelocity, gap = fmax(0, point->separation);
    const double root = speed * speed + 2 * pull * gap,
                 least = haptics->restitution_threshold > 0 ? haptics->restitution_threshold : 1;
    double one = b2Shape_GetRestitution(found->shapeIdA), other = b2Shape_GetRestitution(found->shapeIdB),
           meets, impulse = PHYSVIB_BOX2D3_PUSHED(point);
    physvib_contact contact;
#if !defined(B2_NULL_INDEX)
    if (point->separation < -0.005) impulse = 0; /* with what pushes an overlap apart */
#endif
    if (impulse <= 0 && point->separation > 0) return; /* near, but not touching yet */
    /* Box2D's speed is that at the step's start; gravity adds until they meet */
    meets = speed > 0 && root > 0 ? sqrt(root) : speed;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = physvib_box2d3_id(haptics, a), contact.b = physvib_box2d3_id(haptics, b);
#if defined(B2_NULL_INDEX)
    contact.x_m = (double)PHYSVIB_BOX2D3_CENTRE(b).x + (double)point->anchorB.x,
    contact.y_m = (double)PHYSVIB_BOX2D3_CENTRE(b).y + (double)point->anchorB.y;
#else
    contact.x_m = point->point.x, contact.y_m = point->point.y;
#endif
    contact.normal_x = normal.x, contact.normal_y = normal.y;
    contact.approach_m_per_s = meets;
    contact.restitution = haptics->mix_restitution ? haptics->mix_restitution(one, other) : fmax(one, other);
    contact.restitution = speed > least ? fmin(1, fmax(0, contact.restitution)) : 0;
    contact.impulse_n_s = impulse;
    contact.is_soft = PHYSVIB_SOFT_WHOLE;
    contact.point_id = point->id;
    if (contact.a < 0 || contact.b < 0) {
        physvib_box2d3_number* none = physvib_box2d3_entry(haptics, contact.a < 0 ? a : b);
        physvib_box2d3_fail(haptics, none, none ? PHYSVIB_ERROR_ARGUMENT : PHYSVIB_ERROR_MEMORY,
                            "expected a number (physvib_box2d3_set) of every body that touches");
        return;
    }
    if (speed > 0)
        contact.fraction = physvib_box2d3_fraction(
            haptics,
            point->separation + fmin(0, physvib_box2d3_lost(haptics, b, normal, point->anchorB) -
                                            physvib_box2d3_lost(haptics, a, normal, point->anchorA)),
            speed,
            pull + physvib_box2d3_turn(haptics, a, normal, point->anchorA) -
                physvib_box2d3_turn(haptics, b, normal, point->anchorB),
            seconds);
    else
        contact.gap_m = point->separation;
    physvib_box2d3_fail(haptics, &haptics->numbers[b.index1], physvib_world_touch(haptics->world, &contact),
                        physvib_error());
}

PHYSVIB_UNUSED static void physvib_box2d3_contact(physvib_box2d3* haptics, const b2ContactData* found,
                                                  double seconds) {
    int p;
    for (p = 0; p < found->manifold.pointCount; ++p) physvib_box2d3_point(haptics, found, p, seconds);
}

PHYSVIB_UNUSED static double physvib_box2d3_gravity(const physvib_box2d3* haptics) {
    const b2Vec2 g = b2World_GetGravity(haptics->box2d);
    return sqrt((double)(g.x * g.x + g.y * g.y));
}

/* Before the step: a body's motion, and its velocity as it would be without contacts. */
PHYSVIB_UNUSED static void physvib_box2d3_before(physvib_box2d3* haptics, physvib_box2d3_number* number,
                                                 double seconds) {
    const b2BodyId body = number->body;
    const b2Vec2 g = b2World_GetGravity(haptics->box2d), v = b2Body_GetLinearVelocity(body);
    const double x = PHYSVIB_BOX2D3_CENTRE(body).x, y = PHYSVIB_BOX2D3_CENTRE(body).y,
                 mass = b2Body_GetType(body) == b2_dynamicBody ? b2Body_GetMass(body) : 0,
                 inertia = mass > 0 ? PHYSVIB_BOX2D3_INERTIA(body) : 0, scale = b2Body_GetGravityScale(body),
                 pull = mass > 0 ? seconds * scale : 0;
    if (mass != number->values.mass_kg || inertia != number->values.inertia_kg_m2 ||
        scale != number->values.gravity_scale)
        physvib_box2d3_fail(haptics, number, physvib_box2d3_set(haptics, body, number->id, number->values),
                            physvib_error());
    if (number->x_m != x || number->y_m != y || number->vx != v.x || number->vy != v.y)
        number->lost_x_m = number->lost_y_m = number->lost_rad = 0; /* the game has moved it */
    number->x_m = x, number->y_m = y, number->vx = v.x, number->vy = v.y;
    number->free_vx = v.x + pull * (double)g.x, number->free_vy = v.y + pull * (double)g.y;
    number->spin = b2Body_GetAngularVelocity(body);
    physvib_box2d3_fail(
        haptics, number,
        physvib_world_move(haptics->world, number->id, x, y, number->free_vx, number->free_vy, number->spin),
        physvib_error());
}

/* Continuous collision stops a body where it first touches, with its velocity at the step's end; it collides
 * in the next step. What it would have moved on is lost: physvib_box2d3_point adds it to the overlap. What
 * contacts of this step may have moved is no loss; less than Box2D's slop, 5 mm, is not stopped. */
PHYSVIB_UNUSED static void physvib_box2d3_stop(const physvib_box2d3* haptics, physvib_box2d3_number* number,
                                               double seconds) {
    const b2Vec2 v = b2Body_GetLinearVelocity(number->body);
    const double x = PHYSVIB_BOX2D3_CENTRE(number->body).x, y = PHYSVIB_BOX2D3_CENTRE(number->body).y,
                 late = 0.5 * (seconds - haptics->sub_step_s); /* velocities change before bodies move */
    const double to_x = seconds * v.x - late * (v.x - number->vx),
                 to_y = seconds * v.y - late * (v.y - number->vy), path = sqrt(to_x * to_x + to_y * to_y);
    const double struck_x = v.x - number->free_vx, struck_y = v.y - number->free_vy,
                 pushed = 0.5 * seconds * sqrt(struck_x * struck_x + struck_y * struck_y),
                 rounding = 1e-6 * (fabs(x) + fabs(y));
    double lost = path > 0 ? path - ((x - number->x_m) * to_x + (y - number->y_m) * to_y) / path : 0;
    if (path < 0.005 || lost > path || lost < 0.005 * path + pushed + rounding) lost = 0;
    if (lost > 0) lost /= path; /* share of the step */
    number->lost_x_m = lost * to_x, number->lost_y_m = lost * to_y;
    number->lost_rad = lost * seconds * (double)b2Body_GetAngularVelocity(number->body);
    number->x_m = x, number->y_m = y, number->vx = v.x, number->vy = v.y;
}

/* After the step. Impulses follow from changes of momentum: Box2D's own differ between versions. */
PHYSVIB_UNUSED static void physvib_box2d3_after(physvib_box2d3* haptics, const b2BodyEvents* moved) {
    int i;
    for (i = 0; i < moved->moveCount; ++i) {
        const b2BodyId body = moved->moveEvents[i].bodyId;
        const b2Vec2 v = b2Body_GetLinearVelocity(body);
        if (physvib_box2d3_id(haptics, body) < 0) continue;
        physvib_box2d3_fail(haptics, &haptics->numbers[body.index1],
                            physvib_world_moved(haptics->world, physvib_box2d3_id(haptics, body), v.x, v.y,
                                                b2Body_GetAngularVelocity(body)),
                            physvib_error());
    }
}

#endif
