// SPDX-License-Identifier: GPL-3.0-or-later
// A device that pauses: what comes meanwhile is dropped and counted, nothing is added up when it is back.
#include "FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Rig/Rig.h"
#include "Scene/World/Simulation.h"
#include "Session/FakeHost.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <thread>

namespace physvib::pause_test {

using namespace test;
using namespace std::chrono_literals;

/// A session on a device whose pauses count. A busy machine makes pauses of its own, so a test that needs
/// none is tried again.
struct Paused {
    explicit Paused(SessionSetup wanted = quiet())
        : setup{std::move(wanted)} {
        interface.isReal = true;
        EXPECT_EQ(output.open({"hands", {}, 0, 0, 1.0f}), "");
    }
    static SessionSetup quiet() {
        auto s = shakeTheBoxSetup(0.02);
        s.scene.bodies.clear();
        s.scene.joints.clear();
        s.scene.script.clear();
        return s;
    }
    /// The loudest sample of that time.
    float play(double seconds) {
        const auto blocks = static_cast<int>(std::ceil(seconds * interface.rate / 64));
        return peakOf(playBlocks(session, interface, blocks, 64,
                                 [this](const CollisionEvent& event) { log.push_back(event); }));
    }
    static CollisionEvent tone(double seconds, double atSeconds = 0.0) {
        return {.timeNs = std::llround(1e9 * atSeconds),
                .frequencyHz = 200.0,
                .amplitude = 0.2,
                .durationNs = std::llround(1e9 * seconds)};
    }
    Result<std::int64_t> strike(const CollisionEvent& event, bool canBeStopped = false) {
        return session.submit(
            {Strikes{{&event, 1}, canBeStopped}, canBeStopped ? session.timeline().presentNs() : Input::now});
    }
    void strikeAccepted(const CollisionEvent& event, bool canBeStopped = false) {
        while (!strike(event, canBeStopped)) play(0.002);
    }
    /// Until `act` has run without a pause of the machine's.
    void withoutPause(const std::function<void()>& act) {
        for (int tries = 0; tries < 200; ++tries) {
            play(0.3);
            const auto before = session.pulse().history().pauses;
            act();
            if (session.pulse().history().pauses == before && output.isPlaying()) return;
        }
        FAIL() << "this machine never runs for a second";
    }
    static void pause() { std::this_thread::sleep_for(130ms); }

    FakeInterface interface;
    SessionSetup setup;
    Session session{setup};
    AudioOutput output{session, fakeDrivers({&interface})};
    std::vector<CollisionEvent> log;
};

TEST(Pause, WhatComesMeanwhileIsRefusedCountedAndNeverFelt) {
    Paused rig;
    float most = 0.0f;
    rig.withoutPause([&] { rig.strikeAccepted(Paused::tone(0.05)), most = rig.play(0.3); });
    EXPECT_GT(most, 0.05f) << "one alone is felt";
    const auto before = rig.session.pulse().dropped();
    Paused::pause();
    for (int k = 0; k < 20; ++k)
        EXPECT_EQ(rig.strike(Paused::tone(0.05), k % 2 == 0).error, DevicePulse::droppedError);
    EXPECT_EQ(rig.session.pulse().dropped(), before + 20);
    EXPECT_FALSE(rig.output.isPlaying());
    EXPECT_TRUE(rig.session.submit({RenderControl{.kind = RenderControl::Kind::gain, .value = 2.0f}}))
        << "state is taken all the time";
    EXPECT_TRUE(rig.session.submit({Stop{}, Input::now}));
    EXPECT_EQ(rig.play(0.5), 0.0f);
}

TEST(Pause, WhatWasToActAtOnceIsDroppedAndWhatWasPlannedPlaysOn) {
    Paused rig;
    auto before = rig.session.pulse().dropped();
    bool areTaken = false;
    for (; !areTaken; before = rig.session.pulse().dropped()) {
        rig.play(0.3);
        areTaken = true;
        for (int k = 0; k < 20; ++k) areTaken = rig.strike(Paused::tone(0.05), k % 2 == 0) && areTaken;
    }
    Paused::pause();
    EXPECT_EQ(rig.play(0.2), 0.0f);
    EXPECT_GE(rig.session.pulse().dropped(), before + 20);
    for (const bool canBeStopped : {false, true}) {
        float most = 0.0f; // another pause at the event's own moment drops it: once more
        for (int tries = 0; most == 0.0f && tries < 20; ++tries) {
            rig.strikeAccepted(Paused::tone(0.05, 1.0), canBeStopped);
            Paused::pause();
            EXPECT_EQ(rig.play(0.5), 0.0f);
            most = rig.play(1.0);
        }
        EXPECT_GT(most, 0.05f) << "a list plays on after a hiccup";
    }
}

TEST(Pause, OfADeviceThatWasGoneWhatWasPlannedIsDroppedAndAHeldToneGoesOn) {
    Paused rig;
    rig.play(0.3);
    float alone = 0.0f;
    do rig.strikeAccepted(Paused::tone(60.0));
    while ((alone = rig.play(0.3)) < 0.05f); // it sounds
    for (int k = 0; k < 10; ++k) {
        rig.strikeAccepted(Paused::tone(0.05, 1.0 + 0.1 * k));       // the rest of a stimulus
        rig.strikeAccepted(Paused::tone(0.05, 1.0 + 0.1 * k), true); // a pattern, which could be stopped
    }
    const auto before = rig.session.pulse().dropped();
    std::this_thread::sleep_for(2100ms);
    const float after = rig.play(3.0);
    EXPECT_GT(after, 0.05f) << "a note that is held is state";
    EXPECT_LT(after, 1.05f * alone) << "and nothing is added to it";
    EXPECT_EQ(rig.session.pulse().dropped(), before + 20);
}

TEST(Pause, ADeviceJustChosenIsNotSaidToStandStill) {
    Paused rig;
    rig.play(0.3);
    ASSERT_EQ(rig.output.open({"hands", {}, 0, 0, 1.0f}), "");
    Paused::pause();
    EXPECT_FALSE(rig.output.isPlaying());
    const auto now = AudioOutput::Clock::now();
    EXPECT_EQ(rig.output.maintain(now), "");
    EXPECT_NE(rig.output.maintain(now + 1500ms).find("time stands still"), std::string::npos);
}

TEST(Pause, AFloodThatOverfillsTheQueueIsDroppedToo) {
    Paused rig;
    rig.play(0.3);
    std::vector<CollisionEvent> flood(30'000, Paused::tone(0.01));
    while (!rig.session.submit({Strikes{flood}})) rig.play(0.002);
    rig.session.advance();
    Paused::pause();
    rig.session.advance();
    rig.play(0.05);
    EXPECT_EQ(rig.play(1.0), 0.0f);
}

TEST(Pause, AWorldStandsStillAndNoCollisionIsMissing) {
    auto setup = shakeTheBoxSetup(0.02);
    Paused rig{setup};
    for (int k = 0; k < 5; ++k) {
        rig.play(0.7);
        Paused::pause();
    }
    rig.play(0.5);
    ASSERT_GT(rig.log.size(), 10u);
    SessionLog made;
    rig.session.readLog(made);
    EXPECT_TRUE(rig.log == simulateRuns(made.runs, setup.run(), rig.log.back().timeNs + 1).events);
    EXPECT_EQ(rig.session.pulse().dropped(), 0u);
}

TEST(Pause, APauseOfADeviceThatDiscardsItAllDropsNothing) {
    Paused rig;
    rig.output.close();
    rig.interface.isReal = false;
    ASSERT_EQ(rig.output.open({"hands", {}, 0, 0, 1.0f}), "");
    rig.play(0.1);
    const auto before = rig.session.pulse().dropped();
    Paused::pause();
    EXPECT_TRUE(rig.strike(Paused::tone(0.05)));
    EXPECT_GT(rig.play(0.3), 0.05f);
    EXPECT_EQ(rig.session.pulse().dropped(), before);
}

TEST(Pause, ADeviceThatIsGoneIsToldAndSoIsWhatWasDropped) {
    FakeInterface interface;
    interface.isReal = true;
    Rig rig{{.setup = Paused::quiet(), .output = {"hands"}, .hasOwnThread = false},
            fakeDrivers({&interface})};
    ASSERT_EQ(rig.open(), "");
    rig.start();
    for (int k = 0; k < 10; ++k) rig.step(), interface.play(64);
    interface.unplug(true);
    Paused::pause();
    const CollisionEvent tone = Paused::tone(0.05);
    for (int k = 0; k < 3; ++k) EXPECT_FALSE(rig.session().submit({Strikes{{&tone, 1}}}));
    rig.maintain();
    EXPECT_EQ(rig.errorText(),
              "Fake:hands has stopped; it is looked for every second, and time stands still; "
              "3 events were lost, as no device ran");
    rig.maintain();
    EXPECT_EQ(rig.errorText(), "Fake:hands has stopped; it is looked for every second, and time stands still")
        << "told once";
    rig.close();
}

} // namespace physvib::pause_test
