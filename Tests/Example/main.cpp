// SPDX-License-Identifier: MIT
// Somebody's own Box2D world, in which a ball falls on a floor: four enchanters feel it.
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Physics/CollisionCatcher.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

b2Fixture* addCircle(b2World& world, b2BodyType type, float y, float radius) {
    b2BodyDef body;
    body.type = type;
    body.position.Set(0.5f, y);
    b2CircleShape circle;
    circle.m_radius = radius;
    b2Fixture* fixture = world.CreateBody(&body)->CreateFixture(&circle, 1.0f);
    fixture->SetRestitution(0.5f);
    return fixture;
}

int main() {
    b2World world({0.0f, -9.81f});
    b2Fixture* ball = addCircle(world, b2_dynamicBody, 1.0f, 0.1f);
    b2Fixture* floor = addCircle(world, b2_staticBody, -10.0f, 10.0f);

    physvib::CollisionCatcher catcher;
    catcher.add(*ball, {200.0, 30.0, true, 0.0});
    catcher.add(*floor, {});
    world.SetContactListener(&catcher);
    const physvib::ImpactModel model{physvib::defaultNormalisation(1.0), catcher.largestMassKg(), 1.0};
    physvib::EventSorter sorter(100);

    physvib::EnchanterLayout layout;
    physvib::layoutPreset("phone4", layout);
    auto renderer = std::make_unique<physvib::HapticRenderer<physvib::DesktopProfile>>();
    renderer->prepare({.channels = 4, .panner = {layout, physvib::PanningLaw::linear, 1.0, 1.0, 1.0}});

    physvib::EventQueue<physvib::CollisionEvent, 64> queue;
    std::vector<std::vector<float>> out(4, std::vector<float>(480));
    float* channels[] = {out[0].data(), out[1].data(), out[2].data(), out[3].data()};
    std::vector<physvib::CollisionEvent> events;
    const physvib::StepClock clock{100};
    std::size_t count = 0;
    float peak = 0.0f;
    for (int step = 0; step < 200; ++step) {
        catcher.beginStep(clock.stepSeconds());
        world.Step(0.01f, 8, 3);
        catcher.collect(clock, step, model, sorter);
        events.clear();
        sorter.release(clock.timeNs(step), events);
        for (const auto& event : events) queue.push(event);
        count += events.size();
        renderer->render(queue, channels, 480);
        for (const auto& channel : out)
            for (float sample : channel) peak = std::max(peak, std::abs(sample));
    }
    std::printf("%zu events, peak %.3f\n", count, static_cast<double>(peak));
}
