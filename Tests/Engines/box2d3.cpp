// SPDX-License-Identifier: MIT
// Box2D 3 through its adapter, in the scenes of the others. No Debian package has it: Tests/Engines/box2d3.sh compiles it.
#include "Scenes.h"
#include <cstdint>
#include <physvib/engines/physvib_box2d3.h>

struct Box2d3 final : scenes::Engine {
    Box2d3() { subSteps = 4, slowest = 60, handedOnPart = 0.05; }
    ~Box2d3() override { end(); }
    void begin(double stepSeconds, double g, double e, bool hasFloor) override {
        end();
        dt = stepSeconds, elasticity = static_cast<float>(e);
        b2WorldDef def = b2DefaultWorldDef();
        def.gravity = {0, static_cast<float>(-g)};
        def.enableSleep = false;
        haptics = {};
        haptics.world = world;
        haptics.box2d = b2CreateWorld(&def);
        const b2Polygon box = b2MakeBox(5, 1);
        if (hasFloor) body(0.0, -1.0, 0.0, 0.0, false, [&](b2BodyId to, const b2ShapeDef& shape) { b2CreatePolygonShape(to, &shape, &box); });
    }
    void ball(double x, double y, double vx, double vy) override {
        const b2Circle disc = {{0, 0}, static_cast<float>(scenes::radius)};
        balls.push_back(body(x, y, vx, vy, true, [&](b2BodyId to, const b2ShapeDef& shape) { b2CreateCircleShape(to, &shape, &disc); }));
        number(balls.back(), static_cast<int>(balls.size()));
    }
    bool box(double x, double y, double width, double height, double w) override {
        const b2Polygon polygon = b2MakeBox(static_cast<float>(width / 2), static_cast<float>(height / 2));
        friction = 1.0F, density = static_cast<float>(3.0 / (width * height));
        balls.push_back(body(x, y, -w * y, 0.0, true, [&](b2BodyId to, const b2ShapeDef& shape) { b2CreatePolygonShape(to, &shape, &polygon); }));
        friction = 0.0F, density = 0.0F;
        b2Body_SetAngularVelocity(balls.back(), static_cast<float>(w));
        number(balls.back(), 1);
        return true;
    }
    double spin() const override { return static_cast<double>(b2Body_GetAngularVelocity(balls[0])); }
    template <class Make>
    b2BodyId body(double x, double y, double vx, double vy, bool falls, Make make) {
        b2BodyDef def = b2DefaultBodyDef();
        def.type = falls ? b2_dynamicBody : b2_staticBody;
        def.position = {static_cast<float>(x), static_cast<float>(y)};
        def.linearVelocity = {static_cast<float>(vx), static_cast<float>(vy)};
        b2ShapeDef shape = b2DefaultShapeDef();
        shape.density = density > 0.0F ? density : static_cast<float>(scenes::massKg / (3.14159265358979 * scenes::radius * scenes::radius));
#if defined(b2_maxPolygonVertices)
        shape.restitution = elasticity, shape.friction = falls ? friction : 1;
#else
        shape.material.restitution = elasticity, shape.material.friction = falls ? friction : 1;
#endif
        const b2BodyId made = b2CreateBody(haptics.box2d, &def);
        make(made, shape);
        if (!falls) number(made, 0);
        return made;
    }
    void number(b2BodyId which, int id) {
        physvib_body values;
        physvib_body_init(&values, sizeof values);
        values.is_camera = id == camera;
        values.frequency_hz = 200.0;
        values.decay_per_s = 30.0;
        if (physvib_box2d3_set(&haptics, which, id, values) != PHYSVIB_OK) std::printf("%s\n", physvib_error());
    }
    void step() override {
        if (physvib_box2d3_step(&haptics, dt, 4) != PHYSVIB_OK) std::printf("%s\n", haptics.error);
    }
    void end() {
        if (haptics.numbers != nullptr) b2DestroyWorld(haptics.box2d);
        physvib_box2d3_free(&haptics);
        balls.clear();
    }
    double height(int i) const override { return static_cast<double>(b2Body_GetPosition(balls[static_cast<std::size_t>(i)]).y); }
    double speed(int i) const override {
        const b2Vec2 v = b2Body_GetLinearVelocity(balls[static_cast<std::size_t>(i)]);
        return static_cast<double>(b2World_GetGravity(haptics.box2d).y < 0 ? v.y : v.x);
    }
    double dt = 0;
    float elasticity = 0, friction = 0, density = 0;
    physvib_box2d3 haptics{};
    std::vector<b2BodyId> balls;
};

int main() {
    Box2d3 engine;
    return scenes::run("Box2D 3", engine, true);
}
