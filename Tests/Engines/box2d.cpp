// SPDX-License-Identifier: MIT
// Box2D through its attachment, in the scenes of the others.
#include "Physics/Attachment.h"
#include "Scenes.h"
#include <map>
#include <memory>

struct Box2d final : scenes::Engine, b2ContactListener {
    Box2d() { landsLate = true; }
    void begin(double stepSeconds, double g, double e, double mu) override {
        dt = static_cast<float>(stepSeconds), elasticity = static_cast<float>(e),
        friction = static_cast<float>(mu);
        haptics.reset(), bodies.clear(), platform = nullptr;
        box2d = std::make_unique<b2World>(b2Vec2{0.0F, static_cast<float>(-g)});
        box2d->SetAllowSleeping(false);
        box2d->SetContactListener(this);
        physvib::ImpactSettings settings;
        settings.normalisation = 1.0;
        settings.handMassKg = 0.0;
        haptics = std::make_unique<physvib::Attachment>(*box2d, settings);
    }
    void floor() override {
        b2EdgeShape surface;
        surface.SetTwoSided({-20.0F, -b2_polygonRadius}, {20.0F, -b2_polygonRadius}); // its skin is at 0
        number(ground().CreateFixture(&surface, 0.0F), scenes::floorBody, false);
    }
    void tiles(double left, double right, int count) override {
        std::vector<b2Vec2> points;
        for (int i = count; i >= 0; --i)
            points.push_back({static_cast<float>(left + (right - left) * i / count), -b2_polygonRadius});
        b2ChainShape chain;
        chain.CreateChain(points.data(), count + 1, {points[0].x + 1, points[0].y},
                          {points.back().x - 1, points[0].y});
        number(ground().CreateFixture(&chain, 0.0F), scenes::floorBody, false);
    }
    b2Body& ground() {
        const b2BodyDef still;
        return *(bodies[0] = box2d->CreateBody(&still));
    }
    void add(const scenes::Body& from) override {
        b2BodyDef def;
        def.type = from.massKg > 0 ? b2_dynamicBody : b2_staticBody;
        def.position.Set(static_cast<float>(from.x), static_cast<float>(from.y));
        def.angle = static_cast<float>(from.angle);
        def.linearVelocity.Set(static_cast<float>(from.vx), static_cast<float>(from.vy));
        def.angularVelocity = static_cast<float>(from.spin);
        b2CircleShape disc;
        disc.m_radius = static_cast<float>(from.width / 2);
        b2PolygonShape polygon;
        // with its skin as large as told
        polygon.SetAsBox(static_cast<float>(from.width / 2) - b2_polygonRadius,
                         static_cast<float>(from.height / 2) - b2_polygonRadius);
        bodies[from.id] = box2d->CreateBody(&def);
        const double area = from.isBox
                                ? (from.width - 2 * b2_polygonRadius) * (from.height - 2 * b2_polygonRadius)
                                : b2_pi * disc.m_radius * disc.m_radius;
        number(bodies[from.id]->CreateFixture(from.isBox ? static_cast<b2Shape*>(&polygon) : &disc,
                                              static_cast<float>(from.massKg / area)),
               from.id, from.isSource, from.grain);
    }
    void number(b2Fixture* fixture, int id, bool isSource, double grain = 0.0) {
        fixture->SetRestitution(elasticity);
        fixture->SetFriction(friction);
        physvib::HapticFixture values{.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = isSource};
        if (grain > 0.0 && isSource)
            values.voice = physvib::Voice::other;
        else
            values.texture.grainMetres = grain;
        (void)haptics->set(*fixture, values, id);
    }
    void pin(int a, int b, double x, double y) override {
        b2RevoluteJointDef def;
        def.Initialize(bodies[a], b > 0 ? bodies[b] : &ground(),
                       {static_cast<float>(x), static_cast<float>(y)});
        box2d->CreateJoint(&def);
    }
    void oneWay(int body) override { platform = bodies[body]; }
    void PreSolve(b2Contact* contact, const b2Manifold*) override {
        const b2Body *a = contact->GetFixtureA()->GetBody(), *b = contact->GetFixtureB()->GetBody();
        if (platform == nullptr || (a != platform && b != platform)) return;
        const b2Body& other = a == platform ? *b : *a;
        const double top = contact->GetFixtureA()->GetBody() == platform
                               ? contact->GetFixtureA()->GetAABB(0).upperBound.y
                               : contact->GetFixtureB()->GetAABB(0).upperBound.y;
        if (scenes::passes(top, other.GetPosition().y, other.GetLinearVelocity().y))
            contact->SetEnabled(false);
    }
    void step() override { haptics->step(dt, 30); }
    std::vector<physvib_event> take() override {
        std::vector<physvib::CollisionEvent> told;
        haptics->flush(told);
        std::vector<physvib_event> events;
        for (const auto& e : told) {
            physvib_event event{};
            event.time_ns = e.timeNs, event.amplitude = e.amplitude, event.x_m = e.x, event.y_m = e.y,
            event.impulse_n_s = e.source.impulseNewtonSeconds;
            event.fixture = e.source.fixture, event.other = e.source.other,
            event.kind = static_cast<int>(e.source.kind);
            events.push_back(event);
        }
        return events;
    }
    scenes::Motion motion(int body) const override {
        const b2Body& it = *bodies.at(body);
        return {it.GetWorldCenter().x,    it.GetWorldCenter().y,   it.GetLinearVelocity().x,
                it.GetLinearVelocity().y, it.GetAngularVelocity(), it.GetAngle()};
    }
    float dt = 0.0F, elasticity = 0.0F, friction = 0.0F;
    std::unique_ptr<b2World> box2d;
    std::unique_ptr<physvib::Attachment> haptics; // ends before its world
    std::map<int, b2Body*> bodies;
    b2Body* platform = nullptr;
};

int main(int count, char** words) {
    Box2d engine;
    return scenes::run("Box2D", engine, count, words);
}
