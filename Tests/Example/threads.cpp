// SPDX-License-Identifier: MIT
// A game's two threads: one steps the world, the other fills the blocks of an audio device, whose frames are
// the clock. What happens at world time t is felt at t + L, and L is a constant: late and early threads are
// not felt.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <physvib/Core/ClockLaw.h>
#include <physvib/Core/EventQueue.h>
#include <physvib/Core/HapticRenderer.h>
#include <physvib/Physics/Attachment.h>
#include <thread>
#include <vector>

namespace {

constexpr int rate = 48000, block = 256, seconds = 5;
constexpr physvib::ClockLaw law{
    .sampleRateHz = rate, .blockFrames = block, .stepsPerSecond = 100, .longestGapSeconds = 0.005};
constexpr std::int64_t stepNs = 1'000'000'000 / law.stepsPerSecond;

std::atomic<std::int64_t> sessionNs{0}; // the device has come so far: the world may
std::atomic<std::int64_t> worldNs{0};   // the world has come so far
std::atomic<bool> isOver{false};
physvib::EventQueue<physvib::CollisionEvent, 1024> queue;

void stepTheWorld() {
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
    ball->SetRestitution(0.8f);
    physvib::ImpactSettings settings;
    settings.driveGain = 0.5; // a field of 1 m is crossed slowly: hits are hard in it
    physvib::Attachment haptics(world, settings);
    // refused: it says why
    if (!haptics.set(*ball, {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true})) return;

    const auto laterNs = static_cast<std::int64_t>(law.outputLatencySeconds() * 1.0e9);
    std::vector<physvib::CollisionEvent> events;
    while (!isOver) {
        if (haptics.timeNs() + stepNs > sessionNs) {
            std::this_thread::yield(); // a game would draw a picture
            continue;
        }
        haptics.beginStepUntil(haptics.timeNs() + stepNs);
        world.Step(1.0f / law.stepsPerSecond, 8, 3);
        haptics.endStep();
        events.clear();
        haptics.take(events);
        for (physvib::CollisionEvent& event : events) {
            event.timeNs += laterNs;
            queue.push(event);
        }
        worldNs = haptics.timeNs();
    }
}

} // namespace

int main() {
    physvib::ActuatorLayout layout;
    physvib::layoutPreset("phone4", layout);
    const auto renderer = std::make_unique<physvib::HapticRenderer>();
    if (!renderer->prepare({.sampleRateHz = rate,
                            .channels = 4,
                            .panner = {layout, physvib::PanningLaw::linear, 1.0, 1.0, 1.0}}))
        return 1;
    std::array<std::array<float, block>, 4> out{};
    std::array<float*, 4> channels{out[0].data(), out[1].data(), out[2].data(), out[3].data()};

    std::thread physics(stepTheWorld);
    float peak = 0.0f;
    for (std::int64_t frame = 0; frame < std::int64_t{rate} * seconds; frame += block) {
        sessionNs = frame * 1'000'000'000 / rate;
        // a device waits by itself; its callback only renders
        while (worldNs < sessionNs - law.safeLagNs()) std::this_thread::yield();
        renderer->render(queue, channels.data(), block);
        for (const auto& channel : out)
            for (const float sample : channel) peak = std::max(peak, std::abs(sample));
    }
    isOver = true;
    physics.join();
    const auto status = renderer->status();
    std::cout << "felt " << 1000.0 * law.outputLatencySeconds() << " ms later: " << status.played
              << " events, " << status.late << " late, peak " << peak << '\n';
}
