// SPDX-License-Identifier: MIT
// What a stop ends and what it leaves, who goes where a store is full, and controls that change nothing
// because they are outside their range: on both sides of each moment, level and limit.
#include "Core/Modes/ModeBank.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>

namespace physvib::stops_and_steals_test {

constexpr std::int64_t ms = 1'000'000;
constexpr int rate = 8000;

CollisionEvent tone(std::int64_t timeNs, double amplitude, std::int64_t durationNs = 0,
                    double decayPerSecond = 30.0, double frequencyHz = 60.0) {
    return {timeNs, frequencyHz, decayPerSecond, amplitude, 0.5, 0.5, durationNs, {}};
}

/// Who is quietest is a question of now: what was struck hard may have decayed below what was struck softly.
TEST(FullBank, StealsTheModeThatIsQuietestNow) {
    constexpr int modes = 2;
    for (const double decayed : {0.9, 0.5, 0.3, 0.1, 0.02})      // what is left of a strike of 1
        for (const double other : {0.7, 0.4, 0.2, 0.05, 0.01}) { // the second one, which does not decay
            auto bank = std::make_unique<ModeBank>();
            ASSERT_TRUE(bank->prepare(rate, 1, InstructionSet::scalar, modes, 8));
            const double gain = 1.0;
            const std::int64_t now = 10 * limits::tileFrames;
            const double perSecond = -std::log(decayed) * rate / static_cast<double>(now);
            std::vector<float> block(limits::tileFrames);
            float* at = block.data();
            bank->strike({200.0, perSecond, 1.0, {0, 0.0}, Strike::never}, &gain);
            bank->strike({500.0, 0.01, other, {0, 0.0}, Strike::never}, &gain);
            for (std::int64_t frame = 0; frame < now; frame += limits::tileFrames)
                bank->render(&at, frame, limits::tileFrames);
            bank->strike({1000.0, 0.01, 1.0e-9, {now, 0.0}, Strike::never}, &gain);
            EXPECT_EQ(bank->stolenModes(), 1U);
            for (std::int64_t frame = now; frame < now + rate / 10; frame += limits::tileFrames)
                bank->render(&at, frame, limits::tileFrames);
            double left = 0.0;
            for (const float sample : block) left = std::max(left, std::abs(static_cast<double>(sample)));
            const double kept = decayed < other ? other : decayed * std::exp(-perSecond * 0.1);
            EXPECT_NEAR(left, kept, 0.15 * kept + 1.0e-4) << decayed << " and " << other;
        }
}

/// Of four actuators, which those controls change.
test::Channels rendered(const std::vector<CollisionEvent>& events, const std::vector<RenderControl>& controls,
                        int frames) {
    const RendererSettings settings{.sampleRateHz = rate,
                                    .channels = 4,
                                    .panner = {test::gridLayout(2, 2), PanningLaw::linear, 1.0, 1.0, 1.0}};
    auto renderer = std::make_unique<HapticRenderer>();
    EXPECT_TRUE(renderer->prepare(settings));
    test::Session session{events, controls};
    return test::renderBlocks(*renderer, session, 4, frames, {80});
}

test::Channels renderedWith(const std::vector<RenderControl>& controls) {
    return rendered({tone(0, 3.0), tone(60 * ms, 0.7, 0, 30.0, 200.0)}, controls, 1200);
}

double peak(const test::Channels& channels, int from, int to) {
    float most = 0.0f;
    for (const auto& channel : channels)
        for (int n = from; n < to; ++n) most = std::max(most, std::abs(channel[static_cast<std::size_t>(n)]));
    return static_cast<double>(most);
}

RenderControl control(RenderControl::Kind kind, int channel, float value) {
    return {10 * ms, kind, channel, value};
}

TEST(ControlsOutOfRange, ChangeNothingAndTheirNeighboursDo) {
    using Kind = RenderControl::Kind;
    constexpr float infinity = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN();
    const auto plain = renderedWith({});
    for (const auto& [kind, value] :
         {std::pair{Kind::gain, 0.25f}, {Kind::mute, 1.0f}, {Kind::delay, 0.01f}, {Kind::ceiling, 0.125f}}) {
        for (const int channel : {-1, 4, 5, 1'000'000, std::numeric_limits<int>::min()})
            EXPECT_EQ(renderedWith({control(kind, channel, value)}), plain) << "channel " << channel;
        for (const int channel : {0, 3}) {
            const auto changed = renderedWith({control(kind, channel, value)});
            EXPECT_NE(changed[static_cast<std::size_t>(channel)], plain[static_cast<std::size_t>(channel)])
                << static_cast<int>(kind) << " of channel " << channel;
        }
    }
    for (const float ceiling : {0.0f, -0.5f, infinity, -infinity, nan})
        EXPECT_EQ(renderedWith({control(Kind::ceiling, 1, ceiling)}), plain) << ceiling;
}

TEST(ControlsOutOfRange, ALayoutOfMoreActuatorsThanOutputsIsNotTaken) {
    const auto plain = renderedWith({});
    for (const int count : {1, 2, 3, 4, 5, 6, 9, limits::maxActuators}) {
        RenderControl layout = control(RenderControl::Kind::panner, 0, 0.0f);
        const PhantomPanner panner{test::gridLayout(count, 1), PanningLaw::linear, 1.0, 1.0, 1.0};
        layout.panner = &panner;
        EXPECT_EQ(renderedWith({layout}) == plain, count > 4) << count << " actuators on 4 outputs";
    }
}

/// From every state: what sounds is over within a tenth of a second, at the latest, of its stop or silence.
TEST(StopsOfSound, EndWhateverSoundsWithinATenthOfASecond) {
    using Kind = RenderControl::Kind;
    std::vector<CollisionEvent> states;
    for (const std::int64_t duration : {std::int64_t{0}, 5000 * ms})
        for (const double decay : {0.0, 0.5}) {
            if (decay == 0.0 && duration == 0) continue;
            states.push_back(tone(0, 0.5, duration, decay, 200.0));
            states.push_back(tone(0, 0.5, duration, decay, 200.0));
            states.back().course.travelNs = 3000 * ms;
            states.back().course.toX = 1.0;
        }
    for (const Kind kind : {Kind::stopAll, Kind::silence})
        for (std::size_t i = 0; i < states.size(); ++i) {
            RenderControl stop = control(kind, 0, 0.0f);
            stop.timeNs = stop.untilNs = 100 * ms;
            const auto all = rendered({states[i]}, {stop}, rate);
            EXPECT_GT(peak(all, 0, rate / 10), 0.01) << i;
            EXPECT_LT(peak(all, rate / 5, rate), 1.0e-4)
                << "state " << i << ", kind " << static_cast<int>(kind);
        }
}

/// As whoever presses a key twice does it: nothing grows again, and no fade is cut or drawn out.
TEST(StopsOfSound, AnotherOneMeanwhileChangesNothing) {
    const std::vector<float> samples(rate, 0.5f);
    const RecordedContact wood[]{{60.0, samples}};
    std::vector<CollisionEvent> states{tone(0, 0.5), tone(0, 0.5, 0, 0.5, 200.0),
                                       tone(0, 0.5, 5000 * ms, 0.0, 200.0)}; // the first: a recording
    states.push_back(states.back());
    states.back().course = {.toX = 1.0, .toY = 0.5, .travelNs = 3000 * ms};
    for (const auto kind : {RenderControl::Kind::stopAll, RenderControl::Kind::silence})
        for (std::size_t i = 0; i < states.size(); ++i) {
            std::vector<RenderControl> stops{
                {.kind = RenderControl::Kind::recordings, .recordings = {wood, true}},
                {.timeNs = 100 * ms, .kind = kind}};
            const auto once = rendered({states[i]}, stops, rate / 5);
            for (const int later : {0, 1, 5, 9, 11})
                stops.push_back({.timeNs = (100 + later) * ms, .kind = kind});
            EXPECT_EQ(rendered({states[i]}, stops, rate / 5), once)
                << "state " << i << ", kind " << static_cast<int>(kind);
        }
}

/// A silence of collisions alone: bodies are silent from the first fixture on, what is struck by hand is not.
TEST(StopsOfSound, OfCollisionsSilenceEveryFixtureAndNoStrike) {
    RenderControl silence = control(RenderControl::Kind::silence, 0, 1.0f);
    silence.untilNs = 500 * ms;
    for (const std::int32_t fixture : {-1, 0, 1, 7}) {
        CollisionEvent hit = tone(100 * ms, 0.5);
        hit.source.fixture = fixture;
        EXPECT_EQ(peak(rendered({hit}, {silence}, rate), 0, rate) > 0.0, fixture < 0) << fixture;
    }
}

TEST(LastChanges, OnlyMutesAndGainsOfZeroMuteAChannel) {
    using Kind = RenderControl::Kind;
    LastChanges changes;
    const auto mutedAfter = [&](Kind kind, float value) {
        changes.apply({0, kind, 3, value, {}});
        return changes.mutedChannels();
    };
    EXPECT_EQ(mutedAfter(Kind::gain, -1.0f), 0U) << "inverted";
    EXPECT_EQ(mutedAfter(Kind::gain, 0.0f), 8U);
    EXPECT_EQ(mutedAfter(Kind::mute, 1.0f), 8U);
    EXPECT_EQ(mutedAfter(Kind::gain, 0.5f), 8U) << "muted still";
    EXPECT_EQ(mutedAfter(Kind::mute, 0.0f), 0U);
}

} // namespace physvib::stops_and_steals_test
