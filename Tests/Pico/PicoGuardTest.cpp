// SPDX-License-Identifier: MIT
// The guard in integers: its bounds, and that it is the guard of a computer.
#include "Core/Actuators/GuardLaw.h"
#include "FixedGuardPath.h"
#include "Streams.h"
#include "Support/SlowFigures.h"
#include <gtest/gtest.h>
#include <random>

namespace physvib::pico_guard_test {

using Source = test::Stream<4>::Source;

struct Hazard {
    const char* name;
    Source source;
};

std::int16_t wave(double hz, std::int64_t frame, bool isSquare) {
    const double x = std::sin(6.283185307179586 * hz * (static_cast<double>(frame) + 0.5) / 48000.0);
    return static_cast<std::int16_t>(isSquare ? (x > 0 ? 32767 : -32767) : std::lround(32767.0 * x));
}

std::vector<Hazard> hazards() {
    std::vector<Hazard> all{{"a constant", [](auto, int) -> std::int16_t { return 32767; }},
                            {"the least number", [](auto, int) -> std::int16_t { return -32768; }},
                            {"a constant of a tenth", [](auto, int) -> std::int16_t { return 3277; }}};
    all.push_back({"sines of 1 to 14 Hz", [](auto n, int j) {
                       constexpr double hz[] = {1.0, 4.9, 8.0, 14.0};
                       return wave(hz[j], n, false);
                   }});
    all.push_back({"squares of 0.5 to 8 Hz", [](auto n, int j) {
                       constexpr double hz[] = {0.5, 2.0, 5.0, 8.0};
                       return wave(hz[j], n, true);
                   }});
    all.push_back({"squares that turn at random", [](auto n, int j) -> std::int16_t {
                       std::minstd_rand random(static_cast<unsigned>(n / (2000 + 1500 * j) + 1));
                       random.discard(5);
                       return random() % 2 == 0 ? 32767 : -32767;
                   }});
    return all;
}

TEST(PicoGuard, KeepsWhatIsSlowWithinItsShare) {
    for (const auto& hazard : hazards()) {
        test::Stream<4> stream;
        stream.play(hazard.source, 5000);
        for (std::size_t j = 0; j < 4; ++j) {
            const auto figures = test::slowFigures(stream.channel(j), pico::sampleRateHz);
            EXPECT_LE(figures.mean, limits::guardShare) << hazard.name << ", channel " << j;
            EXPECT_LE(figures.rms, limits::guardShare) << hazard.name << ", channel " << j;
        }
        EXPECT_GT(stream.player->limitedTiles(), 0u) << hazard.name;
    }
}

// The same rule as a computer's guard: each turns the same tone down, tile by tile, to the same strength.
TEST(PicoGuard, IsTheGuardOfAComputer) {
    for (const double hz : {0.0, 1.0, 3.0, 5.0, 10.0, 20.0, 25.0, 40.0, 200.0}) {
        pico::FixedGuard<1> there;
        GuardLaw<1> here;
        here.prepare(1, GuardPlace::last);
        here.setTile(1.0f / pico::tilesPerSecond);
        double powerThere = 0.0, powerHere = 0.0;
        for (std::int64_t tile = 0; tile < 4 * pico::tilesPerSecond; ++tile) {
            double sum = 0.0;
            for (int k = 0; k < pico::tileFrames; ++k)
                sum += hz == 0.0 ? 32767.0 : wave(hz, tile * pico::tileFrames + k, false);
            const double gainThere = double(there.gainAtEnd(0)) / pico::unity,
                         gainHere = double(here.endGain(0));
            there.update({static_cast<std::int32_t>(sum * gainThere)});
            here.update({static_cast<float>(sum * gainHere / (32768.0 * pico::sampleRateHz))});
            powerThere += gainThere * gainThere;
            powerHere += gainHere * gainHere;
        }
        // A constant rises in steps, each when half a bound is passed: a last bit decides in which part.
        EXPECT_NEAR(std::sqrt(powerThere / powerHere), 1.0, hz == 0.0 ? 0.02 : 0.005) << hz << " Hz";
        EXPECT_EQ(there.episodes(), here.episodes()) << hz << " Hz";
    }
}

TEST(PicoGuard, AnAttackFindsNoneThatPasses) {
    const auto path = test::fixedGuardPath();
    test::AttackSearch search{[&](const test::GuardAttack& a) { return test::figuresBehind(path, a).rms; },
                              5};
    search.climb(400, 10);
    search.shape(400, 60);
    const auto worst = test::figuresBehind(path, search.worst);
    EXPECT_LE(worst.rms, limits::guardShare);
    EXPECT_LE(worst.mean, limits::guardShare);
    EXPECT_GT(worst.rms, 0.7 * limits::guardShare) << "it hardly searches";
}

TEST(PicoGuard, LeavesWhatIsFelt) {
    test::Stream<4> stream;
    stream.play([](auto n, int) { return wave(35.0, n, false); }, 3000);
    EXPECT_EQ(stream.player->limitedTiles(), 0u);
}

} // namespace physvib::pico_guard_test
