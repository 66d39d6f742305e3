// SPDX-License-Identifier: MIT
// Box2D through its attachment, in the scenes of the others.
#include "Physics/Attachment.h"
#include "Scenes.h"
#include <map>
#include <memory>

struct Box2d final : scenes::Engine, b2ContactListener {
    Box2d() {
        landsLate = true, isKicked = false;
        verbs = "type put fling moves mass lockTurn gravityScale gravity remove sensor passes sleep enable";
    }
    void begin(double stepSeconds, double g, double e, double mu) override {
        dt = stepSeconds, elasticity = static_cast<float>(e), friction = static_cast<float>(mu);
        haptics.reset(), bodies.clear(), platform = nullptr;
        box2d = std::make_unique<b2World>(b2Vec2{0.0F, static_cast<float>(-g)});
        box2d->SetAllowSleeping(false);
        box2d->SetContactListener(this);
        physvib::ImpactSettings settings;
        settings.normalisation = 1.0;
        settings.handMassKg = 0.0;
        settings.fullScaleNewtonSeconds = fullScale;
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
        def.type = static_cast<b2BodyType>(from.kind());
        def.fixedRotation = !from.turns, def.bullet = from.isBullet;
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
        if (from.isSensor) bodies[from.id]->GetFixtureList()->SetSensor(true);
    }
    void feel(const scenes::Body& body) override {
        number(bodies.at(body.id)->GetFixtureList(), body.id, true);
    }
    void act(const std::string& verb, int id, double x, double y, double z) override {
        const b2Vec2 at{static_cast<float>(x), static_cast<float>(y)};
        if (verb == "gravity") return box2d->SetGravity({0.0F, -at.x});
        b2Body& body = *bodies.at(id);
        b2Fixture& fixture = *body.GetFixtureList();
        if (verb != "sleep") body.SetAwake(true);
        if (verb == "type") body.SetType(static_cast<b2BodyType>(x));
        if (verb == "put") body.SetTransform(at, body.GetAngle());
        if (verb == "fling" || verb == "moves")
            body.SetLinearVelocity(at), body.SetAngularVelocity(static_cast<float>(z));
        if (verb == "mass") {
            const b2MassData mass{at.x, {0.0F, 0.0F}, body.GetInertia() * at.x / body.GetMass()};
            body.SetMassData(&mass);
        }
        if (verb == "lockTurn") body.SetFixedRotation(true);
        if (verb == "gravityScale") body.SetGravityScale(at.x);
        if (verb == "sensor") fixture.SetSensor(x != 0);
        if (verb == "enable") body.SetEnabled(x != 0);
        if (verb == "passes") {
            b2Filter filter;
            filter.maskBits = x != 0 ? 0 : 0xffff;
            fixture.SetFilterData(filter);
        }
        if (verb == "sleep") box2d->SetAllowSleeping(true), body.SetAwake(false);
        if (verb == "remove") box2d->DestroyBody(&body);
    }
    std::string explain() override { return haptics->explain(); }
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
    void step() override { haptics->step(static_cast<float>(dt), 30); }
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
    float elasticity = 0.0F, friction = 0.0F;
    std::unique_ptr<b2World> box2d;
    std::unique_ptr<physvib::Attachment> haptics; // ends before its world
    std::map<int, b2Body*> bodies;
    b2Body* platform = nullptr;
};

int main(int count, char** words) {
    Box2d engine;
    return scenes::run("Box2D", engine, count, words);
}
