/* SPDX-License-Identifier: MIT */
/* A whole program with Chipmunk 7: a ball falls, bounces, and becomes drop.wav. */
#define PHYSVIB_NUMBERS_FROM_0 /* before the header: a shape without a number is body 0, here the floor */
#include <physvib/engines/physvib_chipmunk.h> /* includes chipmunk/chipmunk.h and physvib/physvib.h */
#include <stdio.h>
#include <stdlib.h>

int main(void) {
    const double dt = 1.0 / 240.0;
    const int frames = 3 * 48000;
    physvib_world_settings how;
    physvib_world world;
    physvib_body body;
    physvib_event events[100];
    physvib_renderer_settings settings;
    physvib_int64 count;
    float* samples = (float*)malloc(4 * frames * sizeof(float));

    cpSpace* space = cpSpaceNew(); /* your game's space, in metres */
    cpSpaceSetGravity(space, cpv(0, -9.81));
    cpBody* still = cpSpaceGetStaticBody(space);
    cpShape* ground = cpSpaceAddShape(space, cpSegmentShapeNew(still, cpv(-5, 0), cpv(5, 0), 0));
    cpBody* ball = cpSpaceAddBody(space, cpBodyNew(0.2, cpMomentForCircle(0.2, 0, 0.1, cpvzero)));
    cpBodySetPosition(ball, cpv(0.3, 0.9));
    cpBodySetVelocity(ball, cpv(0, -0.5 * 9.81 * dt)); /* as on paper: Chipmunk moves first, then accelerates
                                                        */
    cpShape* disc = cpSpaceAddShape(space, cpCircleShapeNew(ball, 0.1, cpvzero));
    cpShapeSetElasticity(ground, 1.0);
    cpShapeSetElasticity(disc, 0.6);

    /* 1. A world of PhysVib that gets the contacts. The field is what the actuators span: 1 m here. */
    physvib_world_settings_init(&how, sizeof how);
    how.field_width_m = 1.0;
    how.full_scale_impulse_n_s = PHYSVIB_AUTOMATIC; /* the hardest usual hit: half of full scale */
    if (physvib_world_create(&how, &world) != PHYSVIB_OK) return puts(physvib_error()), 1;

    /* 2. Numbers and values: 0 is the floor, 1 the ball, which feels. */
    physvib_body_init(&body, sizeof body);
    physvib_world_set_body(world, 0, &body); /* no mass: nothing moves it */
    body.mass_kg = cpBodyGetMass(ball);
    body.inertia_kg_m2 = cpBodyGetMoment(ball);
    body.is_camera = 1; /* a haptic source: its impacts are felt */
    body.frequency_hz = 200.0;
    body.decay_per_s = 30.0;
    physvib_world_set_body(world, 1, &body);
    cpShapeSetUserData(disc, (void*)1);

    /* 3. Attach, and step through PhysVib instead of cpSpaceStep. */
    physvib_chipmunk_attach(space, world);
    for (int step = 0; step < 720; ++step)
        if (physvib_chipmunk_step(space, world, dt) != PHYSVIB_OK) return puts(physvib_chipmunk_error), 1;

    /* 4. The impacts, and their samples: one channel per actuator. */
    physvib_event_init(&events[0], sizeof events[0]); /* the first one's size is that of all */
    count = physvib_world_take(world, events, 100, 1);
    physvib_renderer_settings_init(&settings, sizeof settings); /* 48 kHz, four actuators: layout phone4 */
    settings.field_width_m = settings.field_height_m = 1.0; /* the same field: without it, nothing is felt */
    physvib_render(&settings, events, count, frames, samples);
    physvib_wav_save("drop.wav", samples, 4, frames, settings.rate_hz);
    printf("%d impacts, the first at %.4f s\n", (int)count, (double)events[0].time_ns * 1e-9);
    physvib_world_free(world);
    free(samples);
    return 0;
}
