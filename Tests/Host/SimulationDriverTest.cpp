// SPDX-License-Identifier: GPL-3.0-or-later
// Drivers take over from each other at any moment, and from blocks that step the world themselves: nothing is
// missing.
#include "Host/Devices/SimulationDriver.h"
#include "Host/MessageLoop.h"
#include "Scene/World/SceneRun.h"
#include "Session/FakeHost.h"
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace physvib {
namespace {

using namespace test;

std::unique_ptr<SimulationDriver> make(int kind, Session& session) {
    if (kind == 0) return std::make_unique<MessageTimerDriver>(session);
    if (kind == 1) return std::make_unique<ThreadDriver>(session, 100);
    return nullptr; // the render call
}

TEST(SimulationDriver, AnyTakesOverFromAnyOther) {
    const juce::ScopedJuceInitialiser_GUI juce;
    constexpr int frames = 480;
    const auto setup = shakeTheBoxSetup(0.1);
    Session session{setup};
    session.prepare(hostRate, frames);
    session.advance();
    std::atomic<bool> stop{false}, offline{false};
    std::vector<CollisionEvent> played;
    std::thread device{[&] { // blocks in real time
        Block block;
        for (auto next = std::chrono::steady_clock::now(); !stop; next += std::chrono::milliseconds{10}) {
            std::this_thread::sleep_until(next);
            session.render(block.at.data(), frames, offline ? RenderMode::offline : RenderMode::realtime);
            for (const auto& e : drain(session)) played.push_back(e);
        }
    }};
    Random random{1};
    for (int i = 0; i < 40; ++i) {
        const int kind = random.below(3);
        offline = kind == 2;
        const auto driver = make(kind, session);
        runFor(0.001 * (20 + random.below(100)));
    }
    stop = true;
    device.join();
    SessionLog log;
    session.readLog(log);
    ASSERT_GT(played.size(), 40u);
    EXPECT_TRUE(played == runTakes(log.takes, setup.run(), played.back().timeNs + 1).events);
    EXPECT_EQ(session.status().render.late, 0u);
}

TEST(SimulationDriver, NoStepIsMadeOnceAllShallEnd) {
    const juce::ScopedJuceInitialiser_GUI juce;
    for (const bool hasThread : {false, true}) {
        Session session{shakeTheBoxSetup(0.1)};
        session.prepare(hostRate, 480);
        session.advance();
        std::atomic<bool> ends{true};
        std::unique_ptr<SimulationDriver> driver;
        if (hasThread)
            driver = std::make_unique<ThreadDriver>(session, 100, &ends);
        else
            driver = std::make_unique<MessageTimerDriver>(session, &ends);
        Block block;
        for (int i = 0; i < 10; ++i) {
            session.render(block.at.data(), 480, RenderMode::realtime);
            runFor(0.02);
        }
        driver.reset();
        EXPECT_GT(session.advance(), 0) << "what was due was left";
    }
}

} // namespace
} // namespace physvib
