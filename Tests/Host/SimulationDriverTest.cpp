// SPDX-License-Identifier: GPL-3.0-or-later
// Drivers take over from each other, and from blocks that step the world, at any moment.
#include "Live/Devices/SimulationDriver.h"
#include "Live/Rig/Rig.h"
#include "Scene/World/RunSettings.h"
#include "Scene/World/Simulation.h"
#include "Session/FakeHost.h"
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

namespace physvib {
namespace {

using namespace test;

/// Steps the session for that time: as a message thread, a thread of its own, or not (the render call).
void drive(int kind, Session& session, std::chrono::milliseconds time) {
    std::optional<ThreadDriver> driver;
    if (kind == 1) driver.emplace(session, 100);
    for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;
         std::this_thread::sleep_for(std::chrono::milliseconds{kind == 0 ? 10 : 1}))
        if (kind == 0) session.advance();
}

TEST(SimulationDriver, AnyTakesOverFromAnyOther) {
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
        drive(kind, session, std::chrono::milliseconds{20 + random.below(100)});
    }
    stop = true;
    device.join();
    SessionLog log;
    session.readLog(log);
    ASSERT_GT(played.size(), 40u);
    EXPECT_TRUE(played == runTakes(log.takes, setup.run(), played.back().timeNs + 1).events);
    EXPECT_EQ(session.status().render.late, 0u);
}

TEST(SimulationDriver, AWorldThatStandsStillIsLookedAtAsOftenAsItsStepsWouldBeDue) {
    constexpr int frames = 64;
    Session session{shakeTheBoxSetup(0.1)};
    session.prepare(hostRate, frames);
    Block block;
    const auto blocksUntilDue = [&] {
        session.render(block.at.data(), frames, RenderMode::realtime);
        session.advance();
        return (session.world().nextStepNs() - session.pulse().lastNs()) * hostRate / 1'000'000'000.0 /
               frames;
    };
    session.world().setSlowness(0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(blocksUntilDue(), 7.0, 0.01); // of 1.3 ms: no later than 10 ms
}

TEST(SimulationDriver, NoStepIsMadeOnceAllShallEnd) {
    Session session{shakeTheBoxSetup(0.1)};
    session.prepare(hostRate, 480);
    session.advance();
    const std::atomic<bool> ends{true};
    {
        const ThreadDriver driver{session, 100, &ends};
        Block block;
        for (int i = 0; i < 10; ++i) {
            session.render(block.at.data(), 480, RenderMode::realtime);
            std::this_thread::sleep_for(std::chrono::milliseconds{20});
        }
    }
    EXPECT_GT(session.advance(), 0) << "what was due was left";
}

} // namespace
} // namespace physvib
