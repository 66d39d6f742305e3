// SPDX-License-Identifier: MIT
// A search for input that passes the guard finds none: in a render, at the device, while its period and rate
// change, and on the board. Nightly: `physvib-guard-figures attack`, for hours.
#include "Support/GuardAttack.h"
#include <gtest/gtest.h>

namespace physvib::guard_attack_test {

using namespace test;

void expectNoneIsFound(const GuardPath& path, std::uint32_t seed) {
    AttackSearch search{[&](const GuardAttack& a) { return figuresBehind(path, a).rms; }, seed};
    search.climb(300, 10);
    search.shape(300, 60);
    const auto worst = figuresBehind(path, search.worst);
    EXPECT_LE(worst.rms, limits::guardShare) << path.name;
    EXPECT_LE(worst.mean, limits::guardShare) << path.name;
    EXPECT_LE(idealSlowRms(path.leaves(search.worst.samples(path.rate)), path.rate), limits::guardShare)
        << path.name;
    EXPECT_GT(worst.rms, 0.7 * limits::guardShare) << path.name << ": it hardly searches";
}

TEST(GuardAttack, FindsNoneThatPasses) {
    std::uint32_t seed = 1;
    for (const auto& path : guardPaths()) expectNoneIsFound(path, seed++);
}

// Else what stops and what begins again is a way around.
TEST(GuardAttack, ARateThatChangesOpensNothing) {
    constexpr int rate = 8000;
    OutputGuard guard;
    guard.prepare(rate, 1, GuardPlace::last);
    std::vector<float> left(4 * rate, 1.0f);
    float* at = left.data();
    for (int n = 0; n + 8 <= 4 * rate; n += 8, at += 8) guard.process(&at, 8), guard.changeRate(rate);
    EXPECT_LE(slowFigures(left, rate).mean, limits::guardShare);
}

} // namespace physvib::guard_attack_test
