// SPDX-License-Identifier: GPL-3.0-or-later
// Silence over all that a device plays and every state in which it may be, and routings that were refused: in
// virtual time, to the sample.
#include "FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Session/FakeHost.h"
#include <functional>
#include <gtest/gtest.h>

namespace physvib::silent_outputs_test {

using namespace test;

constexpr int frames = 64;
constexpr std::int64_t ms = 1'000'000;

/// Four actuators on outputs 0 to 3, noise on 5, contact sounds on 6.
struct Played {
    explicit Played(bool isLimited = true)
        : session{[isLimited] {
            SessionSetup setup = shakeTheBoxSetup(0.02);
            setup.contactSound.emplace();
            setup.limiterEnabled = isLimited;
            return setup;
        }()} {
        AudioOutputSettings settings{"hands", {}, 0, 0, 1.0f};
        settings.listening.noise = {5};
        settings.listening.contacts = {6};
        settings.opensAll = true;
        EXPECT_EQ(output.open(settings), "");
    }
    Signals play(int blocks) {
        return playBlocks(session, interface, blocks, frames, [](const CollisionEvent&) {});
    }
    void submit(CollisionEvent event) { EXPECT_EQ(session.submit({Strikes{{&event, 1}}}).error, ""); }
    FakeInterface interface;
    Session session;
    std::atomic<bool> interrupt{false};
    AudioOutput output{session, fakeDrivers({&interface}), &interrupt};
};

CollisionEvent tone(bool isMoving, double frequencyHz = 180.0) {
    CollisionEvent event{
        .frequencyHz = frequencyHz, .amplitude = 0.5, .x = 1.0, .y = 1.0, .durationNs = 60'000 * ms};
    if (isMoving) event.course = {3.0, 1.0, event.durationNs, 0};
    return event;
}

TEST(SilentOutputs, AreSilentWithinABlockFromEveryState) {
    struct Way {
        const char* name;
        std::function<void(Played&)> silence;
        bool isForEars;
    };
    const std::vector<Way> ways{{"silence", [](Played& p) { p.output.setSilent(true); }, true},
                                {"an interrupt", [](Played& p) { p.interrupt = true; }, true},
                                {"level zero", [](Played& p) { p.output.setLevel(0.0f); }, false}};
    struct State {
        const char* name;
        std::function<void(Played&)> begin;
    };
    const std::vector<State> states{{"the world alone", [](Played& p) { p.play(500); }},
                                    {"a tone", [](Played& p) { p.submit(tone(false)), p.play(80); }},
                                    {"what moves", [](Played& p) { p.submit(tone(true)), p.play(80); }},
                                    {"many tones",
                                     [](Played& p) {
                                         for (int i = 0; i < 40; ++i)
                                             p.submit(tone(i % 2 == 0, 60.0 + 10.0 * i));
                                         p.play(80);
                                     }},
                                    {"the first block", [](Played& p) { p.submit(tone(false)), p.play(1); }},
                                    {"a fade that goes on", [](Played& p) {
                                         p.submit(tone(false)), p.play(80);
                                         EXPECT_EQ(p.output.assign({3, 2, 1, 0}, 0), "");
                                         p.play(1);
                                     }}};
    for (const State& state : states)
        for (const Way& way : ways) {
            Played played;
            state.begin(played);
            way.silence(played);
            played.play(way.isForEars ? 1 : 8); // the level moves in a ramp of 5 ms
            const Signals out = played.play(60);
            for (std::size_t k = 0; k < out.size(); ++k)
                EXPECT_TRUE((k >= 5 && !way.isForEars) || peakOf(out[k]) == 0.0f)
                    << state.name << ", " << way.name << ", output " << k;
        }
}

TEST(RefusedRoutings, LeaveWhatIsPlayedWhereItWas) {
    Played played, undisturbed;
    for (Played* p : {&played, &undisturbed}) p->submit(tone(false)), p->play(300);
    EXPECT_NE(played.output.setListening({.noise = {2}}), "");
    EXPECT_NE(played.output.setListening({.noise = {5}, .marks = {7}}), "") << "the session makes none";
    EXPECT_NE(played.output.assign({0, 1, 2, 5}, 0), "") << "an actuator on the noise";
    EXPECT_NE(played.output.assign({0, 1, 2, 2}, 0), "");
    const Signals out = played.play(100), expected = undisturbed.play(100);
    ASSERT_EQ(out.size(), expected.size());
    for (std::size_t k = 0; k < out.size(); ++k) EXPECT_EQ(out[k], expected[k]) << "output " << k;
    EXPECT_EQ(played.output.assign({3, 2, 1, 0}, 0), "") << "what is allowed is taken as before";
    EXPECT_EQ(played.output.maintain(AudioOutput::Clock::now()), "");
    EXPECT_EQ(played.output.assign({0, 1, 2, 17}, 0), "");
    EXPECT_NE(played.output.maintain(AudioOutput::Clock::now()).find("1 of 4 actuators have no output"),
              std::string::npos);
}

/// Also when the device goes and comes back.
TEST(RefusedRoutings, AreNotPlayedWhenTheDeviceIsOpenedAnew) {
    Played played;
    EXPECT_NE(played.output.setListening({.noise = {4}, .marks = {7}}), "") << "the session makes none";
    played.interface.unplug(true);
    auto now = AudioOutput::Clock::now();
    using namespace std::chrono_literals;
    EXPECT_NE(played.output.maintain(now += 1s), "");
    played.interface.isPlugged = true;
    for (int i = 0; i < 3; ++i) played.output.maintain(now += 2s);
    ASSERT_TRUE(played.output.status().isRunning);
    const Signals out = played.play(300);
    EXPECT_EQ(peakOf(out[4]), 0.0f);
    EXPECT_GT(peakOf(out[5]), 0.0f) << "the noise is where it was";
}

TEST(Levels, BoundWhatLeavesWhateverComes) {
    for (const bool isLimited : {true, false})
        for (const float level : {1.0f, 0.25f}) {
            Played played{isLimited};
            played.output.setLevel(level);
            std::vector<CollisionEvent> loud(400, tone(false, 100.0));
            for (CollisionEvent& event : loud) event.amplitude = 1.0;
            EXPECT_EQ(played.session.submit({Strikes{loud}}).error, "");
            played.play(300);
            const Signals out = played.play(300);
            const float most = peakOf(Signals{out.begin(), out.begin() + 4});
            EXPECT_LE(most, level * 1.0001f) << isLimited << ' ' << level;
            EXPECT_GT(most, 0.8f * level) << isLimited << ' ' << level;
        }
}

/// A coil is never held at what is nearly direct current, however it came about.
TEST(Levels, NearlyDirectCurrentIsTurnedDownAtTheDevice) {
    Played played{false};
    CollisionEvent slow = tone(false, 1.0); // as slow as a tone may be
    slow.frequencyHz = limits::slowestToneHz;
    slow.amplitude = 1.0;
    for (int i = 0; i < 8; ++i) played.submit(slow);
    played.play(3000);
    EXPECT_GT(played.output.status().guardEpisodes, 0U);
    EXPECT_LT(played.output.status().guardGain, 1.0f);
}

} // namespace physvib::silent_outputs_test
