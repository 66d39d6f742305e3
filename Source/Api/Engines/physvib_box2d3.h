/* SPDX-License-Identifier: MIT */
/* Box2D 3 (3.0, 3.1 and its state of August 2026). physvib_box2d3_set assigns a body its number (from 0) and
 * its values; call physvib_box2d3_step instead of b2World_Step. Shapes need no hit events: contacts are read
 * after the step, so impacts slower than Box2D's hitEventThreshold are felt too. C and C++; one world, one
 * thread. */
#ifndef PHYSVIB_BOX2D3_H
#define PHYSVIB_BOX2D3_H
#include <box2d/box2d.h>
#include <math.h>
#include <physvib/physvib.h>
#include <stdlib.h>
#include <string.h>
#define PHYSVIB_BOX2D3_MOST 64 /**< contacts of a body in a step; more are an error */

/* Names that differ between versions. */
#if defined(b2_maxPolygonVertices) /* 3.0 */
/* maximum of the sub-steps: a lower bound */
#define PHYSVIB_BOX2D3_PUSHED(point) ((double)(point)->maxNormalImpulse)
#define PHYSVIB_BOX2D3_INERTIA(body) b2Body_GetInertiaTensor(body)
#else
#define PHYSVIB_BOX2D3_INERTIA(body) b2Body_GetRotationalInertia(body)
#endif
#if defined(B2_NULL_INDEX) /* after 3.1 */
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
    b2BodyId body; /**< the body when it got its number */
    int id;        /**< -1: removed */
} physvib_box2d3_number;

/** State between two steps; zero it, and set `world` and `box2d`. */
typedef struct physvib_box2d3 {
    physvib_world world;                       /**< PhysVib's world */
    b2WorldId box2d;                           /**< Box2D's world */
    double restitution_threshold;              /**< of box2d, m/s; 0: 1, Box2D's default */
    double (*mix_restitution)(double, double); /**< of two shapes; NULL: the larger, Box2D's default */
    int code;                                  /**< the first error so far, or PHYSVIB_OK */
    char error[160];                           /**< text of that error */
    physvib_box2d3_number* numbers;            /**< by Box2D's index, from 1 */
    int capacity;                              /**< of `numbers` */
} physvib_box2d3;

PHYSVIB_UNUSED static void physvib_box2d3_fail(physvib_box2d3* haptics, int code, const char* line) {
    if (haptics->code != PHYSVIB_OK || code >= 0) return;
    haptics->code = code;
    strncpy(haptics->error, line, sizeof haptics->error - 1);
}

/* The number of a body, -1 if it has none. The body's user data are not used. */
PHYSVIB_UNUSED static int physvib_box2d3_id(const physvib_box2d3* haptics, b2BodyId body) {
    if (body.index1 >= haptics->capacity || !B2_ID_EQUALS(haptics->numbers[body.index1].body, body))
        return -1;
    return haptics->numbers[body.index1].id;
}

PHYSVIB_UNUSED static int physvib_box2d3_grow(physvib_box2d3* haptics, int index) {
    const int capacity = index < haptics->capacity ? haptics->capacity : 2 * index + 64;
    physvib_box2d3_number* grown = haptics->numbers;
    if (capacity == haptics->capacity) return 1;
    grown = (physvib_box2d3_number*)realloc(grown, (size_t)capacity * sizeof *grown);
    if (!grown) return 0;
    memset(grown + haptics->capacity, 0, (size_t)(capacity - haptics->capacity) * sizeof *grown);
    haptics->numbers = grown, haptics->capacity = capacity;
    return 1;
}

/* Call at the end; freeing `world` is left to the caller. */
PHYSVIB_UNUSED static void physvib_box2d3_free(physvib_box2d3* haptics) {
    free(haptics->numbers);
    haptics->numbers = NULL, haptics->capacity = 0;
}

/* Call before b2DestroyBody. */
PHYSVIB_UNUSED static int physvib_box2d3_remove(physvib_box2d3* haptics, b2BodyId body) {
    const int id = physvib_box2d3_id(haptics, body);
    if (id < 0) return PHYSVIB_OK;
    haptics->numbers[body.index1].id = -1;
    return physvib_world_remove_body(haptics->world, id);
}

/* Sets the values of a body (from physvib_body_init); mass, inertia and gravity scale are read from Box2D.
 * Call it again when these change. */
PHYSVIB_UNUSED static int physvib_box2d3_set(physvib_box2d3* haptics, b2BodyId body, int id,
                                             physvib_body values) {
    const int falls = b2Body_GetType(body) == b2_dynamicBody;
    int code;
    values.mass_kg = falls ? b2Body_GetMass(body) : 0;
    values.inertia_kg_m2 = falls ? PHYSVIB_BOX2D3_INERTIA(body) : 0;
    values.gravity_scale = b2Body_GetGravityScale(body);
    code = physvib_world_set_body(haptics->world, id, &values);
    if (code != PHYSVIB_OK) return code;
    if (!physvib_box2d3_grow(haptics, body.index1)) return PHYSVIB_ERROR_MEMORY;
    haptics->numbers[body.index1].body = body, haptics->numbers[body.index1].id = id;
    return PHYSVIB_OK;
}

/* Acceleration by gravity along the normal, m/s^2. */
PHYSVIB_UNUSED static double physvib_box2d3_pull(b2WorldId world, b2BodyId body, b2Vec2 normal) {
    const b2Vec2 g = b2World_GetGravity(world);
    return b2Body_GetType(body) == b2_dynamicBody
               ? (double)b2Body_GetGravityScale(body) * (g.x * normal.x + g.y * normal.y)
               : 0;
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
    if (impulse <= 0 && point->separation > 0) return; /* near, but not touching yet */
    /* Box2D's speed is that at the start of the step; gravity accelerates the bodies until they meet. */
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
    if (gap > 0 && speed + meets > 0)
        contact.fraction = fmin(1, 2 * gap / (speed + meets) / seconds);
    else
        contact.gap_m = point->separation; /* they overlapped before the step */
    if (contact.a < 0 || contact.b < 0)
        physvib_box2d3_fail(haptics, PHYSVIB_ERROR_ARGUMENT,
                            "body: expected a number (physvib_box2d3_set) of every body that touches");
    else
        physvib_box2d3_fail(haptics, physvib_world_touch(haptics->world, &contact), physvib_error());
}

/* Reports the contacts of an awake body. Each contact is reported once: with its second body, or with the
 * first if the second is static or asleep. */
PHYSVIB_UNUSED static void physvib_box2d3_body(physvib_box2d3* haptics, b2BodyId body, double seconds) {
    b2ContactData found[PHYSVIB_BOX2D3_MOST];
    const int count = b2Body_GetContactData(body, found, PHYSVIB_BOX2D3_MOST);
    int i, p;
    if (b2Body_GetContactCapacity(body) > PHYSVIB_BOX2D3_MOST && count == PHYSVIB_BOX2D3_MOST)
        physvib_box2d3_fail(haptics, PHYSVIB_ERROR_FULL,
                            "contacts: expected at most PHYSVIB_BOX2D3_MOST of a body");
    for (i = 0; i < count; ++i) {
        const b2BodyId a = b2Shape_GetBody(found[i].shapeIdA), b = b2Shape_GetBody(found[i].shapeIdB);
        const int is_second = B2_ID_EQUALS(b, body),
                  rests = b2Body_GetType(b) == b2_staticBody || !b2Body_IsAwake(b);
        if (!is_second && !(B2_ID_EQUALS(a, body) && rests)) continue;
        for (p = 0; p < found[i].manifold.pointCount; ++p)
            physvib_box2d3_point(haptics, &found[i], p, seconds);
    }
}

/* Call instead of b2World_Step. Returns PHYSVIB_OK, or the first error so far, with its text in
 * haptics->error. */
PHYSVIB_UNUSED static int physvib_box2d3_step(physvib_box2d3* haptics, double seconds, int sub_steps) {
    const b2Vec2 g = b2World_GetGravity(haptics->box2d);
    b2BodyEvents moved;
    int i;
    physvib_box2d3_fail(
        haptics, physvib_world_begin_step(haptics->world, seconds, sqrt((double)(g.x * g.x + g.y * g.y))),
        physvib_error());
    for (i = 1; i < haptics->capacity; ++i) { /* velocities as they would be without contacts */
        const b2BodyId body = haptics->numbers[i].body;
        b2Vec2 v;
        double pull;
        if (!body.index1 || haptics->numbers[i].id < 0 || !b2Body_IsValid(body) ||
            b2Body_GetType(body) == b2_staticBody || !b2Body_IsAwake(body))
            continue;
        v = b2Body_GetLinearVelocity(body);
        pull = b2Body_GetType(body) == b2_dynamicBody ? seconds * (double)b2Body_GetGravityScale(body) : 0;
        physvib_box2d3_fail(haptics,
                            physvib_world_move(haptics->world, haptics->numbers[i].id,
                                               PHYSVIB_BOX2D3_CENTRE(body).x, PHYSVIB_BOX2D3_CENTRE(body).y,
                                               v.x + pull * (double)g.x, v.y + pull * (double)g.y,
                                               b2Body_GetAngularVelocity(body)),
                            physvib_error());
    }
    b2World_Step(haptics->box2d, (float)seconds, sub_steps);
    moved = b2World_GetBodyEvents(haptics->box2d);
    /* Impulses are computed from changes of momentum, because Box2D's own differ between versions. */
    for (i = 0; i < moved.moveCount; ++i) {
        const b2BodyId body = moved.moveEvents[i].bodyId;
        const b2Vec2 v = b2Body_GetLinearVelocity(body);
        if (physvib_box2d3_id(haptics, body) < 0) continue;
        physvib_box2d3_fail(haptics,
                            physvib_world_moved(haptics->world, physvib_box2d3_id(haptics, body), v.x, v.y,
                                                b2Body_GetAngularVelocity(body)),
                            physvib_error());
    }
    for (i = 0; i < moved.moveCount; ++i) physvib_box2d3_body(haptics, moved.moveEvents[i].bodyId, seconds);
    physvib_box2d3_fail(haptics, physvib_world_end_step(haptics->world), physvib_error());
    return haptics->code;
}

PHYSVIB_UNUSED static int physvib_box2d3_may_touch(b2Filter a, b2Filter b) {
    if (a.groupIndex == b.groupIndex && a.groupIndex != 0) return a.groupIndex > 0;
    return (a.maskBits & b.categoryBits) != 0 && (a.categoryBits & b.maskBits) != 0;
}

/* True if a filter keeps the body from all other bodies that have numbers. */
PHYSVIB_UNUSED static int physvib_box2d3_is_filtered(const physvib_box2d3* haptics, b2BodyId body) {
    b2ShapeId own[PHYSVIB_BOX2D3_MOST], theirs[PHYSVIB_BOX2D3_MOST];
    const int count = b2Body_GetShapes(body, own, PHYSVIB_BOX2D3_MOST);
    int has_others = 0, i, a, b;
    for (i = 1; i < haptics->capacity; ++i) {
        const b2BodyId other = haptics->numbers[i].body;
        int others;
        if (!other.index1 || haptics->numbers[i].id < 0 || B2_ID_EQUALS(other, body) ||
            !b2Body_IsValid(other))
            continue;
        others = b2Body_GetShapes(other, theirs, PHYSVIB_BOX2D3_MOST);
        for (a = 0; a < count; ++a)
            for (b = 0; b < others; ++b, has_others = 1)
                if (physvib_box2d3_may_touch(b2Shape_GetFilter(own[a]), b2Shape_GetFilter(theirs[b])))
                    return 0;
    }
    return has_others;
}

/* PHYSVIB_NOTE_..., or -1. */
PHYSVIB_UNUSED static int physvib_box2d3_note(const physvib_box2d3* haptics, b2BodyId body) {
    b2ShapeId shapes[PHYSVIB_BOX2D3_MOST];
    const int count = b2Body_GetShapes(body, shapes, PHYSVIB_BOX2D3_MOST);
    int sensors = 0, i;
    if (!b2Body_IsEnabled(body)) return PHYSVIB_NOTE_DISABLED;
    for (i = 0; i < count; ++i) sensors += b2Shape_IsSensor(shapes[i]) ? 1 : 0;
    if (count > 0 && sensors == count) return PHYSVIB_NOTE_SENSOR;
    if (physvib_box2d3_is_filtered(haptics, body)) return PHYSVIB_NOTE_FILTERED;
    return b2Body_GetType(body) != b2_staticBody && !b2Body_IsAwake(body) ? PHYSVIB_NOTE_ASLEEP : -1;
}

/* Writes to `text` why nothing is felt since the last call, in one sentence: an error of this header, or what
 * physvib_world_explain says after a look at all bodies that have numbers. */
PHYSVIB_UNUSED static void physvib_box2d3_explain(const physvib_box2d3* haptics, char* text, size_t size) {
    int i, note;
    if (size == 0) return;
    if (haptics->code != PHYSVIB_OK) {
        strncpy(text, haptics->error, size - 1), text[size - 1] = 0;
        return;
    }
    for (i = 1; i < haptics->capacity; ++i) {
        const b2BodyId body = haptics->numbers[i].body;
        if (!body.index1 || haptics->numbers[i].id < 0 || !b2Body_IsValid(body)) continue;
        note = physvib_box2d3_note(haptics, body);
        if (note >= 0) physvib_world_note(haptics->world, haptics->numbers[i].id, note);
    }
    physvib_world_explain(haptics->world, text, size);
}
#endif
