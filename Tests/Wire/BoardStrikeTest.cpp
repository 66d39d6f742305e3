// SPDX-License-Identifier: MIT
// Rounding to the numbers of the link, and who stays when the line is too slow.
#include "Wire/BoardStrike.h"
#include "Core/BoardRenderer.h"
#include "Core/PhantomPanner.h"
#include "Wire/BoardPath.h"
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace physvib::board_strike_test {

BoardStrike strike(std::int64_t onsetNs, int peak) {
    BoardStrike s;
    s.onsetNs = onsetNs;
    s.event.amplitudes = {1, static_cast<std::int16_t>(-peak), 0, 0};
    return s;
}

TEST(BoardStrike, RoundsACollisionToTheLinksNumbers) {
    CollisionEvent e{.frequencyHz = 205.03, .decayPerSecond = 0.001, .amplitude = 0.5};
    const BoardEvent b = toBoardEvent(e, {1.0, 0.25, -1.0, 100.0});
    EXPECT_EQ(b.frequency16, 3280);
    EXPECT_EQ(b.decay16, 1) << "a slow decay stays one";
    EXPECT_EQ(b.durationMs, 0);
    EXPECT_EQ(b.amplitudes, (std::array<std::int16_t, 4>{2048, 512, -2048, 32767}));
    e.decayPerSecond = 0;
    e.durationNs = 1;
    EXPECT_EQ(toBoardEvent(e, {}).decay16, 0);
    EXPECT_EQ(toBoardEvent(e, {}).durationMs, 1);
    e.frequencyHz = 4000;
    EXPECT_FALSE(isPlayable(toBoardEvent(e, {})));
}

TEST(BoardStrike, OutlastsTheLinksLongestOnlyWhileItIsFelt) {
    CollisionEvent e;
    e.durationNs = 65'535'000'000;
    EXPECT_FALSE(outlastsStrike(e));
    EXPECT_TRUE(outlastsStrike((++e.durationNs, e)));
    e.decayPerSecond = 1.0;
    EXPECT_FALSE(outlastsStrike(e)) << "140 dB weaker after 16 s";
    e.durationNs = 0;
    EXPECT_NEAR(static_cast<double>(boardLifetimeNs(e)), 16.12e9, 1e7);
    e.decayPerSecond = 1e-12;
    EXPECT_EQ(boardLifetimeNs(e), limits::maxTimeNs) << "not a number that overflows";
    EXPECT_FALSE(outlastsStrike(e)) << "without a duration a strike sounds until it has decayed";
}

TEST(StrikeBacklog, GivesThemBackInTheOrderOfTheirOnsets) {
    StrikeBacklog backlog;
    for (const int t : {5, 1, 4, 1, 3}) backlog.push(strike(t, 100 + t));
    for (const int t : {1, 1, 3, 4, 5}) {
        EXPECT_EQ(backlog.first().onsetNs, t);
        backlog.pop();
    }
    EXPECT_TRUE(backlog.empty());
}

TEST(StrikeBacklog, FullItLosesTheWeakestAndCounts) {
    StrikeBacklog backlog;
    for (int i = 0; i < 1000; ++i) backlog.push(strike(i, (i * 7919) % 1009));
    EXPECT_EQ(backlog.size(), StrikeBacklog::capacity);
    EXPECT_EQ(backlog.thinned(), 1000u - StrikeBacklog::capacity);
    int weakest = 10000;
    for (std::int64_t last = -1; !backlog.empty(); backlog.pop()) {
        weakest = std::min(weakest, backlog.first().peak());
        EXPECT_GT(backlog.first().onsetNs, last);
        last = backlog.first().onsetNs;
    }
    int stronger = 0;
    for (int i = 0; i < 1000; ++i) stronger += (i * 7919) % 1009 > weakest ? 1 : 0;
    EXPECT_EQ(stronger, StrikeBacklog::capacity - 1);
}

// More than a line carries, in the batches of a world's steps, known 30 ms before they are felt: what is sent
// is in time.
TEST(StrikeBacklog, WhatIsMoreThanTheLineCarriesIsThinnedNotLate) {
    constexpr std::int64_t ms = 1'000'000, each = 1'389'000, transit = 6 * ms, known = 30 * ms;
    for (const int perSecond : {500, 700, 1000, 2000, 5000}) {
        StrikeBacklog backlog;
        std::int64_t lineFree = 0;
        std::uint64_t told = 0, sent = 0, late = 0, strong = 0;
        for (std::int64_t now = 0; now < 3000 * ms; now += ms) {
            if (now % (10 * ms) == 0)
                for (int i = 0; i < perSecond / 100; ++i, ++told)
                    backlog.push(strike(now + known + i * 1000 * ms / perSecond,
                                        told % 20 == 0 ? 4000 : 100 + static_cast<int>(told * 7919 % 100)));
            backlog.dropLate({std::max(now, lineFree), each, transit});
            for (; !backlog.empty() && lineFree - now < 4 * ms; backlog.pop(), ++sent) {
                lineFree = std::max(now, lineFree) + each;
                late += lineFree + transit > backlog.first().onsetNs ? 1 : 0;
                strong += backlog.first().peak() == 4000 ? 1 : 0;
            }
        }
        EXPECT_EQ(late, 0u) << perSecond;
        EXPECT_EQ(sent + backlog.thinned() + static_cast<std::uint64_t>(backlog.size()), told) << perSecond;
        EXPECT_GE(static_cast<double>(strong), 0.98 * static_cast<double>(told) / 20.0) << perSecond;
        EXPECT_GE(static_cast<double>(sent) / 3.0, 0.95 * std::min(perSecond, 720)) << perSecond;
        EXPECT_EQ(backlog.thinned() == 0, perSecond <= 700) << perSecond;
    }
}

TEST(StrikeBacklog, WhatIsLateAnywayIsNotThinned) {
    StrikeBacklog backlog;
    for (int i = 0; i < 10; ++i) backlog.push(strike(i, 100));
    backlog.dropLate({1'000'000, 1'389'000, 0});
    EXPECT_EQ(backlog.size(), 10);
    EXPECT_EQ(backlog.thinned(), 0u);
}

// A path on the board: steps without gaps, of bounded number, each as strong and where it is to be.

constexpr std::int64_t second = 1'000'000'000;

CollisionEvent fromAToD(double hz = 205.0) {
    CollisionEvent e{.frequencyHz = hz, .amplitude = 0.5, .y = 1.0, .durationNs = second};
    e.course = {1.0, 0.0, second, 0};
    e.spread = Spread::equal;
    return e;
}

std::vector<CollisionEvent> stepsOf(const CollisionEvent& moving) {
    std::vector<CollisionEvent> all;
    for (BoardSteps steps{moving}; !steps.isOver();) all.push_back(steps.next());
    return all;
}

PhantomPanner square() {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    return {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
}

TEST(BoardSteps, FollowEachOtherInWholeMillisecondsAndPeriods) {
    for (const double hz : {60.0, 80.0, 149.5, 205.0, 233.3, 400.0}) {
        const auto steps = stepsOf(fromAToD(hz));
        EXPECT_LE(steps.size(), 50u);
        std::int64_t end = 0;
        for (const auto& step : steps) {
            EXPECT_EQ(step.timeNs, end);
            EXPECT_EQ(step.durationNs % 1'000'000, 0);
            EXPECT_TRUE(isPlayable(step));
            end += step.durationNs;
        }
        EXPECT_EQ(end, second);
        EXPECT_LE(std::abs(std::remainder(hz * static_cast<double>(steps[0].durationNs) * 1e-9, 1.0)), 0.03)
            << hz;
    }
}

TEST(BoardSteps, AStrikeThatDecaysEnds) {
    CollisionEvent e = fromAToD();
    e.durationNs = 0;
    e.decayPerSecond = 20.0;
    const auto steps = stepsOf(e);
    EXPECT_LE(steps.size(), 41u) << "140 dB at 174 dB a second";
    EXPECT_EQ(steps.back().course.toneAgeNs, steps.back().timeNs) << "as weak as it is by then";
}

TEST(BoardSteps, OfATonesLaterPartAreAsStrongAndWhereTheToneIsByThen) {
    for (const std::int64_t age : {std::int64_t{0}, second / 8, 3 * second / 2}) {
        CollisionEvent part = fromAToD();
        part.timeNs = 7 * second + 1;
        part.decayPerSecond = 2.0;
        part.course.toneAgeNs = age;
        for (const auto& step : stepsOf(part)) {
            const std::int64_t sinceNs = step.timeNs - part.timeNs;
            const double decayed = 0.5 * std::exp(-2.0e-9 * static_cast<double>(age + sinceNs));
            EXPECT_NEAR(toBoardEvent(step, {1.0}).amplitudes[0], decayed * limits::board::amplitudeUnit, 0.51)
                << "ns of the tone before: " << age << ", of this part: " << sinceNs;
            EXPECT_EQ(step.decayPerSecond, 2.0);
            const double middle =
                1e-9 * (static_cast<double>(sinceNs) + 0.5 * static_cast<double>(step.durationNs));
            EXPECT_NEAR(step.x, middle, 1e-9) << "from A at (0, 1) to D at (1, 0) in a second";
            EXPECT_NEAR(step.y, 1.0 - middle, 1e-9);
        }
    }
}

TEST(BoardSteps, OnTheBoardItIsEquallyStrongAllTheWay) {
    const auto renderer = std::make_unique<BoardRenderer>();
    renderer->prepare();
    const PhantomPanner panner = square();
    for (const auto& step : stepsOf(fromAToD())) {
        PhantomPanner::Gains gains{};
        panner.gainsAt(step.x, step.y, step.spread, gains);
        BoardEvent event = toBoardEvent(step, {gains[0], gains[1], gains[2], gains[3]});
        event.frame = static_cast<std::uint32_t>(step.timeNs / (second / limits::board::sampleRateHz));
        ASSERT_TRUE(renderer->schedule(event));
    }
    std::vector<double> energy; // of each frame, over all channels
    BoardRenderer::Codes codes;
    for (int block = 0; block < limits::board::sampleRateHz / BoardRenderer::blockFrames; ++block) {
        renderer->render(codes);
        for (const auto& frame : codes) {
            double sum = 0.0;
            for (const auto code : frame) sum += (code - 128.0) * (code - 128.0);
            energy.push_back(sum);
        }
    }
    const auto window = static_cast<std::size_t>(limits::board::sampleRateHz / 205 * 2);
    for (std::size_t first = 0; first + window < energy.size(); first += window) {
        double mean = 0.0;
        for (std::size_t n = first; n < first + window; ++n) mean += energy[n] / static_cast<double>(window);
        EXPECT_NEAR(10 * std::log10(mean / (0.5 * 63.5 * 63.5)), 0.0, 0.5) << first;
    }
}

} // namespace physvib::board_strike_test
