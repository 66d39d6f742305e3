/* SPDX-License-Identifier: MIT */
/* A whole program with Box3D: a ball falls in space, and its impacts are printed. */
#include <physvib/engines/physvib_box3d.h>

int main(void) {
    physvib_world_settings how;
    physvib_body values;
    physvib_box3d haptics = {0};
    physvib_event events[100];

    b3WorldDef world_def = b3DefaultWorldDef(); /* your game's world, in metres; y points up */
    world_def.gravity = (b3Vec3){0.0f, -9.81f, 0.0f};
    b3WorldId game = b3CreateWorld(&world_def);
    b3BodyDef body = b3DefaultBodyDef();
    b3ShapeDef shape = b3DefaultShapeDef();
    body.position.y = -0.5f;
    b3BodyId floor = b3CreateBody(game, &body);
    b3BoxHull slab = b3MakeBoxHull(5.0f, 0.5f, 5.0f);
    b3CreateHullShape(floor, &shape, &slab.base);
    body.type = b3_dynamicBody;
    body.position.x = 0.3f, body.position.y = 0.9f;
    b3BodyId ball = b3CreateBody(game, &body);
    b3Sphere round = {{0.0f, 0.0f, 0.0f}, 0.1f};
    shape.baseMaterial.restitution = 0.6f;
    b3CreateSphereShape(ball, &shape, &round);

    /* 1. A world of PhysVib that gets the contacts. The field is what the actuators span: 1 m here. */
    physvib_world_settings_init(&how, sizeof how);
    how.field_width_m = 1.0;
    how.full_scale_impulse_n_s = PHYSVIB_AUTOMATIC; /* the hardest usual hit: half of full scale */
    if (physvib_world_create(&how, &haptics.world) != PHYSVIB_OK) return puts(physvib_error()), 1;
    haptics.box3d = game;

    /* 2. Each body gets a number, from 0 on, and its values. Mass and inertia are read from Box3D. */
    physvib_body_init(&values, sizeof values);
    physvib_box3d_set(&haptics, floor, 0, values);
    values.is_camera = 1; /* a haptic source: its impacts are felt */
    values.frequency_hz = 200.0, values.decay_per_s = 30.0;
    physvib_box3d_set(&haptics, ball, 1, values);

    /* 3. Step through PhysVib instead of b3World_Step. */
    for (int step = 0; step < 180; ++step)
        if (physvib_box3d_step(&haptics, 1.0 / 60.0, 4) != PHYSVIB_OK)
            puts(haptics.error); /* and the game goes on */

    /* 4. The impacts: drop3.c makes samples of them, physvib-live.h plays them at once. */
    physvib_event_init(&events[0], sizeof events[0]); /* the first one's size is that of all */
    physvib_int64 count = physvib_world_take(haptics.world, events, 100, 1);
    printf("%d impacts, the first at %.4f s\n", (int)count, (double)events[0].time_ns * 1e-9);
    physvib_box3d_free(&haptics);
    physvib_world_free(haptics.world);
    b3DestroyWorld(game);
    return count > 0 ? 0 : 1;
}
