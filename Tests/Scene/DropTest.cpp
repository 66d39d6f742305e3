// SPDX-License-Identifier: MIT
// The first study's falls against pencil and paper: free fall, restitution, Eq. 5.4 and Eq. 5.7, with
// Table 5.1.
#include "Scene/DropScene.h"
#include "Scene/SceneFile.h"
#include "Scene/World/BodyMass.h"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace physvib::drop_test {

constexpr double gravity = 9.8, fieldWidth = 8.0, plateTop = 0.3;
constexpr double driveGain = 4.1; // of all pairs: that wood is felt more is the stimulus (Eq. 5.4)

struct Pair {
    const char* name;
    bool isRound;
    double density, restitution; // Table 5.1; Box2D takes the larger restitution of the two
    double plateMass, frequency, decay;
    std::int32_t fixture;
};
constexpr std::array pairs{Pair{"rubber-concrete", true, 120, 0.688, 870, 80, 34.13, 1},
                           Pair{"wood-wood", true, 850, 0.603, 739.5, 349, 106.99, 2},
                           Pair{"steel-steel", false, 1193, 0.597, 6803.4, 430, 11.97, 3}};
constexpr std::array sizes{"small", "medium", "large"};

struct Fall {
    Pair pair;
    int size; // 1, 2, 3 times the small one
    int height;
    int stepsPerSecond;

    double mass() const {
        const double area = pair.isRound ? std::numbers::pi * 0.15 * 0.15 : 0.157 * 0.30;
        return pair.density * area * size * size;
    }
    double landingSpeed() const { return std::sqrt(2 * gravity * height); }
    double period() const { return std::map<int, double>{{1, 2.3}, {2, 3.3}, {3, 4.2}}.at(height); }
    Scene scene() const {
        return findScene("drop", {{"pair", pair.name},
                                  {"size", sizes[static_cast<std::size_t>(size - 1)]},
                                  {"height", std::to_string(height)}})
            .value;
    }
};

// The hits faster than 1 m/s (slower ones do not bounce in Box2D), and how far a stepped world may be off. It
// adds gravity in whole steps, half a step's more or less than a hit between two steps has earned; and it
// notices a hit at most one step late or 15 mm deep (three of Box2D's slops), so that gravity has acted for
// longer.
struct Hit {
    double seconds, speed;
    double secondsOff, speedOff;
};
std::vector<Hit> hitsByHand(const Fall& fall) {
    const double e = fall.pair.restitution, step = 1.0 / fall.stepsPerSecond, halfStep = gravity * step / 2;
    std::vector<Hit> hits;
    double seconds = fall.landingSpeed() / gravity, secondsOff = 1e-4, speedOff = 0;
    for (double speed = fall.landingSpeed(); speed > 1; seconds += 2 * speed / gravity) {
        const double sunk = gravity * std::min(step, 0.015 / speed);
        hits.push_back({seconds, speed, secondsOff, speedOff + halfStep + sunk});
        speedOff = e * (speedOff + sunk) + (1 + e) * halfStep;
        secondsOff += 2 * speedOff / gravity + step;
        speed *= e;
    }
    return hits;
}

class DropStudy : public testing::TestWithParam<Fall> {
protected:
    const Fall fall = GetParam();
    // From the spawn of fall `turn` (0, 1, 2...) to the next one.
    std::vector<CollisionEvent> eventsOfFall(int turn) const {
        auto events = eventsOf(fall.scene(), (turn + 1) * fall.period() + 0.1, fall.stepsPerSecond);
        const auto begin = static_cast<std::int64_t>(turn * fall.period() * 1e9),
                   end = static_cast<std::int64_t>((turn + 1) * fall.period() * 1e9);
        std::erase_if(events, [=](const CollisionEvent& e) { return e.timeNs < begin || e.timeNs >= end; });
        for (CollisionEvent& event : events) event.timeNs -= begin;
        return events;
    }
};

TEST_P(DropStudy, HitsWhenAndAsHardAsPencilAndPaperSay) {
    const double e = fall.pair.restitution;
    const auto events = eventsOfFall(0);
    const auto hits = hitsByHand(fall);
    ASSERT_GE(hits.size(), 3U);
    ASSERT_GE(events.size(), hits.size());
    ASSERT_LE(events.size(), hits.size() + 2); // the last ones, near or below 1 m/s
    for (std::size_t k = 0; k < hits.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(events[k].timeNs) * 1e-9, hits[k].seconds, hits[k].secondsOff)
            << "bounce " << k;
        EXPECT_NEAR(events[k].source.impulseNewtonSeconds, fall.mass() * hits[k].speed * (1 + e),
                    fall.mass() * hits[k].speedOff * (1 + e))
            << "bounce " << k;
    }
}

TEST_P(DropStudy, AmplitudesAreThoseOfTheEquations) {
    const double normalisation = 1 / (2 * fieldWidth); // Eq. 5.7: a width a second; m_h: plate
    const double firstImpulse = fall.mass() * fall.landingSpeed() * (1 + fall.pair.restitution);
    const auto events = eventsOfFall(0);
    ASSERT_FALSE(events.empty());
    const auto amplitude = [&](double impulse) {
        return driveGain * normalisation * impulse / (2 * fall.pair.plateMass);
    };
    EXPECT_NEAR(events[0].amplitude, amplitude(firstImpulse), 0.02 * amplitude(firstImpulse));
    for (const CollisionEvent& event : events)
        EXPECT_NEAR(event.amplitude, amplitude(event.source.impulseNewtonSeconds), 1e-12);
}

TEST_P(DropStudy, EveryHitHasThePlatesSoundWhereTheObjectFalls) {
    for (const CollisionEvent& event : eventsOfFall(0)) {
        EXPECT_EQ(event.frequencyHz, fall.pair.frequency);
        EXPECT_EQ(event.decayPerSecond, fall.pair.decay);
        EXPECT_NEAR(event.x, fieldWidth / 2, 0.01);
        EXPECT_NEAR(event.y, plateTop, 0.01);
        EXPECT_EQ(event.source.fixture, 0);
        EXPECT_EQ(event.source.other, fall.pair.fixture);
        EXPECT_EQ(event.source.massKg, fall.pair.plateMass);
    }
}

TEST_P(DropStudy, FallsAgainTheSameWay) {
    const auto first = eventsOfFall(0), again = eventsOfFall(2);
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(again[i].timeNs - first[i].timeNs), 0, 10);
        EXPECT_EQ(again[i].source.impulseNewtonSeconds, first[i].source.impulseNewtonSeconds);
    }
}

std::vector<Fall> allFalls() {
    std::vector<Fall> falls;
    for (const Pair& pair : pairs)
        for (int size : {1, 2, 3})
            for (int height : {1, 2, 3})
                for (int rate : {100, 1000}) falls.push_back({pair, size, height, rate});
    return falls;
}
std::string nameOf(const testing::TestParamInfo<Fall>& info) {
    const Fall& f = info.param;
    return bare(f.pair.name) + sizes[static_cast<std::size_t>(f.size - 1)] + std::to_string(f.height) +
           "MetresAt" + std::to_string(f.stepsPerSecond);
}
INSTANTIATE_TEST_SUITE_P(AllConditions, DropStudy, testing::ValuesIn(allFalls()), nameOf);

TEST(Drop, HasTheMassesOfTable51WithinTwoPercent) {
    constexpr std::array printed{8.48, 33.92, 76.32, 59.08, 238.73, 537.15, 56.71, 226.85, 510.41};
    for (std::size_t i = 0; i < printed.size(); ++i) {
        const Fall fall{pairs[i / 3], static_cast<int>(i % 3) + 1, 1, 100};
        const Scene scene = fall.scene();
        const auto& spawn = std::get<SpawnAction>(scene.script[i / 3].action);
        EXPECT_NEAR(massKg(spawn.body, scene), fall.mass(), 1e-9);
        EXPECT_NEAR(massKg(spawn.body, scene), printed[i], 0.02 * printed[i]); // by the printed density
    }
}

class LivelyDrop : public testing::TestWithParam<Fall> {};

TEST_P(LivelyDrop, FallsThroughAMinuteWithEverySeed) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        expectLively(eventsOf(GetParam().scene(), 60, 100, seed), 80U, 2'000'000'000, 58'000'000'000);
    }
}

INSTANTIATE_TEST_SUITE_P(Pairs, LivelyDrop,
                         testing::Values(Fall{pairs[0], 3, 3, 100}, Fall{pairs[1], 1, 2, 100},
                                         Fall{pairs[2], 1, 1, 100}),
                         nameOf);

} // namespace physvib::drop_test
