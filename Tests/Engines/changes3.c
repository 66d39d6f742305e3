/* SPDX-License-Identifier: MIT */
/* Box2D 3: a ball whose type, mass or gravity scale changes in flight is felt as it is when it lands, without
 * a word to PhysVib. */
#include <physvib/engines/physvib_box2d3.h>

static void let_go(b2BodyId ball, b2ShapeId shape) {
    (void)shape;
    b2Body_SetType(ball, b2_dynamicBody);
}
static void grow_heavy(b2BodyId ball, b2ShapeId shape) {
    (void)ball;
    b2Shape_SetDensity(shape, 30, true);
}
static void fall_slowly(b2BodyId ball, b2ShapeId shape) {
    (void)shape;
    b2Body_SetGravityScale(ball, 0.5F);
}

static int lands(const char* what, b2BodyType type, void (*change)(b2BodyId, b2ShapeId)) {
    const double seconds = 1.0 / 240;
    b2WorldDef world_def = b2DefaultWorldDef();
    b2BodyDef def = b2DefaultBodyDef();
    b2ShapeDef form = b2DefaultShapeDef();
    b2Polygon floor = b2MakeBox(20, 0.5F);
    b2Circle round = {{0, 0}, 0.1F};
    physvib_box2d3 haptics;
    physvib_world_settings settings;
    physvib_body values;
    physvib_event event;
    b2BodyId ground, ball;
    b2ShapeId shape;
    double before = 0, given = 0;
    int i, count;
    memset(&haptics, 0, sizeof haptics);
    physvib_world_settings_init(&settings, sizeof settings);
    settings.full_scale_impulse_n_s = 1;
    physvib_world_create(&settings, &haptics.world);
    world_def.gravity.y = -9.81F;
    haptics.box2d = b2CreateWorld(&world_def);
    def.position.y = -0.5F;
    ground = b2CreateBody(haptics.box2d, &def);
    b2CreatePolygonShape(ground, &form, &floor);
    def.position.y = 0.9F, def.type = type;
    ball = b2CreateBody(haptics.box2d, &def);
    form.density = 10;
    shape = b2CreateCircleShape(ball, &form, &round);
    physvib_body_init(&values, sizeof values);
    physvib_box2d3_set(&haptics, ground, 0, values);
    values.is_camera = 1, values.frequency_hz = 200, values.decay_per_s = 30;
    physvib_box2d3_set(&haptics, ball, 1, values);
    for (i = 0; i < 240; ++i) {
        if (i == 10) change(ball, shape);
        physvib_box2d3_step(&haptics, seconds, 4);
        given =
            fmax(given, (double)b2Body_GetMass(ball) * ((double)b2Body_GetLinearVelocity(ball).y - before));
        before = b2Body_GetLinearVelocity(ball).y;
    }
    physvib_event_init(&event, sizeof event);
    count = (int)physvib_world_take(haptics.world, &event, 1, 1);
    printf("%s: Box2D gave %.3f N s, felt %.3f\n", what, given, count > 0 ? event.impulse_n_s : 0);
    b2DestroyWorld(haptics.box2d);
    physvib_world_free(haptics.world);
    physvib_box2d3_free(&haptics);
    return count == 1 && fabs(event.impulse_n_s / given - 1) < 0.02 ? 0 : 1;
}

int main(void) {
    return lands("let go: static", b2_staticBody, let_go) +
           lands("let go: kinematic", b2_kinematicBody, let_go) +
           lands("three times heavier", b2_dynamicBody, grow_heavy) +
           lands("gravity scale 0.5", b2_dynamicBody, fall_slowly);
}
