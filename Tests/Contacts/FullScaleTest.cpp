// SPDX-License-Identifier: MIT
// The impulse of full scale, told and learned, and the time in which a world settles: hits of known impulses.
#include "Contacts/EventMaker.h"
#include "FedWorld.h"
#include <limits>

namespace physvib::full_scale_test {

constexpr std::int32_t ground = 0, ball = 1, other = 2;
constexpr double oneSecond = 1.0, stepSeconds = 0.01;

ImpactSettings automatic() {
    ImpactSettings settings;
    settings.fullScaleNewtonSeconds = ImpactSettings::automatic;
    return settings;
}

/// A floor, and two balls that land on it when they are told to.
class Hits {
public:
    explicit Hits(const ImpactSettings& settings, double massKg = 1.0)
        : feed{settings} {
        EXPECT_EQ(feed.set(ground, {}, {}), "");
        for (const std::int32_t id : {ball, other}) EXPECT_EQ(feed.set(id, {.massKg = massKg}, source), "");
    }
    /// Passes that time, then a step in which the balls land with these impulses; their amplitudes.
    std::vector<double> land(double afterSeconds, std::vector<double> newtonSeconds) {
        for (int i = 0; i < std::lround(afterSeconds / stepSeconds) - 1; ++i) step({});
        step(newtonSeconds);
        step({});
        std::vector<CollisionEvent> events;
        feed.flush(events);
        std::vector<double> amplitudes;
        for (const CollisionEvent& event : events) amplitudes.push_back(event.amplitude);
        return amplitudes;
    }
    double landOne(double afterSeconds, double newtonSeconds) {
        const auto amplitudes = land(afterSeconds, {newtonSeconds});
        return amplitudes.size() == 1 ? amplitudes[0] : -1.0;
    }
    ContactFeed feed;

private:
    void step(const std::vector<double>& newtonSeconds) {
        EXPECT_EQ(feed.beginStep(feed.timeNs() + std::llround(stepSeconds * 1.0e9), g), "");
        for (std::size_t i = 0; i < newtonSeconds.size(); ++i) {
            FedContact contact{.a = ground, .b = ball + static_cast<std::int32_t>(i)};
            contact.impulseNewtonSeconds = newtonSeconds[i];
            EXPECT_EQ(feed.touch(contact), "");
        }
        EXPECT_EQ(feed.endStep(), "");
    }
};

TEST(FullScale, AToldImpulseGivesItWhateverMassesAndNormalisationSay) {
    for (const double massKg : {0.01, 1.0, 10.0}) {
        ImpactSettings settings;
        settings.fullScaleNewtonSeconds = 12.0;
        settings.normalisation = 77.0;
        settings.handMassKg = massKg;
        Hits hits{settings, massKg};
        EXPECT_DOUBLE_EQ(hits.landOne(0.1, 12.0), 1.0);
        EXPECT_DOUBLE_EQ(hits.landOne(0.1, 3.0), 0.25);
        settings.driveGain = 2.0;
        hits.feed.configure(settings);
        EXPECT_DOUBLE_EQ(hits.landOne(0.1, 3.0), 0.5);
    }
}

TEST(FullScale, TheHardestHitOfAnyMassIsAtTheGoalAndNoneAbove) {
    for (const double massKg : {0.01, 0.1, 1.0, 10.0}) {
        Hits hits{automatic(), massKg};
        EXPECT_NEAR(hits.landOne(0.1, 4.0 * massKg), FullScale::goal, 1.0e-9);
        EXPECT_NEAR(hits.landOne(0.3, 40.0 * massKg), FullScale::goal, 1.0e-4); // the other still fades
        EXPECT_LE(hits.landOne(0.1, 40.0 * massKg), FullScale::goal);
    }
}

TEST(FullScale, AFirstSoftHitIsSoft) {
    Hits hits{automatic(), 2.0};
    // 0.3 m/s: a fifth of the first guess, 1.5 m/s
    EXPECT_NEAR(hits.landOne(0.1, 2.0 * 0.3), FullScale::goal / 5.0, 1.0e-9);
}

TEST(FullScale, TheLevelFallsWithHitsAndNotInAPause) {
    Hits hits{automatic()}, paused{automatic()};
    for (Hits* one : {&hits, &paused}) EXPECT_NEAR(one->landOne(0.1, 100.0), FullScale::goal, 1.0e-9);
    // 1 N s is far below, until ten time constants have passed
    double amplitude = 0.0;
    EXPECT_NEAR(hits.landOne(oneSecond - stepSeconds, 1.0), 0.005 * std::exp(0.1), 1.0e-6);
    for (int second = 0; second < 50; ++second) amplitude = hits.landOne(oneSecond - stepSeconds, 1.0);
    EXPECT_NEAR(amplitude, FullScale::goal, 0.01);
    EXPECT_NEAR(paused.landOne(60.0, 1.0), 0.005 * std::exp(0.1), 1.0e-6);
}

TEST(FullScale, TheSmallestImpactsStayBelowTheGoal) {
    Hits hits{automatic()};
    double amplitude = 0.0;
    for (int second = 0; second < 100; ++second) amplitude = hits.landOne(oneSecond, 0.16);
    EXPECT_NEAR(amplitude, FullScale::goal * 0.16 / 0.3, 1.0e-6); // 2 thresholds of 0.15 m/s
}

TEST(FullScale, HitsOfOneStepShareALevelWhateverTheirOrder) {
    Hits one{automatic()}, turned{automatic()};
    const auto a = one.land(0.1, {3.0, 4.0}), b = turned.land(0.1, {4.0, 3.0});
    ASSERT_EQ(a.size(), 2U);
    ASSERT_EQ(b.size(), 2U);
    const double both = std::pow(std::pow(3.0, 1.5) + std::pow(4.0, 1.5), 2.0 / 3.0);
    EXPECT_NEAR(a[0], FullScale::goal * 3.0 / both, 1.0e-9);
    EXPECT_NEAR(a[1], FullScale::goal * 4.0 / both, 1.0e-9);
    EXPECT_EQ(a[0], b[1]);
    EXPECT_EQ(a[1], b[0]);
}

TEST(FullScale, WhatSettlesIsNeitherFeltNorLearned) {
    ImpactSettings settings = automatic();
    settings.settlingSeconds = 0.5;
    Hits hits{settings};
    EXPECT_TRUE(hits.land(0.1, {1000.0}).empty());
    EXPECT_EQ(hits.feed.counts().settling, 1U);
    EXPECT_TRUE(hits.land(0.3, {1000.0}).empty());
    EXPECT_NEAR(hits.landOne(0.2, 4.0), FullScale::goal, 1.0e-9);
    EXPECT_EQ(hits.feed.counts().settling, 2U);
}

TEST(FullScale, GrainsDoNotRaiseTheLevelAndMutedSourcesDoNotCount) {
    FixtureTable table;
    const BodyFacts body{.body = 1, .massKg = 2.0, .isDynamic = true};
    HapticFixture values = source;
    const std::int32_t heard = table.set(table.findOrAdd(std::uint64_t{1}, body), values, {}, 0);
    values.gain = 0.0;
    const std::int32_t muted = table.set(table.findOrAdd(std::uint64_t{2}, body), values, {}, 1);
    StepSpan step;
    step.endNs = 10'000'000;
    step.minThresholdMetresPerSecond = 0.15;
    const auto impact = [](std::int32_t fixture, double newtonSeconds, ContactKind kind) {
        return Impact{fixture, FixtureTable::none, 0, newtonSeconds, {}, kind};
    };
    FullScale level;
    level.learn(std::vector{impact(muted, 900.0, ContactKind::hit)}, step, table);
    EXPECT_EQ(level.newtonSeconds(), 1.0); // as yet
    level.learn(std::vector{impact(heard, 900.0, ContactKind::roll)}, step, table);
    EXPECT_NEAR(level.newtonSeconds(), 2.0 * 1.5 / FullScale::goal, 1.0e-9); // the first guess
}

TEST(FullScale, RefusesWhatCannotBe) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {-2.0, nan, std::numeric_limits<double>::infinity()}) {
        ImpactSettings settings;
        settings.fullScaleNewtonSeconds = bad;
        EXPECT_EQ(errorOf(settings),
                  "full-scale impulse: expected 0 (off), more than 0 N s, or -1 (automatic)");
        settings = {};
        settings.settlingSeconds = bad;
        EXPECT_EQ(errorOf(settings), "settling: expected 0 s or more");
    }
}

// Eq. 5.4 and 5.7 with numbers worked out by hand.

TEST(ImpactModel, AmplitudeIsImpulseOverMassesTimesNormalisationAndDriveGain) {
    EXPECT_DOUBLE_EQ((ImpactModel{0.125, 30.0, 1.0}.amplitude(80.0, 10.0)), 0.25);
    EXPECT_DOUBLE_EQ((ImpactModel{0.125, 30.0, 4.0}.amplitude(80.0, 10.0)), 1.0);
    EXPECT_DOUBLE_EQ(defaultNormalisation(4.0), 0.125); // the fastest crosses the field in a second
}

} // namespace physvib::full_scale_test
