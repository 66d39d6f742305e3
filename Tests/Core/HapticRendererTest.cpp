// SPDX-License-Identifier: MIT
// HapticRenderer against the closed form, for every law, width and rate, and at every block size.
#include "Core/HapticRenderer.h"
#include "Core/Actuators/VibrationConverter.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "Support/Sets.h"
#include <gtest/gtest.h>

namespace physvib::haptic_renderer_test {

using test::gridLayout;
using test::randomEvents;
using test::renderEvents;

RendererSettings settingsFor(const ActuatorLayout& layout, PanningLaw law, int rate, bool limiter = false) {
    return {rate, layout.count, PhantomPanner{layout, law, 1.0, 1.0, 1.0}, limiter};
}

ActuatorLayout layoutOf(int channels) {
    ActuatorLayout corners{1, 1, 4, {{{0, 1}, {1, 1}, {0, 0}, {1, 0}}}};
    return channels == 4   ? corners
           : channels == 2 ? gridLayout(2, 1)
           : channels == 1 ? gridLayout(1, 1)
                           : gridLayout(channels / 2, 2);
}

/// The largest error of any instruction set.
double errorOf(int channels, PanningLaw law, int rate, double seconds,
               const std::vector<CollisionEvent>& events) {
    const int frames = static_cast<int>(seconds * rate);
    const auto layout = layoutOf(channels);
    const PhantomPanner panner{layout, law, 1.0, 1.0, 1.0};
    const auto gains = [&](double x, double y, double* g) {
        PhantomPanner::Gains all{};
        panner.gainsAt(x, y, all);
        std::copy_n(all.begin(), channels, g);
    };
    const auto expected = test::closedForm(events, rate, channels, frames, gains);
    double worst = 0;
    for (const auto set : test::runnableSets()) {
        auto settings = settingsFor(layout, law, rate);
        settings.instructions = set;
        const auto rendered = renderEvents(events, settings, frames);
        EXPECT_EQ(rendered.status.played, events.size());
        EXPECT_EQ(rendered.status.late + rendered.status.rejected + rendered.status.stolen, 0u);
        const double error = test::relativeError(expected, rendered.channels);
        ::testing::Test::RecordProperty("error_" + std::string{nameOf(set)} + "_" + std::to_string(channels) +
                                            "_" + std::to_string(rate),
                                        std::to_string(error * 1e6) + "e-6");
        worst = std::max(worst, error);
    }
    return worst;
}

TEST(HapticRenderer, PlaysAfterMonthsAsAtTheBeginning) {
    constexpr int rate = 48000, frames = 24000;
    const auto layout = layoutOf(4);
    const auto signalFrom = [&](std::int64_t second) {
        auto events = randomEvents(100, 0.4, 5);
        for (auto& e : events) e.timeNs += second * 1'000'000'000;
        test::ListSource source{events};
        const auto renderer = std::make_unique<HapticRenderer>();
        renderer->prepare(settingsFor(layout, PanningLaw::linear, rate));
        renderer->moveTo(rate, second * rate);
        const auto signal = test::renderBlocks(*renderer, source, 4, frames, {500});
        EXPECT_EQ(renderer->status().played, 100u);
        return signal;
    };
    const auto first = signalFrom(0);
    for (const std::int64_t days : {90, 3 * 365}) {
        const auto later = signalFrom(days * 86'400);
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t n = 0; n < frames; ++n)
                ASSERT_NEAR(later[j][n], first[j][n], 1e-6f) << days << " days, frame " << n;
    }
}

TEST(HapticRenderer, EqualsTheClosedFormForEveryLawAndWidth) {
    const auto events = randomEvents(700, 0.9, 1);
    for (const int channels : {1, 2, 4, 8, 16})
        for (const auto& one : panningLaws)
            ASSERT_LE(errorOf(channels, one.law, 5000, 1, events), 1e-6) << channels << " channels";
}

TEST(HapticRenderer, EqualsTheClosedFormAtEveryRate) {
    const auto events = randomEvents(2000, 1.9, 2);
    for (const int rate : {5000, 44100, 48000, 96000})
        ASSERT_LE(errorOf(4, PanningLaw::log, rate, 2, events), 1e-6) << rate << " Hz";
}

TEST(HapticRenderer, EqualsTheClosedFormWhenNothingMergesAndAllIsLong) {
    auto events = randomEvents(1500, 1.0, 3, 0);
    for (auto& e : events) e.decayPerSecond = 0.5;
    ASSERT_LE(errorOf(1, PanningLaw::linear, 5000, 4, events), 1e-6);
}

TEST(HapticRenderer, AnyBlockSizeGivesTheSameBits) {
    const auto events = randomEvents(500, 0.4, 4);
    for (const auto set : test::runnableSets())
        for (const bool limiter : {false, true}) {
            auto settings = settingsFor(layoutOf(4), PanningLaw::linear, 48000, limiter);
            settings.instructions = set;
            const auto reference = renderEvents(events, settings, 24000, {8192});
            for (const auto& blocks :
                 std::vector<std::vector<int>>{{1}, {17}, {64}, {441}, {4096}, {3, 8192, 1, 500, 63}})
                EXPECT_TRUE(renderEvents(events, settings, 24000, blocks).channels == reference.channels)
                    << nameOf(set) << ' ' << blocks[0];
        }
}

/// Two of four channels are equalised.
RendererSettings equalisedSettings(bool limiter) {
    auto settings = settingsFor(layoutOf(4), PanningLaw::linear, 48000, limiter);
    settings.equalised[1] = {{205, 8}, {180, 230}};
    settings.equalised[3] = {{110, 2}, {90, 1000}};
    return settings;
}

TEST(HapticRenderer, EachChannelIsItsEqualisersWorkAndAnyBlockSizeGivesTheSameBits) {
    const auto events = randomEvents(300, 0.4, 6);
    const int frames = 30000;
    auto expected =
        renderEvents(events, settingsFor(layoutOf(4), PanningLaw::linear, 48000), frames).channels;
    for (const std::size_t j : {1u, 3u})
        ActuatorEqualiser{equalisedSettings(false).equalised[j], 48000}.process(expected[j].data(), frames,
                                                                                false);
    EXPECT_TRUE(renderEvents(events, equalisedSettings(false), frames).channels == expected);
    for (const bool limiter : {false, true}) {
        const auto reference = renderEvents(events, equalisedSettings(limiter), frames, {8192});
        for (const auto& blocks : {std::vector{1}, {17}, {64}, {3, 8192, 1, 500, 63}})
            EXPECT_TRUE(renderEvents(events, equalisedSettings(limiter), frames, blocks).channels ==
                        reference.channels)
                << blocks[0];
    }
}

TEST(HapticRenderer, AnEqualiserRingsOutAndThenComesToRest) {
    const CollisionEvent e{
        .frequencyHz = 205, .decayPerSecond = 1000, .amplitude = 0.5, .x = 1.0, .y = 1.0}; // channel 1
    const auto rendered = renderEvents({e}, equalisedSettings(true), 10 * 48000);
    EXPECT_NE(rendered.channels[1][4000], 0.0f); // the mode is over at 800
    EXPECT_EQ(rendered.channels[1].back(), 0.0f);
    EXPECT_EQ(rendered.status.liveModes, 0);
}

TEST(HapticRenderer, MoreEventsAtOneMomentThanThePendingStoreHoldsAreAllPlayed) {
    const CollisionEvent e{.timeNs = 1'000'003, .frequencyHz = 205, .decayPerSecond = 30, .amplitude = 1e-4};
    const std::vector<CollisionEvent> events(3 * limits::maxPending, e);
    const auto rendered = renderEvents(events, settingsFor(layoutOf(1), PanningLaw::linear, 48000), 4800);
    EXPECT_EQ(rendered.status.played, events.size());
    EXPECT_EQ(rendered.status.late, 0u);
    EXPECT_EQ(rendered.status.liveModes, 1);
}

TEST(HapticRenderer, LimiterKeepsEverythingBelowFullScale) {
    auto events = randomEvents(2000, 0.9, 5);
    for (auto& e : events) e.amplitude *= 10;
    for (const auto& channel :
         renderEvents(events, settingsFor(layoutOf(4), PanningLaw::linear, 48000, true), 48000).channels)
        for (const float y : channel) ASSERT_LE(std::abs(y), 1.0f);
}

TEST(HapticRenderer, NormalisesEachBlockOfEachChannelAndFeedsAConverter) {
    struct Compared final : VibrationConverter {
        bool convert(const float* const* channels, int frames) override {
            for (std::size_t j = 0; j < 4; ++j) {
                const float* const own = asked[j].data() + done;
                float peak = 1.0f;
                for (int n = 0; n < frames; ++n) peak = std::max(peak, std::abs(own[n]));
                for (int n = 0; n < frames; ++n) EXPECT_EQ(channels[j][n], own[n] * (1.0f / peak));
                loud += peak > 1.0f;
            }
            return (done += frames) < 40000;
        }
        test::Channels asked;
        int done = 0, loud = 0;
    } compared;
    const auto events = randomEvents(2000, 0.9, 5);
    auto settings = settingsFor(layoutOf(4), PanningLaw::linear, 48000);
    compared.asked = renderEvents(events, settings, 48000).channels;
    settings.normalisesBlocks = true;
    const auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(settings);
    test::Channels memory(4, std::vector<float>(480));
    float* out[]{memory[0].data(), memory[1].data(), memory[2].data(), memory[3].data()};
    test::ListSource source{events};
    renderFromStart(*renderer, source, out, 4, 48000, 480, compared);
    EXPECT_GT(compared.loud, 100);
    EXPECT_EQ(compared.done, 84 * 480 - renderer->latencyFrames());
}

TEST(HapticRenderer, ALateEventIsPlayedWholeAtOnceAndCounted) {
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(settingsFor(layoutOf(1), PanningLaw::linear, 48000));
    test::Session none{}, late{{{10'000'000, 205, 0, 1, 0, 0, 50'000'000}}};
    test::renderBlocks(*renderer, none, 1, 4800, {4800});
    const auto block = test::renderBlocks(*renderer, late, 1, 4800, {4800})[0];
    EXPECT_EQ(renderer->status().late, 1u);
    const auto latency = static_cast<std::size_t>(renderer->latencyFrames());
    EXPECT_NEAR(block[latency + 1], std::sin(2 * std::numbers::pi * 205 / 48000), 1e-6);
    EXPECT_NE(block[latency + 2399], 0.0f);
    EXPECT_EQ(block[latency + 2400], 0.0f);
}

using test::Session;
using Kind = RenderControl::Kind;

test::Channels renderSession(Session session, const RendererSettings& settings, int block,
                             RenderStatus& status) {
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(settings);
    const auto all = test::renderBlocks(*renderer, session, settings.channels, 48000, {block});
    status = renderer->status();
    return all;
}

TEST(HapticRenderer, ControlsActAtTheirTimeWhateverTheBlockSize) {
    const PhantomPanner two{gridLayout(2, 1), PanningLaw::energy, 1, 1, 1};
    const Session session{randomEvents(500, 0.9, 8),
                          {{100'000'001, Kind::gain, 1, -0.5f},
                           {200'000'003, Kind::mute, 2, 1},
                           {.timeNs = 300'000'007, .kind = Kind::panner, .panner = &two},
                           {500'000'000, Kind::stopAll},
                           {600'000'000, Kind::mute, 2, 0}}};
    const auto settings = settingsFor(layoutOf(4), PanningLaw::linear, 48000, true);
    RenderStatus status;
    const auto reference = renderSession(session, settings, 8192, status);
    for (const int block : {1, 64, 441})
        EXPECT_TRUE(renderSession(session, settings, block, status) == reference) << block;
}

TEST(HapticRenderer, ADelaySetLaterBeginsWithWhatHasPassed) {
    Session session{randomEvents(20, 0.9, 8), {}};
    for (auto& e : session.events) e.durationNs = 0; // modes that ring, and nothing else
    for (auto& e : session.events) e.decayPerSecond = 1;
    const Session plain = session;
    session.controls = {{500'000'000, Kind::delay, 1, 0.02f}};
    for (const auto set : test::runnableSets()) {
        auto settings = settingsFor(layoutOf(2), PanningLaw::linear, 48000, false);
        settings.instructions = set;
        for (const int block : {1, 64, 441}) {
            RenderStatus status;
            const auto out = renderSession(session, settings, block, status),
                       undelayed = renderSession(plain, settings, block, status);
            EXPECT_EQ(out[0], undelayed[0]);
            const std::size_t delay = 960, faded = 24000 + 480 + 48; // the ramp, and the limiter's look-ahead
            EXPECT_NE(undelayed[1][faded - delay], 0.0f);
            for (std::size_t n = faded; n < 48000; ++n)
                ASSERT_EQ(out[1][n], undelayed[1][n - delay]) << nameOf(set) << ' ' << block << ' ' << n;
        }
    }
}

TEST(HapticRenderer, ALevelMultipliesTheGainsOfAllChannels) {
    Session levelled{randomEvents(200, 0.9, 8), {}}, gained = levelled;
    levelled.controls = {{0, Kind::gain, 1, -0.5f}, {0, Kind::mute, 2, 1}, {0, Kind::level, 0, 0.25f}};
    gained.controls = {{0, Kind::gain, 0, 0.25f},
                       {0, Kind::gain, 1, -0.125f},
                       {0, Kind::mute, 2, 1},
                       {0, Kind::gain, 3, 0.25f}};
    const auto settings = settingsFor(layoutOf(4), PanningLaw::linear, 48000, true);
    RenderStatus status;
    EXPECT_TRUE(renderSession(levelled, settings, 256, status) ==
                renderSession(gained, settings, 256, status));
}

TEST(HapticRenderer, AMutedChannelIsSilentAndHasNoSayInTheLimiter) {
    Session session{randomEvents(300, 0.9, 9)};
    for (auto& e : session.events) e.amplitude *= 20; // on channel 1 only, from 0.1 s on muted
    for (auto& e : session.events) e.x = 1;
    session.controls = {{0, Kind::mute, 1, 1}};
    const auto settings = settingsFor(gridLayout(2, 1), PanningLaw::linear, 48000, true);
    RenderStatus status;
    const auto out = renderSession(session, settings, 256, status);
    for (std::size_t n = 4800; n < 48000; ++n) ASSERT_EQ(out[1][n], 0.0f);
    EXPECT_EQ(status.limiterGain, 1.0f);
}

TEST(HapticRenderer, ALayoutChangeMovesLaterStrikesOnly) {
    const PhantomPanner one{gridLayout(1, 1), PanningLaw::linear, 1, 1, 1};
    const Session unchanged{{{.frequencyHz = 200, .decayPerSecond = 2, .amplitude = 0.3}}};
    Session session = unchanged;
    session.controls = {{.timeNs = 100'000'000, .kind = Kind::panner, .panner = &one}};
    const auto settings = settingsFor(gridLayout(2, 1), PanningLaw::linear, 48000);
    RenderStatus status;
    EXPECT_TRUE(renderSession(session, settings, 256, status) ==
                renderSession(unchanged, settings, 256, status));
    session.events.push_back(
        {.timeNs = 200'000'000, .frequencyHz = 100, .decayPerSecond = 2, .amplitude = 0.3, .x = 1});
    EXPECT_TRUE(renderSession(session, settings, 256, status)[1] ==
                renderSession(unchanged, settings, 256, status)[1])
        << "the one enchanter left is channel 0";
}

// Whatever sounds: a tone, one that moves, a recording. All four were struck before.
TEST(HapticRenderer, ALayoutOfFewerActuatorsLeavesTheOtherOutputsSilent) {
    const std::vector<float> ones(2400, 1.0f);
    const RecordedContact wood[]{{100, ones}};
    for (const int left : {1, 2, 3})
        for (const RecordedContacts& recordings : {RecordedContacts{}, RecordedContacts{wood}})
            for (const std::int64_t travelNs : {0, 50'000'000}) {
                const PhantomPanner fewer{gridLayout(left, 1), PanningLaw::linear, 1, 1, 1};
                CollisionEvent e{.frequencyHz = 100, .amplitude = 0.3, .x = 0.4, .y = 0.4};
                e.durationNs = 50'000'000;
                e.course = {.toX = 0.6, .toY = 0.4, .travelNs = travelNs};
                Session session{{e, e}, {{.kind = Kind::recordings, .recordings = recordings}}};
                session.controls.push_back({.timeNs = 100'000'000, .kind = Kind::panner, .panner = &fewer});
                session.events[1].timeNs = 200'000'000;
                RenderStatus status;
                const auto out =
                    renderSession(session, settingsFor(layoutOf(4), PanningLaw::linear, 8000), 256, status);
                for (int j = 0; j < 4; ++j) {
                    const auto& channel = out[static_cast<std::size_t>(j)];
                    EXPECT_EQ(std::count(channel.begin() + 800, channel.end(), 0.0f) < 47'200, j < left)
                        << j << " of " << left << ", " << recordings.list.size() << ' ' << travelNs;
                }
            }
}

TEST(HapticRenderer, StopAllFadesWhatRingsAndLaterEventsArePlayed) {
    const CollisionEvent e{.frequencyHz = 200, .decayPerSecond = 1, .amplitude = 0.5};
    Session session{{e, e}, {{300'000'000, Kind::stopAll}}};
    session.events[1].timeNs = 700'000'000;
    RenderStatus status;
    const auto out =
        renderSession(session, settingsFor(layoutOf(1), PanningLaw::linear, 48000), 256, status)[0];
    const auto most = [&](std::size_t from, std::size_t to, auto of) {
        float found = 0;
        for (std::size_t n = from; n < to; ++n) found = std::max(found, std::abs(of(n)));
        return found;
    };
    const auto sample = [&](std::size_t n) { return out[n]; };
    EXPECT_LT(most(14'000, 15'500, [&](std::size_t n) { return out[n] - out[n - 1]; }),
              0.5 * 2 * std::numbers::pi * 200 / 48000 + 0.02);
    EXPECT_LT(most(15'360, 33'600, sample), 1e-6f);
    EXPECT_GT(most(33'600, 48'000, sample), 0.4f);
    EXPECT_EQ(status.liveModes, 1);
}

TEST(HapticRenderer, TellsWhatItPlayedAndWhen) {
    const auto events = randomEvents(100, 0.05, 10);
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(settingsFor(layoutOf(1), PanningLaw::linear, 48000));
    test::ListSource source{events};
    test::renderBlocks(*renderer, source, 1, 4800, {4800});
    PlayedEvent played;
    for (const auto& e : events) {
        ASSERT_TRUE(renderer->played().pop(played));
        EXPECT_EQ(played.event, e);
        EXPECT_EQ(played.frame, FrameClock{48000}.at(e.timeNs).frame);
        EXPECT_FALSE(played.isLate);
    }
    EXPECT_FALSE(renderer->played().pop(played));
}

TEST(HapticRenderer, WhatCannotBePlayedIsCountedAndSilent) {
    const CollisionEvent endless{.frequencyHz = 205, .amplitude = 1};
    CollisionEvent high = endless;
    high.frequencyHz = 2500;
    high.decayPerSecond = 10;
    CollisionEvent nan = high;
    nan.amplitude = std::numeric_limits<double>::quiet_NaN();
    const auto rendered =
        renderEvents({endless, high, nan}, settingsFor(layoutOf(1), PanningLaw::linear, 5000), 500);
    EXPECT_EQ(rendered.status.rejected, 3u);
    for (const float y : rendered.channels[0]) ASSERT_EQ(y, 0.0f);
}

TEST(HapticRenderer, LeavesTheCallersDenormalModeAsItWas) {
    const auto events = randomEvents(10, 0.1, 7);
    volatile float tiny = 1e-39f;
    renderEvents(events, settingsFor(layoutOf(1), PanningLaw::linear, 48000), 4800);
    EXPECT_NE(tiny * 1.0f, 0.0f);
}

} // namespace physvib::haptic_renderer_test
