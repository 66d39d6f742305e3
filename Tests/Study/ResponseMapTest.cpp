// SPDX-License-Identifier: MIT
// Moments against a hand calculation, maps against geometry, and data that allows no normal.
#include "Lab/Study/Places.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::vector<LocationTrial> cloud(int column, int row, double x, double y, double spread, int count,
                                 SeededRandom& random) {
    std::vector<LocationTrial> trials;
    for (int i = 0; i < count; ++i)
        trials.push_back({column, row, std::clamp(x + spread * random.normal(), 0.0, 1.0),
                          std::clamp(y + spread * random.normal(), 0.0, 1.0)});
    return trials;
}

TEST(ResponseMap, MeansAndSampleCovariances) {
    const auto made = responseNormals({{1, 1, 0.1, 0.2}, {1, 1, 0.3, 0.2}, {1, 1, 0.2, 0.5}});
    ASSERT_EQ(made.fault, "");
    const PlaceNormal& n = made.normals.front();
    EXPECT_NEAR(n.meanX, 0.2, 1e-12);
    EXPECT_NEAR(n.meanY, 0.3, 1e-12);
    EXPECT_NEAR(n.varianceX, 0.01, 1e-12);
    EXPECT_NEAR(n.varianceY, 0.03, 1e-12);
    EXPECT_NEAR(n.covariance, 0.0, 1e-12);
}

TEST(ResponseMap, EqualNormalsDivideTheFieldAtTheMiddle) {
    std::vector<LocationTrial> trials;
    for (const int column : {1, 2})
        for (const auto& [dx, dy] : {std::pair{0.1, 0.0}, {-0.1, 0.0}, {0.0, 0.1}, {0.0, -0.1}})
            trials.push_back({column, 1, 0.25 + 0.5 * (column - 1) + dx, 0.5 + dy});
    const auto made = resolveCondition("two", trials);
    EXPECT_NEAR(made.counts.at(0, 0), 50.0, 1e-9);
    EXPECT_NEAR(made.counts.sum(), 100.0, 1e-9);
    EXPECT_EQ(made.resolution.columns, 2u);
    const auto map = likelihoodMap(made.normals);
    EXPECT_EQ(map.size(), mapColumns * mapRows);
    EXPECT_EQ(map.front(), 0);
    EXPECT_EQ(map.back(), 1);
}

TEST(ResponseMap, WellSeparatedTargetsKeepTheWholeGrid) {
    SeededRandom random{3};
    std::vector<LocationTrial> trials;
    for (int r = 1; r <= 5; ++r)
        for (int c = 1; c <= 7; ++c)
            for (const auto& trial : cloud(c, r, (c - 0.5) / 7, (r - 0.5) / 5, 0.02, 30, random))
                trials.push_back(trial);
    const auto made = resolveCondition("all", trials);
    EXPECT_EQ(made.resolution.columns, 7u);
    EXPECT_EQ(made.resolution.rows, 5u);
    EXPECT_TRUE(made.normals.warnings.empty());
}

TEST(ResponseMap, SingularAndSparseTargetsBorrowThePooledCovarianceAndSaySo) {
    SeededRandom random{4};
    auto trials = cloud(1, 1, 0.2, 0.5, 0.05, 20, random);
    trials.push_back({2, 1, 0.5, 0.5});                                                   // one response
    for (int i = 0; i < 5; ++i) trials.push_back({3, 1, 0.8 + 0.01 * i, 0.4 + 0.02 * i}); // on one line
    for (int i = 0; i < 5; ++i) trials.push_back({5, 1, 0.95, 0.5});                      // all the same
    const auto made = resolveCondition("sparse", trials);
    ASSERT_EQ(made.normals.fault, "");
    EXPECT_FALSE(made.normals.normals[0].isBorrowed);
    for (const std::size_t i : {1u, 2u, 4u}) EXPECT_TRUE(made.normals.normals[i].isBorrowed) << i;
    EXPECT_EQ(made.normals.warnings.size(), 4u) << "three that borrow, and column 4 without a response";
    for (const double percent : made.counts.percent) EXPECT_TRUE(std::isfinite(percent));
    EXPECT_EQ(made.counts.percent[3], 0.0);
    EXPECT_NEAR(made.counts.sum(), 100.0, 1e-9);
}

TEST(ResponseMap, WhatAllowsNoNormalIsNamed) {
    EXPECT_NE(responseNormals({}).fault, "");
    EXPECT_NE(responseNormals({{1, 1, 0.5, 0.5}}).fault, "");
    EXPECT_NE(responseNormals({{1, 1, 0.5, 0.5}, {1, 1, 0.5, 0.5}, {2, 1, 0.6, 0.5}, {2, 1, 0.6, 0.5}}).fault,
              "");
    EXPECT_TRUE(resolveCondition("none", {}).counts.percent.empty());
}

} // namespace
} // namespace physvib
