// SPDX-License-Identifier: GPL-3.0-or-later
// What is heard beside what is felt: on its outputs, at its level, in sync, and nowhere else.
#include "FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Session/FakeHost.h"
#include <cmath>
#include <gtest/gtest.h>

namespace physvib::listening_test {

using namespace test;

constexpr int felt = 4, blockFrames = 64;
constexpr double interfaceRate = 48000.0;

SessionSetup setupOn(const std::string& layout, bool hasContactSound) {
    auto s = shakeTheBoxSetup(0.02);
    ActuatorLayout places;
    layoutPreset(layout, places);
    s.panner = {places, PanningLaw::linear, 1, s.scene.fieldWidthMetres, s.scene.fieldHeightMetres};
    s.channels = places.count;
    if (hasContactSound) s.contactSound.emplace();
    return s;
}

struct Rig {
    explicit Rig(const SessionSetup& setup)
        : session{setup} {}
    Rig(const SessionSetup& setup, const ListeningSettings& listening)
        : Rig{setup} {
        EXPECT_EQ(open(listening), "");
    }
    std::string open(const ListeningSettings& listening) {
        AudioOutputSettings settings{"hands", {}, 0, 0, 1.0f};
        settings.listening = listening;
        return output.open(settings);
    }
    Signals play(double seconds) {
        const int blocks = (static_cast<int>(seconds * interface.rate) + blockFrames - 1) / blockFrames;
        return playBlocks(session, interface, blocks, blockFrames, [](const CollisionEvent&) {});
    }
    FakeInterface interface;
    Session session;
    AudioOutput output{session, fakeDrivers({&interface})};
};

double rmsDb(const std::vector<float>& x, std::size_t from) {
    double sum = 0.0;
    for (std::size_t n = from; n < x.size(); ++n) sum += double{x[n]} * x[n];
    return 10.0 * std::log10(sum / static_cast<double>(x.size() - from));
}

/// A hit of the strength of half.
CollisionEvent hitOf(double frequencyHz) {
    return {.frequencyHz = frequencyHz, .decayPerSecond = 50.0, .amplitude = 0.5};
}

TEST(Listening, NoiseIsThereAtItsLevelOnItsOutputsAndChangesNothingForTheHands) {
    Rig rig{setupOn("phone4", false), {.noise = {5, 6}, .noiseDb = -30.0}},
        quiet{setupOn("phone4", false), {}};
    const auto out = rig.play(8.0), hands = quiet.play(8.0);
    ASSERT_EQ(out.size(), felt + 2u) << "packed: four enchanters and two of the headphones";
    for (std::size_t j = 0; j < felt; ++j) EXPECT_EQ(out[j], hands[j]) << j;
    EXPECT_GT(peakOf(hands[0]), 0.01f);
    EXPECT_NEAR(rmsDb(out[felt], 48000), -30.0, 0.5);
    EXPECT_EQ(out[felt], out[felt + 1]) << "both ears hear the same";
    EXPECT_LT(std::abs(out[felt][10]), 0.001f) << "it fades in";
}

TEST(Listening, TheLoudestNoiseThatIsTakenStaysBelowFullScale) {
    Rig rig{setupOn("phone4", false), {.noise = {7}, .noiseDb = 0.0}}; // held at the most
    const auto out = rig.play(10.0);
    EXPECT_NEAR(rmsDb(out[felt], 96000), PinkNoise::maxDb, 0.5);
    EXPECT_LT(peakOf(out[felt]), 1.0f);
}

TEST(Listening, SilenceIsForTheEarsAsWellAndTheMasterLevelIsNot) {
    Rig rig{setupOn("phone4", true), {.noise = {5}, .noiseDb = -30.0, .contacts = {6}}};
    rig.play(3.0);
    rig.output.setLevel(0.0f);
    rig.play(0.1);
    auto out = rig.play(6.0);
    EXPECT_EQ(peakOf(out[0]), 0.0f);
    EXPECT_NEAR(rmsDb(out[felt], 0), -30.0, 0.5);
    EXPECT_GT(peakOf(out[felt + 1]), 0.0f);
    rig.output.setSilent(true);
    rig.play(blockFrames / 48000.0); // within a block
    out = rig.play(1.0);
    EXPECT_EQ(peakOf(out), 0.0f);
}

TEST(Listening, ContactSoundsAreInSyncToTheSampleWithWhatIsFelt) {
    // one enchanter gets all of each hit: the same signal in both
    Rig rig{setupOn("phone1", true), {.contacts = {3, 4}, .contactDb = -20.0}};
    const auto out = rig.play(8.0);
    ASSERT_EQ(out.size(), 3u);
    ASSERT_GT(peakOf(out[0]), 0.1f);
    for (std::size_t n = 0; n < out[0].size(); ++n) ASSERT_NEAR(out[1][n], 0.1f * out[0][n], 1e-6f) << n;
    EXPECT_EQ(out[1], out[2]);
    EXPECT_EQ(rig.session.status().refused, 0u);
}

/// First frame that is not silent.
std::size_t onsetOf(const std::vector<float>& x) {
    return static_cast<std::size_t>(std::ranges::find_if(x, [](float s) { return std::abs(s) > 1e-7f; }) -
                                    x.begin());
}

TEST(Listening, ARecordingIsHeardWhereThereIsOneFromTheFrameOfTheEnchantersOnset) {
    auto setup = setupOn("phone4", false);
    setup.contactSound = std::vector<ContactRecording>{{349.0, 48000, std::vector<float>(480, 1.0f)}};
    Rig rig{setup, {.contacts = {4}, .contactDb = -20.0}};
    rig.session.world().setSlowness(0);
    rig.play(0.5);
    CollisionEvent hit = hitOf(349.0);
    hit.timeNs = 123'456'789;
    ASSERT_TRUE(rig.session.submit({Strikes{std::array{hit}}}));
    auto out = rig.play(1.0);
    ASSERT_LT(onsetOf(out[2]), out[2].size()) << "lower left: enchanter C";
    EXPECT_EQ(onsetOf(out[felt]), onsetOf(out[2]));
    EXPECT_NEAR(peakOf(out[felt]), 0.05f, 1e-6f);
    EXPECT_EQ(out[felt][onsetOf(out[felt]) + 479], out[felt][onsetOf(out[felt])])
        << "the recording, not a sine";
    hit.frequencyHz = 80.0;
    ASSERT_TRUE(rig.session.submit({Strikes{std::array{hit}}}));
    out = rig.play(1.0);
    EXPECT_EQ(onsetOf(out[felt]), onsetOf(out[2])) << "without a recording: the mode";
    for (std::size_t n = 0; n < out[2].size(); ++n) ASSERT_NEAR(out[felt][n], 0.1f * out[2][n], 1e-6f) << n;
}

TEST(Listening, StopsWithWhatIsFelt) {
    Rig rig{setupOn("phone1", true), {.contacts = {3}, .contactDb = 0.0}};
    rig.session.world().setSlowness(0);
    rig.play(0.2);
    const CollisionEvent tone{.frequencyHz = 200.0, .amplitude = 0.5, .durationNs = 5'000'000'000};
    ASSERT_TRUE(rig.session.submit({Strikes{std::array{tone}}}));
    rig.play(1.0);
    ASSERT_TRUE(rig.session.submit({RenderControl{0, RenderControl::Kind::stopAll, 0, 0.0f, {}}}));
    rig.play(0.5);
    EXPECT_LT(peakOf(rig.play(0.5)[1]), 1e-6f);
}

TEST(Listening, NoneOfManyStopsIsLost) {
    ContactAudio heard{{}};
    heard.prepare(48000);
    heard.mirror(CollisionEvent{
        .timeNs = 1'000'000, .frequencyHz = 200.0, .amplitude = 0.5, .durationNs = 5'000'000'000});
    RenderControl stop;
    for (int k = 0; k < 384; ++k) heard.mirror(stop); // as many as a session's queues hold
    stop.timeNs = 20'000'000;
    heard.mirror(stop);
    EXPECT_EQ(heard.lost(), 0u);
    std::vector<float> begun(4800), ended(4800);
    float* at = begun.data();
    heard.render(&at, 4800);
    at = ended.data();
    heard.render(&at, 4800);
    EXPECT_GT(peakOf(begun), 0.4f);
    EXPECT_LT(peakOf(ended), 1e-6f);
}

// After a pause of the device what is late is dropped for the ears, too, and what comes later is heard.
TEST(Listening, WhatIsDroppedForTheHandsIsDropped) {
    const auto at = [](std::int64_t timeNs, std::int32_t fixture) {
        CollisionEvent e{.timeNs = timeNs, .frequencyHz = 200.0, .amplitude = 0.5, .durationNs = 10'000'000};
        e.source.fixture = fixture;
        return e;
    };
    for (const bool includesWorlds : {false, true}) {
        ContactAudio heard{{}};
        heard.prepare(48000);
        for (const auto& e : {at(10'000'000, -1), at(30'000'000, 0), at(50'000'000, -1)}) heard.mirror(e);
        heard.discard({30'000'000, includesWorlds});
        std::vector<float> samples(3600);
        float* out = samples.data();
        heard.render(&out, 3600);
        const auto peakIn = [&](int fromMs) { // the limiter delays by some of the 10 ms between them
            return peakOf(
                std::vector<float>{samples.begin() + 48 * fromMs, samples.begin() + 48 * (fromMs + 20)});
        };
        EXPECT_EQ(peakIn(10), 0.0f);
        EXPECT_EQ(peakIn(30) > 0.4f, !includesWorlds) << "it is due just then";
        EXPECT_GT(peakIn(50), 0.4f);
    }
}

TEST(Listening, AnOutputIsAnEnchantersOrHeardAndIsTheDevices) {
    Rig rig{setupOn("phone4", false)};
    EXPECT_EQ(rig.open({.noise = {3}, .noiseDb = -40.0}),
              "output 4 is an actuator's; expected another one to listen to");
    EXPECT_EQ(rig.open({.noise = {8}, .noiseDb = -40.0}),
              "hands: has 8 outputs; expected one of them to listen to or for marks, found output 9");
    EXPECT_EQ(rig.open({.contacts = {5}, .contactDb = -20.0}),
              "expected a session that makes contact sounds, found none");
    EXPECT_EQ(rig.open({.noise = {0, 1, 2, 3, 4, 5, 6, 7, 8}, .noiseDb = -40.0}),
              "expected at most 8 outputs to listen to, found 9");
    EXPECT_EQ(rig.interface.timesStarted, 0) << "nothing half-done";
    ASSERT_EQ(rig.open({.noise = {4}, .noiseDb = -40.0}), "");
    EXPECT_EQ(rig.output.assign({0, 1, 2, 4}, 4),
              "output 5 is an actuator's; expected another one to listen to");
    EXPECT_EQ(rig.output.setListening({.noise = {2}, .noiseDb = -40.0}),
              "output 3 is an actuator's; expected another one to listen to");
    EXPECT_EQ(rig.output.setListening({.noise = {11}, .noiseDb = -40.0}),
              "Fake:hands: has 8 outputs; expected one of them to listen to or for marks, found output 12");
    rig.play(3.0);
    EXPECT_NEAR(rmsDb(rig.play(6.0)[felt], 0), -40.0, 0.5) << "all is as before";
}

TEST(Listening, TwoEarsHearWhereItIsAsLoudWhereverItIsAndFollowAnotherField) {
    auto setup = setupOn("phone4", true);
    setup.contactChannels = 2;
    Rig rig{setup, {.contacts = {4, 5}, .contactDb = 0.0}};
    rig.session.world().setSlowness(0);
    rig.play(0.2);
    const auto listeningChannel = [&](double x) {
        CollisionEvent hit = hitOf(205.0);
        hit.x = x;
        EXPECT_TRUE(rig.session.submit({Strikes{std::array{hit}}}));
        const auto out = rig.play(1.0);
        return std::pair{peakOf(out[felt]), peakOf(out[felt + 1])};
    };
    const double width = setup.scene.fieldWidthMetres;
    const auto [leftOnly, none] = listeningChannel(0.0);
    EXPECT_GT(leftOnly, 0.4f);
    EXPECT_EQ(none, 0.0f);
    const auto [left, right] = listeningChannel(0.5 * width);
    EXPECT_NEAR(left, leftOnly * std::sqrt(0.5f), 1e-4f);
    EXPECT_NEAR(left, right, 1e-6f);
    PhantomPanner wider{setup.panner.layout(), PanningLaw::linear, 1, 2.0 * width,
                        setup.scene.fieldHeightMetres};
    ASSERT_TRUE(rig.session.submit({RenderControl{0, RenderControl::Kind::panner, 0, 0.0f, &wider}}));
    rig.play(0.2);
    const auto [leftOfWider, rightOfWider] = listeningChannel(width);
    EXPECT_NEAR(leftOfWider, rightOfWider, 1e-4f) << "in the middle of the new field";
    EXPECT_GT(rightOfWider, 0.2f);
}

SessionSetup marked(bool hasContactSound = false) {
    auto setup = setupOn("phone1", hasContactSound);
    setup.marks = MarkedOnsets::all;
    return setup;
}

TEST(Listening, MarksStandAtTheOnsetsOnTheirOutputAndNeitherLevelNorCeilingMovesThem) {
    Rig rig{marked(true), {.contacts = {3}, .contactDb = -20.0, .marks = {5}}},
        quiet{marked(), {.marks = {5}}};
    quiet.output.setLevel(0.0f);
    quiet.session.submit({RenderControl{0, RenderControl::Kind::mute, 0, 1.0f, {}}});
    const auto out = rig.play(6.0), muted = quiet.play(6.0);
    ASSERT_EQ(out.size(), 3u);
    EXPECT_EQ(out[2], muted[1]);
    EXPECT_EQ(peakOf(muted[0]), 0.0f);
    EXPECT_GT(rig.session.rendered().marks()->pulses(), 5u);
    std::size_t edge = 0;
    while (out[2][edge] == 0.0f) ++edge;
    EXPECT_EQ(out[2][edge], 1.0f);
    EXPECT_EQ(onsetOf(out[0]), edge) << "the first hit lies between two frames";
}

TEST(Listening, WhatIsSilencedIsNotMarkedAndNoPulseBeginsInItsMiddle) {
    Rig rig{marked(), {.marks = {2}}};
    rig.session.world().setSlowness(0);
    rig.play(0.2);
    const CollisionEvent hit = hitOf(205.0);
    const auto marksAfter = [&](bool isSilentAtFirst) {
        EXPECT_TRUE(rig.session.submit({Strikes{std::array{hit}}}));
        // the pulse of 96 frames begins in the last of these
        const auto blocks = static_cast<int>(rig.session.timeline().outputLatencyFrames() / blockFrames);
        float most = 0.0f;
        for (int b = 0; b < blocks + 20; ++b) {
            rig.output.setSilent(isSilentAtFirst && b <= blocks);
            most = std::max(most, peakOf(rig.play(blockFrames / interfaceRate)[1]));
        }
        return most;
    };
    EXPECT_EQ(marksAfter(false), 1.0f);
    EXPECT_EQ(marksAfter(true), 0.0f);
    EXPECT_EQ(marksAfter(false), 1.0f);
}

TEST(Listening, MarksAreNeitherFeltNorHeard) {
    Rig rig{marked()}, without{setupOn("phone1", false)};
    EXPECT_EQ(rig.open({.marks = {0}}), "output 1 is an actuator's; expected another one for marks");
    EXPECT_EQ(rig.open({.noise = {4}, .noiseDb = -40.0, .marks = {4}}),
              "output 5 is listened to; expected another one for marks");
    EXPECT_EQ(without.open({.marks = {4}}), "expected a session that marks its onsets, found none");
    EXPECT_EQ(rig.open({.marks = {8}}),
              "hands: has 8 outputs; expected one of them to listen to or for marks, found output 9");
    ASSERT_EQ(rig.open({.marks = {4}}), "");
    EXPECT_EQ(rig.output.assign({4}, 1), "output 5 is an actuator's; expected another one for marks");
}

TEST(Listening, BeginsAndEndsWhileItPlays) {
    Rig rig{setupOn("phone4", false)};
    AudioOutputSettings all{"hands", {}, 0, 0, 1.0f};
    all.opensAll = true;
    ASSERT_EQ(rig.output.open(all), "");
    rig.play(0.5);
    ASSERT_EQ(rig.output.setListening({.noise = {6}, .noiseDb = -30.0}), "");
    EXPECT_EQ(rig.interface.timesOpened, 1) << "the hands notice nothing";
    rig.play(3.0);
    EXPECT_NEAR(rmsDb(rig.play(6.0)[6], 0), -30.0, 0.5);
    ASSERT_EQ(rig.output.setListening({}), "");
    EXPECT_EQ(peakOf(rig.play(0.5)[6]), 0.0f);
    ASSERT_EQ(rig.output.setListening({.noise = {6}, .noiseDb = -30.0}), "");
    EXPECT_LT(peakOf(rig.play(0.02)[6]), 0.01f) << "it fades in each time";
}

} // namespace physvib::listening_test
