// SPDX-License-Identifier: MIT
// Grains on a line that is passed, to and fro.
#include "Contacts/Grains.h"
#include "Contacts/LastingContacts.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>
#include <vector>

namespace physvib::grains_test {

struct Pass {
    std::int64_t index;
    double t;
};

std::vector<Pass> passes(const Grains& grains, const SurfaceMotion& motion, std::int64_t every = 1) {
    std::vector<Pass> all;
    grains.visit(motion, every, nullptr, [&](std::int64_t index, double t) { all.push_back({index, t}); });
    return all;
}

TEST(Grains, LieInTheirOwnCellsAndStayThere) {
    const Texture texture{0.002};
    const Grains grains{7, texture}, again{7, texture}, other{8, texture};
    double sum = 0.0, strengths = 0.0;
    int same = 0;
    for (std::int64_t i = -500; i < 500; ++i) {
        const double cells = grains.metresOf(i) / 0.002 - static_cast<double>(i);
        EXPECT_GT(cells, 0.049);
        EXPECT_LT(cells, 0.951);
        EXPECT_EQ(grains.metresOf(i), again.metresOf(i));
        EXPECT_EQ(grains.strengthOf(i), again.strengthOf(i));
        same += grains.metresOf(i) == other.metresOf(i) ? 1 : 0;
        sum += cells;
        strengths += grains.strengthOf(i);
    }
    EXPECT_EQ(same, 0);
    EXPECT_NEAR(sum / 1000.0, 0.5, 0.03);
    EXPECT_NEAR(strengths / 1000.0, 1.0, 0.05);
}

TEST(Grains, ArePassedOnceEachHoweverTheWayIsCut) {
    const Texture texture{0.001};
    const Grains grains{3, texture};
    const SurfaceMotion whole{-0.05, 0.3, -1.0, 1.0}; // turns after 0.3 s, and goes far back
    const std::vector<Pass> all = passes(grains, whole);
    std::vector<Pass> parts;
    for (int k = 0; k < 1000; ++k) {
        const double t = 0.001 * k;
        for (Pass p : passes(grains, {whole.metresAt(t), whole.speedAt(t), whole.metresPerSecond2, 0.001}))
            parts.push_back({p.index, t + p.t});
    }
    ASSERT_EQ(parts.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(parts[i].index, all[i].index);
        EXPECT_NEAR(parts[i].t, all[i].t, 1.0e-9);
        EXPECT_NEAR(whole.metresAt(all[i].t), grains.metresOf(all[i].index), 1.0e-12);
        if (i > 0) EXPECT_GE(all[i].t, all[i - 1].t);
    }
}

TEST(Grains, ThinnedOnesAreSomeOfThem) {
    const Texture texture{0.001, 1.0, GrainPattern::regular};
    const Grains grains{0, texture};
    const std::vector<Pass> fourth = passes(grains, {-0.1, 1.0, 0.0, 0.2}, 4);
    ASSERT_EQ(fourth.size(), 50U);
    for (const Pass& p : fourth) EXPECT_EQ(p.index % 4, 0);
}

/// Power of half a minute's impulses in third octaves from 63 to 500 Hz, dB.
std::vector<double> thirdOctaves(const Grains& grains, double metresPerSecond, std::int64_t every) {
    constexpr double rate = 5000.0, length = 32.0; // four times the thinned grains: their tones fold back
    std::vector<double> impulses(static_cast<std::size_t>(rate * length));
    grains.visit({0.0, metresPerSecond, 0.0, length}, every, nullptr, [&](std::int64_t index, double t) {
        const auto at = std::min(static_cast<std::size_t>(t * rate), impulses.size() - 1);
        impulses[at] += grains.strengthOf(index) * std::sqrt(static_cast<double>(every));
    });
    const std::vector<double> bins = magnitudes(impulses);
    const double perBin = 0.5 * rate / static_cast<double>(bins.size() - 1);
    std::vector<double> bands;
    for (double centre = 62.5; centre < 510.0; centre *= std::cbrt(2.0)) {
        double power = 0.0;
        for (auto k = static_cast<std::size_t>(centre * 0.89 / perBin);
             static_cast<double>(k) * perBin < centre * 1.12; ++k)
            power += bins[k] * bins[k];
        bands.push_back(10.0 * std::log10(power));
    }
    return bands;
}

TEST(Grains, SoundAlikeBelow500HertzThinnedOrNot) {
    const Texture texture{0.001};
    const Grains grains{5, texture};
    // as LastingContacts does: 1,250 a second
    for (const auto& [speed, every] : {std::pair{5.0, 4}, std::pair{20.0, 16}}) {
        const auto all = thirdOctaves(grains, speed, 1), thinned = thirdOctaves(grains, speed, every);
        ASSERT_EQ(all.size(), 10U);
        for (std::size_t i = 0; i < all.size(); ++i)
            EXPECT_NEAR(thinned[i], all[i], 1.0) << speed << " m/s, band " << i;
    }
}

TEST(Grains, TheGapOfTheStepBeforeChangesNothingAndOftenTellsThatThereIsNone) {
    const Grains grains{3, {.grainMetres = 0.02}};
    GrainGap gap;
    int held = 0;
    double at = 0.0;
    using Passed = std::vector<std::pair<std::int64_t, double>>;
    for (int i = 0; i < 4000; ++i) { // to and fro
        const SurfaceMotion motion{at, (i % 7 == 0 ? 40.0 : 0.9) * std::sin(0.01 * i),
                                   0.3 * std::cos(0.3 * i), 0.01};
        const bool holds = gap.contains(motion);
        Passed searched, known;
        const auto into = [](Passed& all) {
            return [&all](std::int64_t index, double t) { all.emplace_back(index, t); };
        };
        grains.visit(motion, 1, nullptr, into(searched));
        gap = grains.visit(motion, 1, &gap, into(known));
        held += holds ? 1 : 0;
        EXPECT_EQ(searched, known) << i;
        EXPECT_TRUE(!holds || known.empty()) << i;
        at = motion.metresAt(motion.seconds) + (i % 11 == 0 ? 0.1 : 0.0); // a jump
    }
    EXPECT_GT(held, 1000);
}

TEST(Textures, WhatCannotBeFeltIsRefused) {
    EXPECT_EQ(errorOf(Texture{}), "");
    EXPECT_EQ(errorOf(Texture{0.002}), "");
    EXPECT_FALSE(Texture{1.0e-6}.isRough());
    for (const double grain : {-1.0, 11.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_NE(errorOf(Texture{grain}), "") << grain;
    EXPECT_NE(errorOf(Texture{0.002, -1.0}), "");
    EXPECT_NE(errorOf(Texture{0.002, 1.0, GrainPattern::random, 1.5}), "");
}

/// A point of two slots, told as an engine would that has no Box2D.
class LastingStream : public testing::Test {
protected:
    LastingStream() {
        HapticFixture ground{250.0, 20.0, true, 10.0};
        ground.texture = {0.002};
        groundSlot = table.findOrAdd(std::uint64_t{11}, {.body = 1});
        table.set(groundSlot, ground, {});
        ballSlot = table.findOrAdd(std::uint64_t{12}, {.body = 2, .massKg = 1.0, .isDynamic = true});
    }
    /// A step of 10 ms with this load and speed, sliding.
    std::vector<Impact> step(double newtons, double metresPerSecond) {
        metres += metresPerSecond * 0.01;
        if (newtons >= 0.0) touch(0, newtons, metresPerSecond, metres);
        return endStep();
    }
    void touch(std::uint64_t feature, double newtons, double metresPerSecond, double at) {
        lasting.touch({.a = groundSlot,
                       .b = ballSlot,
                       .feature = feature,
                       .normalNewtonSeconds = newtons * 0.01,
                       .slipMetresPerSecond = metresPerSecond,
                       .onA = {at, metresPerSecond}});
    }
    std::vector<Impact> endStep(std::int64_t ns = 10'000'000) {
        span.startNs = span.endNs;
        span.endNs += ns;
        std::vector<Impact> impacts;
        lasting.collect(span, impacts);
        lasting.endStep();
        return impacts;
    }
    double power(double newtons, double metresPerSecond, int steps = 200) {
        for (int i = 0; i < 3; ++i) step(newtons, metresPerSecond);
        double sum = 0.0;
        for (int i = 0; i < steps; ++i)
            for (const Impact& impact : step(newtons, metresPerSecond))
                sum += impact.newtonSeconds * impact.newtonSeconds;
        return sum / (0.01 * steps);
    }
    FixtureTable table;
    LastingContacts lasting{table};
    StepSpan span;
    std::int32_t groundSlot = 0, ballSlot = 0;
    double metres = 0.0;
};

TEST_F(LastingStream, GrowsWithLoadAndSpeedThinnedOrNot) {
    // Power: as many grains as the speed, each as strong as load and speed.
    const double one = power(1.0, 1.0);
    for (const double load : {0.1, 1.0, 10.0})
        for (const double speed : {0.05, 0.5, 1.0, 5.0, 30.0}) { // 25 to 15,000 grains a second
            const double expected = one * load * load * speed * speed * speed;
            EXPECT_NEAR(10.0 * std::log10(power(load, speed, speed < 0.1 ? 2000 : 200) / expected), 0.0, 1.0)
                << load << " N, " << speed << " m/s";
        }
    EXPECT_GT(lasting.thinned(), 0U);
}

TEST_F(LastingStream, WhatIsThinnedHasABoundedRate) {
    for (int i = 0; i < 3; ++i) step(1.0, 30.0);
    for (int i = 0; i < 50; ++i) EXPECT_LE(step(1.0, 30.0).size(), 21U);
}

TEST_F(LastingStream, ALoadThatHasJustComeIsNotFelt) {
    EXPECT_TRUE(step(1.0, 1.0).empty());
    const double usual = step(1.0, 1.0).front().newtonSeconds;
    double most = 0.0;
    for (const Impact& impact : step(1000.0, 1.0))
        most = std::max(most, impact.newtonSeconds); // a collision's
    EXPECT_LT(most, 20.0 * usual);
    step(1.0, 1.0);
    EXPECT_TRUE(step(-1.0, 1.0).empty()); // nothing touches
    EXPECT_TRUE(step(1.0, 1.0).empty());  // again new
}

TEST_F(LastingStream, WhatJumpsIsNotFollowedAndWhatIsNoNumberNotTaken) {
    for (int i = 0; i < 3; ++i) step(1.0, 0.5);
    metres += 100.0; // put elsewhere
    EXPECT_LE(step(1.0, 0.5).size(), 4U);
    EXPECT_TRUE(step(1.0, std::numeric_limits<double>::quiet_NaN()).empty());
    metres = 0.0;
    EXPECT_TRUE(step(1.0, std::numeric_limits<double>::infinity()).empty());
}

// Longer than longestStepSeconds nobody knows the way; from the step after it on, all is as at first.
TEST_F(LastingStream, AStepThatIsTooLongForgetsTheWay) {
    std::array<std::vector<std::size_t>, 2> counts;
    for (auto& each : counts) {
        for (int i = 0; i < 4; ++i) each.push_back(step(1.0, 1.0).size());
        EXPECT_EQ(each[0], 0U);
        EXPECT_GT(each[1], 2U);
        touch(0, 1.0, 1.0, metres += 0.2);
        EXPECT_TRUE(endStep(200'000'000).empty());
    }
    EXPECT_EQ(counts[1][0], 0U) << "its load is not known";
}

/// Takes runs of grains, as EventMaker does.
struct RunTaker {
    std::vector<std::int64_t> timesNs;
    std::vector<double> newtonSeconds, x;
    std::size_t calls = 0;
    void add(const Impact&) { ADD_FAILURE() << "one alone"; }
    bool prepare(std::int32_t, std::int32_t, GrainRuns& runs) {
        runs.perNewtonSecond = runs.divisor = runs.gain = runs.pairGain = runs.relativeAmplitude = 1.0;
        runs.origin = {};
        runs.cosine = 1.0F, runs.sine = 0.0F;
        return true;
    }
    std::int32_t idOf(std::int32_t other) { return other; }
    void addGrains(const GrainRuns& runs) {
        ++calls;
        for (std::size_t i = 0; i < runs.count; ++i) {
            timesNs.push_back(runs.timeNs[i]);
            newtonSeconds.push_back(runs.newtonSeconds[i]);
            x.push_back(runs.x[i]);
        }
    }
};

// A step of 0.1 s holds more than a run does: the run goes on in the next.
TEST_F(LastingStream, MoreGrainsThanARunHoldsAreTheSameGrains) {
    for (const double speed : {3.9, -3.9, 2.58}) { // 193 and about 128 grains a step
        LastingContacts oneByOne{table}, inRuns{table};
        for (int i = 0; i < 6; ++i) {
            metres += 0.099 * speed;
            const LastingPoint point{.a = groundSlot,
                                     .b = ballSlot,
                                     .normalNewtonSeconds = 0.1,
                                     .slipMetresPerSecond = speed,
                                     .point = {1.0F, 0.0F},
                                     .velocity = {static_cast<float>(speed), 0.0F},
                                     .onA = {metres, speed}};
            oneByOne.touch(point), inRuns.touch(point);
            span.startNs = span.endNs, span.endNs += 99'000'000;
            std::vector<Impact> impacts;
            RunTaker runs;
            oneByOne.collect(span, impacts), inRuns.collectInto(span, runs);
            oneByOne.endStep(), inRuns.endStep();
            ASSERT_EQ(runs.timesNs.size(), impacts.size()) << i;
            for (std::size_t k = 0; k < impacts.size(); ++k) {
                ASSERT_EQ(runs.timesNs[k], impacts[k].timeNs) << k;
                ASSERT_EQ(runs.newtonSeconds[k], impacts[k].newtonSeconds) << k;
                ASSERT_EQ(runs.x[k], static_cast<double>(impacts[k].point.x)) << k;
            }
            if (i > 1 && std::abs(speed) > 3.0) EXPECT_EQ(runs.calls, 2U) << impacts.size();
        }
    }
}

TEST_F(LastingStream, ManyTogetherStayBelowTheirBound) {
    std::vector<Impact> impacts;
    for (int n = 0; n < 5; ++n) {
        for (std::uint64_t k = 0; k < 1000; ++k)
            touch(k, 1.0, 3.0, 0.03 * n + 0.0137 * static_cast<double>(k));
        impacts = endStep();
    }
    EXPECT_LE(impacts.size(), 1000U); // of maxTotalGrainsPerSecond, but for what lies at both ends
    EXPECT_GT(impacts.size(), 200U);
}

} // namespace physvib::grains_test
