// SPDX-License-Identifier: MIT
// Box2D through its attachment, in the scenes of the others.
#include "Scenes.h"
#include "Physics/Attachment.h"
#include <memory>

struct Box2d final : scenes::Engine {
    Box2d() { landsLate = true; }
    void begin(double stepSeconds, double g, double e, bool hasFloor) override {
        dt = static_cast<float>(stepSeconds), elasticity = static_cast<float>(e);
        haptics.reset(), balls.clear();
        box2d = std::make_unique<b2World>(b2Vec2{0.0F, static_cast<float>(-g)});
        box2d->SetAllowSleeping(false);
        physvib::ImpactSettings settings;
        settings.normalisation = 1.0;
        settings.handMassKg = 0.0;
        haptics = std::make_unique<physvib::Attachment>(*box2d, settings);
        b2EdgeShape floor;
        floor.SetTwoSided({-5.0F, -b2_polygonRadius}, {5.0F, -b2_polygonRadius}); // its skin is at 0
        const b2BodyDef ground;
        if (hasFloor) box2d->CreateBody(&ground)->CreateFixture(&floor, 0.0F);
    }
    void ball(double x, double y, double vx, double vy) override {
        b2BodyDef body;
        body.type = b2_dynamicBody;
        body.position.Set(static_cast<float>(x), static_cast<float>(y));
        body.linearVelocity.Set(static_cast<float>(vx), static_cast<float>(vy));
        b2CircleShape disc;
        disc.m_radius = static_cast<float>(scenes::radius);
        balls.push_back(box2d->CreateBody(&body));
        b2Fixture* fixture = balls.back()->CreateFixture(&disc, static_cast<float>(scenes::massKg) / (b2_pi * disc.m_radius * disc.m_radius));
        fixture->SetRestitution(elasticity);
        fixture->SetFriction(0.0F);
        if (static_cast<int>(balls.size()) == camera) (void)haptics->set(*fixture, {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true});
    }
    bool box(double x, double y, double width, double height, double w) override {
        b2BodyDef body;
        body.type = b2_dynamicBody;
        body.position.Set(static_cast<float>(x), static_cast<float>(y) + b2_polygonRadius);
        body.linearVelocity.Set(static_cast<float>(-w * y), 0.0F);
        body.angularVelocity = static_cast<float>(w);
        b2PolygonShape shape;
        shape.SetAsBox(static_cast<float>(width / 2), static_cast<float>(height / 2));
        balls.push_back(box2d->CreateBody(&body));
        b2Fixture* fixture = balls.back()->CreateFixture(&shape, static_cast<float>(3.0 / (width * height)));
        fixture->SetFriction(1.0F);
        (void)haptics->set(*fixture, {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true});
        return true;
    }
    double spin() const override { return static_cast<double>(at(0).GetAngularVelocity()); }
    void step() override { haptics->step(dt, 30); }
    std::vector<physvib_event> take() override {
        std::vector<physvib::CollisionEvent> told;
        haptics->flush(told);
        std::vector<physvib_event> events;
        for (const auto& e : told) {
            physvib_event event{};
            event.time_ns = e.timeNs, event.amplitude = e.amplitude, event.x_m = e.x, event.impulse_n_s = e.source.impulseNewtonSeconds;
            events.push_back(event);
        }
        return events;
    }
    const b2Body& at(int i) const { return *balls[static_cast<std::size_t>(i)]; }
    double height(int i) const override { return static_cast<double>(at(i).GetPosition().y); }
    double speed(int i) const override {
        const b2Vec2 v = at(i).GetLinearVelocity();
        return static_cast<double>(box2d->GetGravity().y < 0.0F ? v.y : v.x);
    }
    float dt = 0.0F, elasticity = 0.0F;
    std::unique_ptr<b2World> box2d;
    std::unique_ptr<physvib::Attachment> haptics; // ends before its world
    std::vector<b2Body*> balls;
};

int main() {
    Box2d engine;
    return scenes::run("Box2D", engine, true);
}
