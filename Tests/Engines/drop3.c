/* SPDX-License-Identifier: MIT */
/* A whole program with Box2D 3: a ball falls, bounces, and becomes drop3.wav. */
#include <physvib/engines/physvib_box2d3.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
    const double dt = 1.0 / 60.0;
    const int frames = 3 * 48000;
    physvib_world_settings how;
    physvib_body values;
    physvib_box2d3 haptics = {0};
    physvib_event events[100];
    physvib_renderer_settings settings;
    float* samples = malloc(4 * frames * sizeof(float));

    b2WorldDef world_def = b2DefaultWorldDef(); /* your game's world, in metres */
    world_def.gravity = (b2Vec2){0.0f, -9.81f};
    b2WorldId game = b2CreateWorld(&world_def);
    b2BodyDef body = b2DefaultBodyDef();
    b2ShapeDef shape = b2DefaultShapeDef();
    b2BodyId floor = b2CreateBody(game, &body);
    b2Polygon slab = b2MakeOffsetBox(5.0f, 0.5f, (b2Vec2){0.0f, -0.5f}, b2MakeRot(0.0f));
    b2CreatePolygonShape(floor, &shape, &slab);
    body.type = b2_dynamicBody;
    body.position = (b2Vec2){0.3f, 0.9f};
    b2BodyId ball = b2CreateBody(game, &body);
    b2Circle disc = {{0.0f, 0.0f}, 0.1f};
    shape.material.restitution = 0.6f; /* 3.0: shape.restitution */
    b2CreateCircleShape(ball, &shape, &disc);

    /* 1. A world of PhysVib that gets the contacts. The field is what the actuators span: 1 m here. */
    physvib_world_settings_init(&how, sizeof how);
    how.field_width_m = 1.0;
    how.full_scale_impulse_n_s = PHYSVIB_AUTOMATIC; /* the hardest usual hit: half of full scale */
    if (physvib_world_create(&how, &haptics.world) != PHYSVIB_OK) return puts(physvib_error()), 1;
    haptics.box2d = game;

    /* 2. Each body gets a number, from 0 on, and its values. Mass and inertia are read from Box2D. */
    physvib_body_init(&values, sizeof values);
    physvib_box2d3_set(&haptics, floor, 0, values);
    values.is_camera = 1; /* a haptic source: its impacts are felt */
    values.frequency_hz = 200.0;
    values.decay_per_s = 30.0;
    physvib_box2d3_set(&haptics, ball, 1, values);

    /* 3. Step through PhysVib instead of b2World_Step. */
    for (int step = 0; step < 180; ++step)
        if (physvib_box2d3_step(&haptics, dt, 4) != PHYSVIB_OK)
            puts(haptics.error); /* and the game goes on */

    /* 4. The impacts, and their samples: one channel per actuator. */
    physvib_event_init(&events[0], sizeof events[0]); /* the first one's size is that of all */
    physvib_int64 count = physvib_world_take(haptics.world, events, 100, 1);
    physvib_renderer_settings_init(&settings, sizeof settings); /* 48 kHz, four actuators: layout phone4 */
    settings.field_width_m = settings.field_height_m = 1.0;
    physvib_render(&settings, events, count, frames, samples);
    physvib_wav_save("drop3.wav", samples, 4, frames, settings.rate_hz);
    printf("%d impacts, the first at %.4f s\n", (int)count, (double)events[0].time_ns * 1e-9);
    physvib_box2d3_free(&haptics);
    physvib_world_free(haptics.world);
    b2DestroyWorld(game);
    free(samples);
    return 0;
}
