// SPDX-License-Identifier: MIT
// Compensated drives within their limit, and where the phantom's centroid lands on a 7 x 5 grid with and without them.
#include "Study/Coupling.h"
#include "Core/PhantomPanner.h"
#include "Study/SeededRandom.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace physvib {
namespace {

struct Centroid {
    double x = 0.0, y = 0.0;
};

EnchanterLayout unitSquare() { return {1, 1, 4, {{{0, 1}, {1, 1}, {0, 0}, {1, 0}}}}; }

Centroid centroidOf(const ComplexAmplitudes& felt) {
    Centroid c;
    double sum = 0.0;
    for (std::size_t j = 0; j < felt.size(); ++j) {
        const double weight = std::abs(felt[j]);
        c.x += weight * unitSquare().places[j].xMetres;
        c.y += weight * unitSquare().places[j].yMetres;
        sum += weight;
    }
    return {c.x / sum, c.y / sum};
}

/// Neighbours couple with `share` and `degrees`, those across with half of it.
CouplingMatrix coupled(double share, double degrees) {
    CouplingMatrix c(4);
    const auto turn = std::polar(1.0, degrees * std::numbers::pi / 180.0);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            if (i != j) c.at(i, j) = turn * (i + j == 3 ? 0.5 * share : share);
    return c;
}

/// Every entry off by up to +-2 dB and +-20 degrees, the diagonal too: no two enchanters are alike.
CouplingMatrix mismatched(CouplingMatrix c, SeededRandom& random) {
    const auto either = [&random] { return 2.0 * random.uniform() - 1.0; };
    for (auto& entry : c.entries) entry *= std::polar(std::pow(10.0, 2.0 * either() / 20.0), 20.0 * either() * std::numbers::pi / 180.0);
    return c;
}

/// Mean distance, in percent of the square's side, between where the phantom is meant and where it lands.
double errorOf(const CouplingMatrix& truth, const CouplingMatrix* believed) {
    const PhantomPanner panner{unitSquare(), PanningLaw::linear, 1, 1, 1};
    double sum = 0.0;
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 7; ++column) {
            PhantomPanner::Gains gains{};
            panner.gainsAt(column / 6.0, row / 4.0, gains);
            const ComplexAmplitudes wanted(gains.begin(), gains.begin() + 4);
            const Centroid meant = centroidOf(wanted), lands = centroidOf(truth.felt(believed ? compensated(*believed, wanted) : wanted));
            sum += std::hypot(lands.x - meant.x, lands.y - meant.y);
        }
    return 100.0 * sum / 35.0;
}

TEST(Coupling, WithoutCouplingTheDriveIsWhatIsWanted) {
    const ComplexAmplitudes wanted{0.5, 0.25, 0.0, 1.0};
    const auto drives = compensated(CouplingMatrix(4), wanted);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(std::abs(drives[j] - wanted[j]), 0.0, 1e-8);
}

TEST(Coupling, TheDriveNeverExceedsThreeDecibelsMore) {
    for (const double share : {0.1, 0.3, 0.5, 0.66, 0.9})
        for (const double degrees : {0.0, 60.0, 120.0, 180.0})
            for (std::size_t j = 0; j < 4; ++j) {
                ComplexAmplitudes wanted(4);
                wanted[j] = 0.8;
                double most = 0.0;
                for (const auto& d : compensated(coupled(share, degrees), wanted)) most = std::max(most, std::abs(d));
                EXPECT_LE(most, 0.8 * 1.4126) << share << ' ' << degrees;
            }
}

TEST(Coupling, AKnownCouplingIsMadeUpForAndAMisjudgedOneInPart) {
    SeededRandom random(1);
    for (const double share : {0.1, 0.2, 0.4})
        for (const double degrees : {0.0, 90.0, 180.0}) {
            const CouplingMatrix believed = coupled(share, degrees);
            const double before = errorOf(believed, nullptr), matched = errorOf(believed, &believed);
            double plain = 0.0, after = 0.0;
            constexpr int draws = 20;
            for (int i = 0; i < draws; ++i) {
                const CouplingMatrix truth = mismatched(believed, random);
                plain += errorOf(truth, nullptr) / draws;
                after += errorOf(truth, &believed) / draws;
            }
            const std::string name = std::to_string(static_cast<int>(100 * share)) + "_" + std::to_string(static_cast<int>(degrees));
            ::testing::Test::RecordProperty("before_matched_" + name, std::to_string(before) + " " + std::to_string(matched));
            ::testing::Test::RecordProperty("before_mismatched_" + name, std::to_string(plain) + " " + std::to_string(after));
            if (share < 0.4 || degrees < 180.0) {
                EXPECT_LT(matched, 0.1 * before) << name;
                EXPECT_LT(after, 0.7 * plain) << name;
            } else {
                EXPECT_GT(matched, before) << "four that cancel each other out: 3 dB are not enough, Docs/actuators.md says so";
            }
        }
}

TEST(Coupling, AttenuationIsEquation31And32) {
    const double isolated[] = {0.1, 0.2, 3.0}, reference[] = {1.0, 1.0, 2.0};
    const auto ratios = attenuationRatios(isolated, reference);
    ASSERT_EQ(ratios.size(), 3u);
    EXPECT_NEAR(ratios[0], 0.9, 1e-15);
    EXPECT_NEAR(ratios[1], 0.8, 1e-15);
    EXPECT_NEAR(ratios[2], -0.5, 1e-15);
    EXPECT_NEAR(combinedAttenuation(ratios), std::sqrt(0.81 + 0.64 + 0.25), 1e-15);
}

} // namespace
} // namespace physvib
