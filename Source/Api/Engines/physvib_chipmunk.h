/* SPDX-License-Identifier: MIT */
/* Chipmunk 7: attach, give shapes their numbers (cpShapeSetUserData, as integers from 0 on), and step by physvib_chipmunk_step. */
#ifndef PHYSVIB_CHIPMUNK_H
#define PHYSVIB_CHIPMUNK_H
#include <chipmunk/chipmunk.h>
#include <physvib/physvib.h>
#include <stdint.h>

static int physvib_chipmunk_id(const cpShape *shape) { return (int)(intptr_t)cpShapeGetUserData(shape); }

static void physvib_chipmunk_move(physvib_world world, const cpShape *shape, const cpBody *body) {
    const cpVect at = cpBodyLocalToWorld(body, cpBodyGetCenterOfGravity(body)), v = cpBodyGetVelocity(body);
    physvib_world_move(world, physvib_chipmunk_id(shape), at.x, at.y, v.x, v.y, cpBodyGetAngularVelocity(body));
}

/* Before the solver: the velocities with which surfaces have met. */
static cpBool physvib_chipmunk_look(cpArbiter *arbiter, cpSpace *space, cpDataPointer world) {
    CP_ARBITER_GET_SHAPES(arbiter, a, b);
    physvib_chipmunk_move((physvib_world)world, a, cpShapeGetBody(a));
    physvib_chipmunk_move((physvib_world)world, b, cpShapeGetBody(b));
    return (void)space, cpTrue;
}

/* What gravity adds to what is pushed in this step: a load, and no part of a blow. */
static double physvib_chipmunk_load(cpSpace *space, cpBody *a, cpBody *b, cpVect normal) {
    const double pull = cpvdot(cpSpaceGetGravity(space), normal) * cpSpaceGetCurrentTimeStep(space);
    const int falls_a = cpBodyGetType(a) == CP_BODY_TYPE_DYNAMIC, falls_b = cpBodyGetType(b) == CP_BODY_TYPE_DYNAMIC;
    return falls_a == falls_b ? 0 : cpfmax(0, falls_a ? pull * cpBodyGetMass(a) : -pull * cpBodyGetMass(b));
}

static void physvib_chipmunk_push(cpArbiter *arbiter, cpSpace *space, cpDataPointer world) {
    CP_ARBITER_GET_SHAPES(arbiter, a, b);
    const cpVect normal = cpArbiterGetNormal(arbiter), point = cpArbiterGetPointA(arbiter, 0);
    physvib_contact contact;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = physvib_chipmunk_id(a), contact.b = physvib_chipmunk_id(b);
    contact.x_m = point.x, contact.y_m = point.y, contact.normal_x = normal.x, contact.normal_y = normal.y;
    contact.impulse_n_s = cpfabs(cpvdot(cpArbiterTotalImpulse(arbiter), normal)); /* whichever of the two it is told of */
    if (cpArbiterIsFirstContact(arbiter)) contact.impulse_n_s -= physvib_chipmunk_load(space, cpShapeGetBody(a), cpShapeGetBody(b), normal);
    contact.gap_m = cpArbiterGetDepth(arbiter, 0);
    contact.gap_fraction = 1.0; /* Chipmunk moves first, then looks */
    physvib_world_touch((physvib_world)world, &contact);
}

/* Takes the default handler; call look and push from handlers of your own. */
static void physvib_chipmunk_attach(cpSpace *space, physvib_world world) {
    cpCollisionHandler *handler = cpSpaceAddDefaultCollisionHandler(space);
    handler->preSolveFunc = physvib_chipmunk_look, handler->postSolveFunc = physvib_chipmunk_push, handler->userData = world;
}

static void physvib_chipmunk_step(cpSpace *space, physvib_world world, double seconds) {
    physvib_world_begin_step(world, seconds, cpvlength(cpSpaceGetGravity(space)));
    cpSpaceStep(space, seconds);
    physvib_world_end_step(world);
}
#endif
