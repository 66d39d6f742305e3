/* SPDX-License-Identifier: MIT */
/* Chipmunk 7: attach, number the shapes (cpShapeSetUserData, integers from 1), and step with
 * physvib_chipmunk_step. A touching shape without a number is an error. Define PHYSVIB_NUMBERS_FROM_0 for
 * numbers from 0, as in earlier versions; a shape without a number is then body 0. C99 and later, C++11 and
 * later. */
#ifndef PHYSVIB_CHIPMUNK_H
#define PHYSVIB_CHIPMUNK_H
#include <chipmunk/chipmunk.h>
#include <physvib/physvib.h>
#include <stdint.h>
#include <string.h>

/* The first error so far, or PHYSVIB_OK; and its text. */
PHYSVIB_UNUSED static int physvib_chipmunk_code;
PHYSVIB_UNUSED static char physvib_chipmunk_error[160];

PHYSVIB_UNUSED static void physvib_chipmunk_check(int code, const char* line) {
    if (code >= 0 || physvib_chipmunk_code != PHYSVIB_OK) return;
    physvib_chipmunk_code = code;
    strncpy(physvib_chipmunk_error, line, sizeof physvib_chipmunk_error - 1);
}

PHYSVIB_UNUSED static int physvib_chipmunk_id(const cpShape* shape) {
    return (int)(intptr_t)cpShapeGetUserData(shape);
}

PHYSVIB_UNUSED static int physvib_chipmunk_is_numbered(const cpShape* shape) {
#ifdef PHYSVIB_NUMBERS_FROM_0
    return physvib_chipmunk_id(shape) >= 0;
#else
    return physvib_chipmunk_id(shape) > 0;
#endif
}

PHYSVIB_UNUSED static void physvib_chipmunk_move(physvib_world world, const cpShape* shape, cpBody* body) {
    const cpVect at = cpBodyLocalToWorld(body, cpBodyGetCenterOfGravity(body)), v = cpBodyGetVelocity(body);
    if (!physvib_chipmunk_is_numbered(shape)) return; /* reported where it touches */
    physvib_chipmunk_check(
        physvib_world_set_mass(world, physvib_chipmunk_id(shape),
                               cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC ? cpBodyGetMass(body) : 0),
        physvib_error());
    physvib_chipmunk_check(physvib_world_move(world, physvib_chipmunk_id(shape), at.x, at.y, v.x, v.y,
                                              cpBodyGetAngularVelocity(body)),
                           physvib_error());
}

/* Before the solver: reports the velocities at which the surfaces met. */
PHYSVIB_UNUSED static cpBool physvib_chipmunk_look(cpArbiter* arbiter, cpSpace* space, cpDataPointer world) {
    CP_ARBITER_GET_SHAPES(arbiter, a, b);
    physvib_chipmunk_move((physvib_world)world, a, cpShapeGetBody(a));
    physvib_chipmunk_move((physvib_world)world, b, cpShapeGetBody(b));
    return (void)space, cpTrue;
}

/* Impulse that gravity adds in this step: a load, not part of an impact. */
PHYSVIB_UNUSED static double physvib_chipmunk_load(cpSpace* space, cpBody* a, cpBody* b, cpVect normal) {
    const double pull = cpvdot(cpSpaceGetGravity(space), normal) * cpSpaceGetCurrentTimeStep(space);
    const int falls_a = cpBodyGetType(a) == CP_BODY_TYPE_DYNAMIC,
              falls_b = cpBodyGetType(b) == CP_BODY_TYPE_DYNAMIC;
    return falls_a == falls_b ? 0 : cpfmax(0, falls_a ? pull * cpBodyGetMass(a) : -pull * cpBodyGetMass(b));
}

PHYSVIB_UNUSED static void physvib_chipmunk_push(cpArbiter* arbiter, cpSpace* space, cpDataPointer world) {
    CP_ARBITER_GET_SHAPES(arbiter, a, b);
    const cpVect normal = cpArbiterGetNormal(arbiter);
    const cpContactPointSet points = cpArbiterGetContactPointSet(arbiter);
    double impulse = cpfabs(cpvdot(cpArbiterTotalImpulse(arbiter), normal)); /* equal for both shapes */
    int i;
    if (!physvib_chipmunk_is_numbered(a) || !physvib_chipmunk_is_numbered(b)) {
        physvib_chipmunk_check(
            PHYSVIB_ERROR_ARGUMENT,
            "shape: expected a number (cpShapeSetUserData, from 1 on) of every shape that touches");
        return;
    }
    if (cpArbiterIsFirstContact(arbiter))
        impulse -= physvib_chipmunk_load(space, cpShapeGetBody(a), cpShapeGetBody(b), normal);
    for (i = 0; i < points.count; ++i) {
        physvib_contact contact;
        physvib_contact_init(&contact, sizeof contact);
        contact.a = physvib_chipmunk_id(a), contact.b = physvib_chipmunk_id(b);
        contact.x_m = points.points[i].pointA.x, contact.y_m = points.points[i].pointA.y,
        contact.normal_x = normal.x, contact.normal_y = normal.y;
        contact.impulse_n_s = impulse;
        contact.is_impulse_of_pair = 1; /* Chipmunk reports no impulse per point */
        contact.restitution = cpfclamp01(cpArbiterGetRestitution(arbiter));
        contact.gap_m = points.points[i].distance;
        contact.gap_fraction = 1.0; /* Chipmunk moves bodies before it finds contacts */
        contact.point_id = PHYSVIB_POINT_BY_PLACE;
        physvib_chipmunk_check(physvib_world_touch((physvib_world)world, &contact), physvib_error());
    }
}

/* Uses the default handler; programs with handlers of their own call look and push from them. */
PHYSVIB_UNUSED static void physvib_chipmunk_attach(cpSpace* space, physvib_world world) {
    cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space);
    handler->preSolveFunc = physvib_chipmunk_look, handler->postSolveFunc = physvib_chipmunk_push,
    handler->userData = world;
}

/* Call instead of cpSpaceStep. Returns PHYSVIB_OK, or the first error so far, with its text in
 * physvib_chipmunk_error. */
PHYSVIB_UNUSED static int physvib_chipmunk_step(cpSpace* space, physvib_world world, double seconds) {
    physvib_chipmunk_check(physvib_world_begin_step(world, seconds, cpvlength(cpSpaceGetGravity(space))),
                           physvib_error());
    cpSpaceStep(space, seconds);
    physvib_chipmunk_check(physvib_world_end_step(world), physvib_error());
    return physvib_chipmunk_code;
}

/** A shape that physvib_chipmunk_explain looks at. */
typedef struct physvib_chipmunk_look_at {
    physvib_world world; /**< PhysVib's */
    cpSpace* space;      /**< of the shape */
    cpShape* shape;      /**< the shape */
    int others;          /**< 1: there are shapes of other bodies */
    int may_touch;       /**< 1: it may touch one of them */
} physvib_chipmunk_look_at;

PHYSVIB_UNUSED static void physvib_chipmunk_compare(cpShape* other, void* data) {
    physvib_chipmunk_look_at* at = (physvib_chipmunk_look_at*)data;
    const cpShapeFilter a = cpShapeGetFilter(at->shape), b = cpShapeGetFilter(other);
    if (cpShapeGetBody(other) == cpShapeGetBody(at->shape)) return;
    at->others = 1;
    if (!(a.group != 0 && a.group == b.group) && (a.categories & b.mask) != 0 && (b.categories & a.mask) != 0)
        at->may_touch = 1;
}

PHYSVIB_UNUSED static void physvib_chipmunk_note(cpShape* shape, void* data) {
    physvib_chipmunk_look_at at = *(physvib_chipmunk_look_at*)data;
    int note = -1;
    if (!physvib_chipmunk_is_numbered(shape)) return;
    at.shape = shape;
    cpSpaceEachShape(at.space, physvib_chipmunk_compare, &at);
    if (cpShapeGetSensor(shape))
        note = PHYSVIB_NOTE_SENSOR;
    else if (at.others && !at.may_touch)
        note = PHYSVIB_NOTE_FILTERED;
    else if (cpBodyIsSleeping(cpShapeGetBody(shape)))
        note = PHYSVIB_NOTE_ASLEEP;
    if (note >= 0) physvib_world_note(at.world, physvib_chipmunk_id(shape), note);
}

/* Writes to `text` why nothing is felt since the last call, in one sentence: an error of this header, or what
 * physvib_world_explain says after a look at all shapes. */
PHYSVIB_UNUSED static void physvib_chipmunk_explain(cpSpace* space, physvib_world world, char* text,
                                                    size_t size) {
    physvib_chipmunk_look_at at = {world, space, NULL, 0, 0};
    if (size == 0) return;
    if (physvib_chipmunk_code != PHYSVIB_OK) {
        strncpy(text, physvib_chipmunk_error, size - 1), text[size - 1] = 0;
        return;
    }
    cpSpaceEachShape(space, physvib_chipmunk_note, &at);
    physvib_world_explain(world, text, size);
}
#endif
