// SPDX-License-Identifier: MIT
// The published percent counts give the published resolutions (thesis Fig. 4.9); merging against brute force.
#include "Lab/Study/Identification.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib {
namespace {

const PercentCounts phoneLinear{"PHONE-LINEAR", 5, 7, {2.87, 3.18, 3.39, 3.46, 3.22, 2.62, 3.45, 0.01, 1.60,
                                                       3.26, 1.42, 2.77, 0.76, 1.20, 6.51, 1.22, 3.14, 4.20,
                                                       3.64, 1.74, 3.11, 3.45, 1.17, 1.95, 3.77, 3.57, 1.03,
                                                       3.53, 2.84, 2.56, 3.99, 5.41, 4.15, 2.42, 3.35}};
const PercentCounts ringLogarithm{
    "RING-LOGARITHM", 5, 7, {3.69, 4.93, 3.10, 2.22, 1.44, 3.63, 3.60, 2.09, 2.20, 1.34, 0.87, 2.53,
                             1.06, 1.56, 3.25, 2.52, 3.16, 6.54, 2.93, 3.05, 2.90, 1.65, 1.78, 3.04,
                             3.44, 3.12, 2.29, 2.97, 2.62, 3.56, 2.29, 3.90, 3.24, 4.05, 3.45}};

TEST(PercentCounts, PublishedTablesGiveThePublishedResolutions) {
    const auto phone = perceptualResolution(phoneLinear), ring = perceptualResolution(ringLogarithm);
    EXPECT_EQ(phone.columns, 5u);
    EXPECT_EQ(phone.rows, 5u);
    EXPECT_EQ(ring.columns, 7u);
    EXPECT_EQ(ring.rows, 4u);
    EXPECT_EQ(phone.ties.size(), 1u);
    EXPECT_EQ(ring.ties.size(), 2u) << "row 2 may join row 1 or row 3";
}

TEST(PercentCounts, TheThresholdIsInclusive) {
    EXPECT_EQ(perceptualResolution(phoneLinear, 1.4286).rows, 3u)
        << "the exact half of a uniform cell: 7 x 3";
    const PercentCounts sums{"sums", 1, 2, {0.71 + 0.71, 98.58}}; // in binary a little off 1.42
    EXPECT_EQ(perceptualResolution(sums).columns, 2u);
    const PercentCounts exact{"exact", 1, 2, {1.42, 98.58}}, below{"below", 1, 2, {1.41, 98.59}};
    EXPECT_EQ(perceptualResolution(exact).columns, 2u);
    EXPECT_EQ(perceptualResolution(below).columns, 1u);
}

TEST(PercentCounts, PublishedSumsAndDeviations) {
    EXPECT_NEAR(phoneLinear.sum(), 100.0, 35 * 0.005);
    EXPECT_NEAR(ringLogarithm.sum(), 100.0, 35 * 0.005);
    EXPECT_NEAR(phoneLinear.standardDeviation(), 1.32, 0.005);
    EXPECT_NEAR(ringLogarithm.standardDeviation(), 1.11, 0.005);
}

TEST(PercentCounts, MergedCellsAreSums) {
    const auto grid = merged(phoneLinear, perceptualResolution(phoneLinear).ties.front());
    EXPECT_NEAR(grid.at(0, 0), 6.05, 1e-9); // as printed in Fig. 4.9 (b)
    EXPECT_NEAR(grid.at(1, 0), 1.61, 1e-9);
    EXPECT_NEAR(grid.at(4, 4), 5.77, 1e-9); // printed 5.78, from figures that were not yet rounded
    EXPECT_NEAR(grid.sum(), phoneLinear.sum(), 1e-9);
}

TEST(PercentCounts, AFieldThatNeverReachesTheThresholdHasNoResolution) {
    const PercentCounts empty{"none", 2, 2, {0.1, 0.1, 0.1, 0.1}};
    EXPECT_EQ(perceptualResolution(empty).columns, 0u);
    EXPECT_TRUE(perceptualResolution(empty).ties.empty());
    EXPECT_TRUE(perceptualResolution({}).ties.empty());
}

/// Every pair of divisions, one by one.
std::pair<std::size_t, std::size_t> bruteForce(const PercentCounts& counts, double least) {
    std::size_t best = 0, ties = 0;
    const auto groups = [](std::size_t lines, unsigned ends) {
        std::vector<std::size_t> sizes{1};
        for (std::size_t i = 0; i + 1 < lines; ++i) ends >> i & 1 ? sizes.push_back(1) : void(++sizes.back());
        return sizes;
    };
    for (unsigned r = 0; r < 1u << (counts.rows - 1); ++r)
        for (unsigned c = 0; c < 1u << (counts.columns - 1); ++c) {
            const GridMerge merge{groups(counts.columns, c), groups(counts.rows, r)};
            const std::size_t cells = merge.columnGroups.size() * merge.rowGroups.size();
            const auto grid = merged(counts, merge);
            if (std::ranges::any_of(grid.percent, [=](double p) { return p < least - 1e-9; }) || cells < best)
                continue;
            ties = cells > best ? 1 : ties + 1;
            best = cells;
        }
    return {best, ties};
}

TEST(PercentCounts, MergingFindsWhatBruteForceFinds) {
    SeededRandom random{7};
    for (int i = 0; i < 200; ++i) {
        PercentCounts counts{"random", 1 + random.below(5), 1 + random.below(6), {}};
        for (std::size_t k = 0; k < counts.rows * counts.columns; ++k)
            counts.percent.push_back(static_cast<double>(random.below(6)));
        const double threshold = 0.5 + static_cast<double>(random.below(12));
        const auto found = perceptualResolution(counts, threshold);
        const auto [cells, ties] = bruteForce(counts, threshold);
        EXPECT_EQ(found.columns * found.rows, cells);
        EXPECT_EQ(found.ties.size(), ties);
    }
}

} // namespace
} // namespace physvib
