// SPDX-License-Identifier: GPL-3.0-or-later
// AudioOutput on interfaces that vanish, change and misbehave: no other device, no loud moment, no event
// missing.
#include "Live/Devices/AudioOutput.h"
#include "FakeAudioDevice.h"
#include "Scene/World/Simulation.h"
#include "Session/FakeHost.h"
#include <cmath>
#include <gtest/gtest.h>
#include <thread>

namespace physvib::audio_output_test {

using namespace test;
using namespace std::chrono_literals;

constexpr int hands = 8; // enchanters of these sessions

// A preset, or "circle8".
PhantomPanner pannerOn(const std::string& layout, const Scene& scene) {
    ActuatorLayout places{1, 1, hands, {}};
    for (std::size_t j = 0; j < hands; ++j)
        places.places[j] = {0.5 + 0.5 * std::cos(0.8 * double(j)), 0.5 + 0.5 * std::sin(0.8 * double(j))};
    if (layout != "circle8") layoutPreset(layout, places);
    return {places, PanningLaw::linear, 1, scene.fieldWidthMetres, scene.fieldHeightMetres};
}

SessionSetup eightHands() {
    auto s = shakeTheBoxSetup(0.02);
    s.channels = hands;
    return s;
}

/// A session on fake interfaces, its driver, and its log. The interface's thread is the test's.
struct Rig {
    explicit Rig(const SessionSetup& wanted = eightHands())
        : setup{wanted} {
        speakers.name = "speakers";
    }
    std::string open(std::vector<int> map = {}, float level = 1.0f) {
        return output.open({"hands", std::move(map), 0, 0, level});
    }

    /// Blocks of `frames`, `seconds` long; what came out, per connected output.
    Signals play(double seconds, int frames) {
        const int blocks = (static_cast<int>(seconds * interface.rate) + frames - 1) / frames;
        return playBlocks(session, interface, blocks, frames,
                          [this](const CollisionEvent& e) { log.push_back(e); });
    }
    void expectTheLogIsWhole() {
        ASSERT_GT(log.size(), 10u);
        session.readLog(made);
        EXPECT_TRUE(log == simulateRuns(made.runs, setup.run(), log.back().timeNs + 1).events);
        EXPECT_EQ(session.status().render.unsent + session.status().render.rejected + session.world().drops(),
                  0u);
    }

    FakeInterface interface, speakers;
    SessionSetup setup;
    Session session{setup};
    std::atomic<bool> interrupt{false};
    AudioOutput output{session, fakeDrivers({&speakers, &interface}), &interrupt};
    std::vector<CollisionEvent> log;
    SessionLog made;
};

struct OpenRig : Rig {
    explicit OpenRig(float level = 1.0f, const SessionSetup& wanted = eightHands())
        : Rig{wanted} {
        EXPECT_EQ(open({}, level), "");
    }
};

TEST(AudioOutput, OpensTheDeviceThatIsNamedAndNoOther) {
    Rig rig;
    EXPECT_EQ(rig.output.open({"feet"}),
              "feet: no such device (see physvib devices); nothing else is played on");
    EXPECT_EQ(rig.output.open({"Other:hands"}).substr(0, 11), "Other:hands");
    EXPECT_EQ(rig.interface.timesOpened + rig.speakers.timesOpened, 0);
    EXPECT_EQ(rig.output.open({"Fake:hands"}), "");
    EXPECT_EQ(rig.interface.timesOpened, 1);
    EXPECT_EQ(rig.speakers.timesOpened, 0);
}

TEST(AudioOutput, APicoIsFoundByItsShortNameAndItsOwnLatencyIsTold) {
    Rig rig;
    EXPECT_EQ(rig.output.open({"pico"}).substr(0, 20), "pico: no such device");
    rig.speakers.name = "PhysVib pico8, USB Audio; Rear output / input";
    rig.interface.name = "PhysVib pico8, USB Audio; Direct hardware device without any conversions";
    EXPECT_EQ(rig.output.open({"pico"}), "");
    EXPECT_EQ(rig.interface.timesOpened, 1) << "the card itself, not a part of it";
    EXPECT_EQ(rig.output.deviceLatencyFrames(), rig.interface.block + 134) << "2.8 ms at 48 kHz";
    const auto drivers = fakeDrivers({&rig.interface, &rig.speakers});
    EXPECT_EQ(picoLayoutPreset(drivers, "pico"), "pico8");
    EXPECT_EQ(picoLayoutPreset(drivers, "ALSA:PhysVib pico4, USB Audio; Direct hardware device"), "pico4");
    EXPECT_EQ(picoLayoutPreset(drivers, "hands"), "") << "a device that is none keeps its layout";
    rig.speakers.name = "pico";
    EXPECT_EQ(rig.output.open({"pico"}), "");
    EXPECT_EQ(rig.speakers.timesOpened, 1) << "a device that has the name goes first";
}

TEST(AudioOutput, ALentSessionIsPlayedFromItsBeginningAndTheOwnOneGoesOnAfterIt) {
    Rig rig;
    const auto setup = shakeTheBoxSetup(0.02); // of fewer channels
    Session lent{setup}, alone{setup};
    EXPECT_FALSE(rig.output.playInstead(&lent)) << "no device has run yet";
    ASSERT_EQ(rig.open(), "");
    rig.play(1.5, 64);
    const auto before = rig.session.timeline().framesRendered();
    ASSERT_TRUE(rig.output.playInstead(&lent));
    alone.prepare(48000, 64);
    Signals wanted(static_cast<std::size_t>(setup.channels), std::vector<float>(64));
    std::vector<float*> at;
    for (auto& channel : wanted) at.push_back(channel.data());
    float most = 0.0f;
    for (int block = 0; block < 3000; ++block) {
        lent.advance();
        alone.advance();
        alone.render(at.data(), 64, RenderMode::realtime);
        const auto played = rig.interface.play(64);
        for (std::size_t j = 0; j < wanted.size(); ++j)
            ASSERT_EQ(played[j], wanted[j]) << "block " << block << ", channel " << j;
        for (std::size_t j = wanted.size(); j < played.size(); ++j)
            ASSERT_EQ(peakOf(played[j]), 0.0f) << "of the one that is lent there is none";
        most = std::max(most, peakOf(played));
    }
    EXPECT_GT(most, 0.01f);
    EXPECT_EQ(rig.session.timeline().framesRendered(), before) << "it stands still";
    ASSERT_TRUE(rig.output.playInstead(nullptr));
    rig.play(1.5, 64);
    EXPECT_GT(rig.session.timeline().framesRendered(), before);
    rig.expectTheLogIsWhole();
}

TEST(AudioOutput, AfterALentSessionTheOwnOneGoesOnAtTheRateThatTheDeviceHasByThen) {
    OpenRig rig;
    rig.play(1.5, 64);
    Session first{shakeTheBoxSetup(0.02)}, second{shakeTheBoxSetup(0.02)};
    const std::int64_t before = rig.session.timeline().presentNs();
    for (const auto& [lent, rate] : {std::pair{&first, 96000}, {&second, 32000}}) {
        ASSERT_TRUE(rig.output.playInstead(lent));
        rig.interface.play(64);
        rig.interface.rate = rate;
        EXPECT_NE(rig.output.maintain(), "");
        EXPECT_EQ(lent->timeline().sampleRateHz(), rate);
        EXPECT_EQ(rig.session.timeline().sampleRateHz(), 48000) << "it stands still";
    }
    ASSERT_TRUE(rig.output.playInstead(nullptr));
    EXPECT_EQ(rig.session.timeline().sampleRateHz(), 32000);
    EXPECT_NEAR(static_cast<double>(rig.session.timeline().presentNs() - before), 0.0, 1e9 / 32000);
    rig.play(1.5, 64);
    EXPECT_GT(rig.session.timeline().presentNs(), before + 1'400'000'000);
    rig.expectTheLogIsWhole();
}

TEST(AudioOutput, SumsUpWhatLeavesForTheHands) {
    OpenRig rig{0.5f};
    rig.play(0.1, 64);
    const auto before = rig.output.exposure().weighted;
    rig.play(2.0, 64);
    const ExposureSums sums = rig.output.exposure();
    double felt = 0.0;
    for (std::size_t k = 0; k < hands; ++k) felt += sums.weighted[k] - before[k];
    EXPECT_GT(felt, 0.0);
    rig.output.setSilent(true);
    rig.play(0.5, 64); // filters ring out
    const ExposureSums silent = rig.output.exposure();
    rig.play(0.5, 64);
    EXPECT_EQ(rig.output.exposure().weighted, silent.weighted) << "what is silenced counts nothing";
}

TEST(AudioOutput, SwitchesAMotorAsTheConverterSays) {
    Rig plain, motor;
    ASSERT_EQ(plain.open(), "");
    AudioOutputSettings settings{"hands", {}, 0, 0, 1.0f};
    settings.onOffActuators = {2};
    settings.onOffThreshold = 0.01;
    ASSERT_EQ(motor.output.open(settings), "");
    const auto all = plain.play(3.0, 64), switched = motor.play(3.0, 64);
    OnOffSteps steps(static_cast<int>(plain.interface.rate), settings.onOffThreshold);
    std::size_t on = 0, others = 0, expected = 0;
    for (std::size_t n = static_cast<std::size_t>(plain.interface.rate / 100); n < all[2].size(); ++n)
        on += switched[2][n] == 1.0f, others += switched[2][n] != 0.0f && switched[2][n] != 1.0f;
    EXPECT_EQ(others, 0u);
    for (const float sample : all[2]) steps.add(sample, [](long long, bool) {}), expected += steps.isOn();
    EXPECT_GT(expected, 0u);
    EXPECT_NEAR(static_cast<double>(on), static_cast<double>(expected),
                0.01 * static_cast<double>(plain.interface.rate))
        << "the first samples come up in a ramp";
    EXPECT_EQ(switched[0], all[0]) << "the others are what they were";
}

TEST(AudioOutput, AConverterGetsWhatActuatorsGetUntilItHasEnough) {
    struct Kept final : VibrationConverter {
        bool convert(const float* const* channels, int frames) override {
            return third.insert(third.end(), channels[2], channels[2] + frames), third.size() < 96000;
        }
        std::vector<float> third;
    } kept;
    Rig rig;
    EXPECT_EQ(rig.output.open({.device = "hands", .level = 0.5f, .converter = &kept}), "");
    const auto felt = rig.play(3.0, 64)[2];
    EXPECT_TRUE(std::equal(kept.third.begin(), kept.third.end(), felt.begin()));
    EXPECT_GT(peakOf(felt), 0.01f);
}

TEST(AudioOutput, AnotherDriverWithADeviceOfThatNameIsAnotherDevice) {
    FakeInterface ours, theirs;
    Session session{eightHands()};
    AudioOutput output{session, [&] {
                           auto drivers = fakeDrivers({&ours}, "Ours")();
                           drivers.push_back(std::move(fakeDrivers({&theirs}, "Mine")().front()));
                           return drivers;
                       }};
    ASSERT_EQ(output.open({"hands"}), "");
    ours.unplug(true);
    EXPECT_NE(output.maintain(), "");
    EXPECT_EQ(theirs.timesOpened, 0);
}

TEST(AudioOutput, WhatRingsFadesBeforeADeviceIsClosedAndOneThatIsGoneIsNotWaitedFor) {
    Rig rig;
    rig.interface.block = 6400; // announced: so a close waits as long as it may
    ASSERT_EQ(rig.open(), "");
    rig.play(0.1, 64);
    constexpr std::size_t corner = 2; // at 0, 0
    const CollisionEvent tone{.frequencyHz = 50, .amplitude = 0.5, .durationNs = 60'000'000'000};
    ASSERT_TRUE(rig.session.submit({Strikes{{&tone, 1}}}));
    EXPECT_GT(peakOf(rig.play(1.0, 64)[corner]), 0.01f);
    std::vector<float> heard;
    rig.interface.whenAsked = [&] {
        rig.session.advance();
        const auto block = rig.interface.play(64);
        if (!block.empty()) heard.insert(heard.end(), block[corner].begin(), block[corner].end());
    };
    rig.output.close();
    rig.interface.whenAsked = {};
    ASSERT_GE(heard.size(), 64u);
    EXPECT_GT(peakOf(std::vector(heard.begin(), heard.begin() + 32)), 0.001f);
    EXPECT_EQ(heard.back(), 0.0f);

    ASSERT_EQ(rig.open(), "");
    rig.play(0.1, 64);
    rig.output.close(); // comes back, although nobody calls
}

TEST(AudioOutput, ALostDeviceMeansSilenceAMessageAndNoOtherDeviceAndNothingMissingAfterwards) {
    for (const bool tells : {true, false}) {
        OpenRig rig;
        rig.play(3.0, 64);
        rig.interface.unplug(tells);
        if (tells) EXPECT_EQ(peakOf(rig.interface.play(64)), 0.0f) << "after an error";
        auto now = AudioOutput::Clock::now();
        rig.output.maintain(now); // whoever says nothing is found out by his silence
        const std::string gone =
            "Fake:hands has stopped; it is looked for every second, and time stands still";
        for (int second = 0; second < 3; ++second) rig.output.maintain(now += 1s);
        EXPECT_EQ(rig.output.maintain(now += 1s), gone);
        EXPECT_FALSE(rig.output.status().isRunning);
        EXPECT_EQ(rig.session.advance(), 0) << "without a device time stands still";
        rig.interface.isPlugged = true;
        rig.interface.opens = false;
        EXPECT_EQ(rig.output.maintain(now += 1s), "Fake:hands: busy");
        rig.interface.opens = true;
        EXPECT_EQ(rig.output.maintain(now += 1s), "");
        EXPECT_EQ(rig.output.status().losses, 1);
        rig.play(3.0, 64);
        EXPECT_EQ(rig.speakers.timesOpened, 0);
        EXPECT_EQ(rig.session.status().render.late, 0u);
        rig.expectTheLogIsWhole();
    }
}

TEST(AudioOutput, ADeviceThatWasNeverConnectedIsOpenedAgainAndOneThatSomebodyDisconnectedIsNot) {
    Rig rig;
    const std::vector<int> all{0, 1, 2, 3, 4, 5, 6, 7};
    rig.interface.unconnected = all;
    ASSERT_EQ(rig.open(), "");
    auto now = AudioOutput::Clock::now();
    for (int k = 0; k < 5 && rig.interface.timesOpened == 1; ++k) rig.output.maintain(now += 1s);
    EXPECT_EQ(rig.interface.timesOpened, 2);
    rig.interface.unconnected.clear();
    rig.output.maintain(now += 1s);
    rig.interface.unconnected = all;
    for (int second = 0; second < 10; ++second) rig.output.maintain(now += 1s);
    EXPECT_EQ(rig.interface.timesOpened, 2);
}

TEST(AudioOutput, RateBlockAndLayoutChangeWhilePlayingAndNoCeilingIsPassed) {
    auto setup = eightHands();
    for (std::size_t j = 0; j < hands; ++j) setup.ceilings[j] = 0.02f + 0.01f * static_cast<float>(j);
    for (const bool limits : {true, false}) {
        setup.limiterEnabled = limits;
        Rig rig{setup};
        std::array<float, hands> most{};
        for (const auto& [rate, block, layout] : {std::tuple{44100.0, 32, "phone1"},
                                                  {96000.0, 2048, "phone4"},
                                                  {48000.0, 512, "circle8"},
                                                  {44100.0, 2048, "phone2"},
                                                  {192000.0, 32, "phone4"}}) {
            rig.interface.unplug(true);
            rig.interface.isPlugged = true;
            rig.interface.rate = rate;
            rig.interface.block = block;
            ASSERT_EQ(rig.output.status().blocks == 0 ? rig.open() : rig.output.maintain(), "");
            EXPECT_EQ(rig.output.sampleRateHz(), static_cast<int>(rate));
            const PhantomPanner panner = pannerOn(layout, setup.scene);
            EXPECT_TRUE(
                rig.session.submit({RenderControl{.kind = RenderControl::Kind::panner, .panner = &panner}}));
            const auto out = rig.play(4.0, block);
            for (std::size_t k = 0; k < hands; ++k) most[k] = std::max(most[k], peakOf(out[k]));
        }
        for (std::size_t k = 0; k < hands; ++k) EXPECT_LE(most[k], setup.ceilings[k]) << k;
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_GT(most[k], 0.9f * setup.ceilings[k]) << "loud enough for a test";
        for (std::size_t k = 4; k < hands; ++k) EXPECT_GT(most[k], 0.01f) << "played at all";
        EXPECT_LT(rig.session.world().stalledNs(), 50'000'000)
            << "a longer block is no stall; a change that makes L shorter is one";
        EXPECT_LT(rig.session.status().render.late, 10u) << "the same";
        rig.expectTheLogIsWhole();
    }
}

TEST(AudioOutput, WithTheLimiterNothingIsLeftToClip) {
    auto setup = eightHands();
    setup.ceilings.fill(0.05f);
    OpenRig rig{1.0f, setup};
    Session bare{setup};
    bare.prepare(hostRate, 64);
    Signals samples(hands, std::vector<float>(64));
    std::vector<float*> at;
    for (auto& channel : samples) at.push_back(channel.data());
    rig.play(0.1, 64);
    for (int i = 0; i < 75; ++i) {
        bare.advance();
        bare.render(at.data(), 64, RenderMode::realtime);
    }
    float most = 0;
    for (int i = 0; i < 6000; ++i) { // 8 s
        bare.advance();
        bare.render(at.data(), 64, RenderMode::realtime);
        ASSERT_TRUE(rig.play(64.0 / hostRate, 64) == samples) << i;
        most = std::max(most, peakOf(samples[0]));
    }
    EXPECT_LE(most, 0.05f);
    EXPECT_GT(most, 0.045f) << "loud enough for a test";
}

TEST(AudioOutput, BlocksNeverAnnouncedAreCutInPartsAndThenCoveredByL) {
    OpenRig rig;
    const auto L = rig.session.timeline().outputLatencyFrames();
    EXPECT_NE(rig.play(0.1, 20'000), Signals{});
    EXPECT_EQ(rig.output.maintain(), "");
    EXPECT_EQ(rig.session.timeline().outputLatencyFrames(), L + limits::maxBlockFrames - 64);
    rig.play(10.0, 8192);
    EXPECT_EQ(rig.output.maintain(), "");
    EXPECT_EQ(rig.session.status().render.late, 0u);
    EXPECT_EQ(rig.interface.timesOpened, 1);
    EXPECT_EQ(rig.interface.timesStarted, 2) << "longer blocks than the longest change nothing more";
    rig.expectTheLogIsWhole();
}

TEST(AudioOutput, OutputsThatAreMissingAreToldAndTheOthersPlayAsEver) {
    Rig rig;
    OpenRig whole;
    rig.interface.outputs = 2;
    ASSERT_EQ(rig.open(), "");
    EXPECT_EQ(rig.output.maintain(), "Fake:hands: 6 of 8 actuators have no output there");
    EXPECT_EQ(whole.output.maintain(), "");
    const auto few = rig.play(8.0, 64), all = whole.play(8.0, 64);
    ASSERT_EQ(few.size(), 2u);
    EXPECT_GT(peakOf(few[0]), 0.01f);
    EXPECT_TRUE(few[0] == all[0] && few[1] == all[1]);
    whole.interface.withheld = 7; // says that eight are active, gives one
    EXPECT_EQ(whole.play(1.0, 64).size(), 1u);
}

TEST(AudioOutput, EnchantersGoWhereTheMapSaysThoughUnconnectedOutputsAreLeftOut) {
    Rig rig, plain;
    rig.interface.unconnected = {1, 6};
    ASSERT_EQ(rig.open({7, 1, 3, 2}), ""); // enchanter 1 on output 8, ... ; outputs 2 and 7 are not connected
    ASSERT_EQ(plain.open(), "");
    EXPECT_EQ(rig.interface.opened, (ChannelSet{1, 2, 3, 7})) << "no output is opened that nobody wants";
    EXPECT_EQ(rig.output.maintain(), "Fake:hands: 5 of 8 actuators have no output there");
    const auto mapped = rig.play(8.0, 64), all = plain.play(8.0, 64);
    ASSERT_EQ(mapped.size(), 3u); // outputs 3, 4, 8
    EXPECT_TRUE(mapped[0] == all[3] && mapped[1] == all[2] && mapped[2] == all[0]);
    EXPECT_GT(peakOf(all[0]), 0.01f);
}

TEST(AudioOutput, AnActuatorThatWasToldToPlayNowhereIsNotMissed) {
    Rig rig;
    rig.interface.outputs = 2;
    ASSERT_EQ(rig.open({0, -1, -1, 1, -1, -1, -1, -1}), "");
    EXPECT_EQ(rig.output.maintain(), "");
}

TEST(AudioOutput, TwoEnchantersOnOneOutputAreRefused) {
    Rig rig;
    EXPECT_EQ(rig.open({0, 2, 2}), "output 3 is given to two actuators; expected one each");
    EXPECT_EQ(rig.open({100}), "hands: has none of the outputs that are wanted");
    EXPECT_FALSE(rig.output.status().isRunning);
}

TEST(AudioOutput, RatesOutsideTheLimitsStaySilentAndAreTold) {
    Rig rig;
    rig.interface.rate = 384000;
    EXPECT_EQ(rig.open(), "hands: runs at 384000 Hz; expected 5000 to 192000");
    EXPECT_TRUE(rig.interface.play(64).empty());
}

// Plays both until something is well felt: what follows shows every error of a ramp.
void playUntilLoud(Rig& a, Rig& b) {
    for (int i = 0; i < 10'000; ++i) {
        a.play(64.0 / hostRate, 64);
        if (peakOf(b.play(64.0 / hostRate, 64)[0]) > 0.1f) return;
    }
    FAIL() << "never loud";
}

/// What comes next is what comes of the other, but for a ramp of 5 ms up to that level.
void expectARamp(Rig& rig, Rig& steady, double seconds, int block, float level) {
    const auto out = rig.play(seconds, block), expected = steady.play(seconds, block);
    for (std::size_t n = 0; n < out[0].size(); ++n)
        EXPECT_NEAR(out[0][n],
                    expected[0][n] * std::min(level, static_cast<float>(n + 1) / (0.005f * hostRate)), 1e-6f)
            << n;
}

TEST(AudioOutput, ADeviceThatComesBackIsFadedInWithinFiveMilliseconds) {
    OpenRig rig{0.5f}, steady;
    playUntilLoud(rig, steady);
    rig.interface.unplug(true);
    rig.interface.isPlugged = true;
    ASSERT_EQ(rig.output.maintain(), "");
    expectARamp(rig, steady, 0.05, 64, 0.5f);
}

TEST(AudioOutput, TheSilenceSwitchActsWithinABlockAndComesBackInARamp) {
    for (const int block : {1, 32, 2048}) {
        OpenRig rig, steady;
        playUntilLoud(rig, steady);
        rig.output.setSilent(true);
        const auto last = rig.play(1.0 / hostRate, block);
        EXPECT_EQ(last[0].back(), 0.0f) << block;
        EXPECT_GT(peakOf(steady.play(1.0 / hostRate, block)[0]), 0.01f);
        EXPECT_EQ(peakOf(rig.play(0.1, block)), 0.0f) << block;
        steady.play(0.1, block);
        rig.output.setSilent(false);
        expectARamp(rig, steady, 0.1, block, 1.0f);
    }
}

TEST(AudioOutput, SilenceIsLiftedByWhoAskedOrAtTheMachine) {
    OpenRig rig, steady;
    MuteRequests& silence = rig.output.silence();
    const auto lift = [&silence](MuteRequester holder) {
        silence.withdraw(holder, silence.requestCount(holder));
    };
    const auto expect = [&](bool isFelt, const char* why) {
        playUntilLoud(rig, steady);
        EXPECT_EQ(peakOf(rig.play(0.1, 64)[0]) > 0.0f, isFelt) << why;
        steady.play(0.1, 64);
    };
    silence.request(MuteRequester::standardInput);
    silence.request(MuteRequester::osc);
    lift(MuteRequester::osc);
    expect(false, "OSC lifts nothing of standard input's");
    lift(MuteRequester::standardInput);
    expect(true, "who asked has lifted it");
    rig.output.setSilent(true);
    lift(MuteRequester::osc);
    lift(MuteRequester::standardInput);
    expect(false, "what a person has asked for is lifted at the machine alone");
    silence.request(MuteRequester::osc);
    rig.output.setSilent(false);
    expect(true, "the machine lifts all");
}

TEST(AudioOutput, ASignalIsSilenceBeforeAnythingEnds) {
    for (const int block : {64, 2048}) {
        OpenRig rig, steady;
        playUntilLoud(rig, steady);
        rig.interrupt = true; // by another thread, in the middle of whatever M does
        EXPECT_TRUE(rig.output.isSilent()) << "for the board beside it";
        EXPECT_EQ(rig.play(1.0 / hostRate, block)[0].back(), 0.0f) << block;
        EXPECT_EQ(peakOf(rig.play(0.1, block)), 0.0f) << block;
        rig.output.setSilent(false);
        EXPECT_EQ(peakOf(rig.play(0.1, block)), 0.0f) << "nobody undoes it";
    }
}

TEST(AudioOutput, LevelsStartLowAndNeverExceedOne) {
    EXPECT_FLOAT_EQ(AudioOutputSettings{}.level, static_cast<float>(std::pow(10.0, defaultLevelDb / 20.0)));
    OpenRig rig, loud{40.0f};
    EXPECT_TRUE(rig.play(3.0, 64) == loud.play(3.0, 64));
    loud.output.setLevel(std::nanf(""));
    loud.play(1.0, 64);
    EXPECT_EQ(peakOf(loud.play(1.0, 64)), 0.0f);
}

// For the thread sanitizer: the interface has a thread of its own, the driver too, and M pulls the plug.
TEST(AudioOutput, PlugsArePulledWhileTheDevicePlays) {
    OpenRig rig;
    std::atomic<bool> stop{false};
    std::atomic<int> blocks{0};
    std::thread device{[&] {
        while (!stop) {
            blocks += rig.interface.play(64).empty() ? 0 : 1;
            std::this_thread::sleep_for(100us);
        }
    }};
    std::thread driver{[&] {
        while (!stop) {
            rig.session.advance();
            std::this_thread::sleep_for(1ms);
        }
    }};
    for (int i = 0; i < 30; ++i) {
        for (const int before = blocks; blocks < before + 20;) std::this_thread::sleep_for(1ms);
        rig.output.setSilent(i % 3 == 0);
        if (i % 2 == 0) {
            const std::lock_guard lock{rig.interface.mutex};
            rig.interface.unplug(true);
        }
        rig.interface.isPlugged = true;
        EXPECT_EQ(rig.output.maintain(), "");
        for (const auto& e : drain(rig.session)) rig.log.push_back(e);
    }
    stop = true;
    device.join();
    driver.join();
    EXPECT_EQ(rig.output.status().losses, 15);
    EXPECT_EQ(rig.speakers.timesOpened, 0);
}

} // namespace physvib::audio_output_test
