// SPDX-License-Identifier: MIT
// A fixed level: lone hits peak at it, crowds never above it.
#include "Core/EventShaping.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace physvib {
namespace {

EventShaping heldAt(double level, const char* name) {
    EventShaping shaping;
    EXPECT_TRUE(renderingMethodNamed(name, shaping.method));
    shaping.method.fixedAmplitude = level;
    shaping.method.holdsLevel = true;
    return shaping;
}

CollisionEvent hitAt(double seconds, double hz, double decay) {
    CollisionEvent e{
        .timeNs = std::llround(seconds * 1e9), .frequencyHz = hz, .decayPerSecond = decay, .amplitude = 0.01};
    e.source.fixture = 0;
    return e;
}

double peakOf(const std::vector<CollisionEvent>& events, double seconds) {
    double peak = 0.0;
    for (double t = 0.0; t < seconds; t += 1.0 / 48000.0) {
        double sum = 0.0;
        for (const CollisionEvent& e : events) {
            const double since = t - 1e-9 * static_cast<double>(e.timeNs);
            if (since >= 0.0 && (e.durationNs == 0 || since < 1e-9 * static_cast<double>(e.durationNs)))
                sum += e.amplitude * std::sin(2.0 * std::numbers::pi * e.frequencyHz * since) *
                       std::exp(-e.decayPerSecond * since);
        }
        peak = std::max(peak, std::abs(sum));
    }
    return peak;
}

TEST(FixedLevel, ALoneHitPeaksAtItWhateverItsDecay) {
    for (const auto& [hz, decay] :
         {std::pair{80.0, 34.13}, {349.0, 106.99}, {430.0, 11.97}, {250.0, 1000.0}}) {
        EventShaper shaper{heldAt(0.75, "AF-FV-DRV")};
        EXPECT_NEAR(peakOf({shaper(hitAt(0.01, hz, decay))}, 0.1), 0.75, 0.0075) << hz;
    }
}

TEST(FixedLevel, ACrowdOfHitsIsNeverAboveItAndReachesIt) {
    for (const char* method : {"AF-FV-DRV", "AF-FV-DRF", "AF-FF-DRV", "AF-FF-DRF"}) {
        std::mt19937 random{7};
        std::exponential_distribution<double> gap{60.0};
        EventShaper shaper{heldAt(1.0, method)};
        std::vector<CollisionEvent> events;
        double t = 0.0;
        for (int n = 0; n < 60; ++n) {
            const bool isWood = random() % 2 == 0; // two materials that ring together
            events.push_back(shaper(hitAt(t, isWood ? 349.0 : 430.0, isWood ? 106.99 : 11.97)));
            if (n % 5 != 0) t += gap(random); // some at the same moment
        }
        const double peak = peakOf(events, t + 0.1);
        EXPECT_LE(peak, 1.0 + 1e-3) << method;
        EXPECT_GE(peak, 0.99) << method;
    }
}

TEST(FixedLevel, OfEachHitHasNoMeanWhereTheGuardWouldAct) {
    for (const char* method : {"AF-FV-DRV", "AF-FV-DRF"}) {
        EventShaping each = heldAt(0.75, method);
        each.method.holdsLevel = false;
        each.truncation = 0.1;
        const CollisionEvent rubber = hitAt(0.1, 80.0, 34.13);
        std::vector<CollisionEvent> hits{rubber, hitAt(0.0, 349.0, 106.99), rubber, hitAt(0.2, 430.0, 11.97)};
        EventShaper{each}.shape(hits, 1);
        ASSERT_EQ(hits.size(), 5U) << "rubber alone, and not before `first`";
        EXPECT_EQ(hits[2], each(rubber)) << "the hit itself stays";
        EXPECT_TRUE(isMeanOff(hits[3]) && hits[3].timeNs == rubber.timeNs);
        double area = 0.0;
        for (double t = 0.0; t < 1e-9 * static_cast<double>(hits[2].durationNs); t += 1e-6)
            for (const CollisionEvent& e : {hits[2], hits[3]})
                area += 1e-6 * e.amplitude * std::sin(2.0 * std::numbers::pi * e.frequencyHz * t) *
                        std::exp(-e.decayPerSecond * t);
        EXPECT_NEAR(area, 0.0, 1e-5) << method << ", of 0.0016 and 0.0027";
        EventShaper{heldAt(0.75, method)}.shape(hits);
        EXPECT_EQ(hits.size(), 5U) << "what is held is as it was";
    }
}

TEST(FixedLevel, StrikesAndVariedLevelsAreLeftAlone) {
    EventShaper shaper{heldAt(1.0, "AF-FV-DRV")}, varied{heldAt(1.0, "AV-FV-DRV")};
    CollisionEvent strike = hitAt(0.0, 200.0, 50.0);
    EXPECT_EQ(varied(strike), strike);
    strike.source.fixture = -1;
    EXPECT_EQ(shaper(strike).amplitude, 1.0) << "its A, as without a level that is held";
    shaper(hitAt(0.0, 200.0, 50.0));
    EXPECT_LT(shaper(hitAt(0.0, 200.0, 50.0)).amplitude, 1e-12);
    shaper.forget();
    EXPECT_GT(shaper(hitAt(0.0, 200.0, 50.0)).amplitude, 1.0) << "so that its first peak is 1";
}

} // namespace
} // namespace physvib
