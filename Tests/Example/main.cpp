// SPDX-License-Identifier: MIT
// Somebody's own Box2D world, in which a ball falls on a slab: four enchanters feel it.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <physvib/Core/EventQueue.h>
#include <physvib/Core/HapticRenderer.h>
#include <physvib/Physics/Attachment.h>
#include <vector>

int main() {
    b2World world({0.0f, -9.81f});
    b2BodyDef body;
    b2PolygonShape slab;
    slab.SetAsBox(1.0f, 0.1f);
    world.CreateBody(&body)->CreateFixture(&slab, 0.0f);
    body.type = b2_dynamicBody;
    body.position.Set(0.3f, 0.9f);
    b2CircleShape disc;
    disc.m_radius = 0.1f;
    b2Fixture* ball = world.CreateBody(&body)->CreateFixture(&disc, 1.0f);
    ball->SetRestitution(0.6f);

    // PhysVib: how the ball vibrates, and four enchanters on the corners of a field of 1 m x 1 m.
    physvib::Attachment haptics(world);
    // refused: it says why
    if (!haptics.set(*ball, {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true})) return 1;
    physvib::ActuatorLayout layout;
    physvib::layoutPreset("phone4", layout);
    const auto renderer = std::make_unique<physvib::HapticRenderer>();
    if (!renderer->prepare({.channels = 4, .panner = {layout, physvib::PanningLaw::linear, 1.0, 1.0, 1.0}}))
        return 1;

    std::vector<physvib::CollisionEvent> events;
    physvib::EventQueue<physvib::CollisionEvent, 64> queue; // its two ends may be on two threads
    std::array<std::array<float, 480>, 4> out;              // 10 ms of four channels
    std::array<float*, 4> channels{out[0].data(), out[1].data(), out[2].data(), out[3].data()};
    float peak = 0.0f;
    for (int step = 0; step < 200; ++step) {
        haptics.step(0.01f);     // or haptics.beginStep(0.01), world.Step(...), haptics.endStep()
        if (step == 0) continue; // the events of a step are final one step later
        events.clear();
        haptics.take(events);
        for (const auto& event : events) queue.push(event);
        renderer->render(queue, channels.data(), 480);
        for (const auto& channel : out)
            for (const float sample : channel) peak = std::max(peak, std::abs(sample));
    }
    const auto status = renderer->status();
    std::cout << status.played << " events, " << status.late << " late, peak " << peak << '\n';
}
