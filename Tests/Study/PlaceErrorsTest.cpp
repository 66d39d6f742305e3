// SPDX-License-Identifier: MIT
// Constant and variable error of pointing at targets on no grid, against figures worked out by hand.
#include "Lab/Files/StudyCsv.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"
#include "Stimuli/SeededRandom.h"
#include "Support/Has.h"
#include "Support/Studies.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace physvib::place_errors_test {

TEST(PlaceErrors, OfOneTargetAreMeanSpreadAndDistance) {
    const auto errors =
        targetErrors({{"P", "a", 10, 20, 13, 24}, {"P", "a", 10, 20, 13, 16}, {"P", "b", 0, 0, 0, 0}});
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].target, "a");
    EXPECT_EQ(errors[0].trials, 2u);
    EXPECT_DOUBLE_EQ(errors[0].constantX, 3.0);
    EXPECT_DOUBLE_EQ(errors[0].constantY, 0.0);
    EXPECT_DOUBLE_EQ(errors[0].variable, std::sqrt(32.0)); // of 4 and -4: 16 + 16 over one degree of freedom
    EXPECT_DOUBLE_EQ(errors[0].distance, 5.0);
    EXPECT_DOUBLE_EQ(errors[1].distance, 0.0);
    EXPECT_DOUBLE_EQ(errors[1].variable, 0.0) << "one trial has no spread";
}

TEST(PlaceErrors, SpreadIsThatOfBothAxes) {
    for (const auto& [dx, dy] : {std::pair{3.0, 0.0}, {0.0, 3.0}, {1.0, 2.0}}) {
        const std::vector<PlaceTrial> trials{{"P", "a", 10, 20, 10 + dx, 20 + dy},
                                             {"P", "a", 10, 20, 10 - dx, 20 - dy}};
        EXPECT_NEAR(targetErrors(trials).front().variable, std::sqrt(2 * dx * dx + 2 * dy * dy), 1e-12);
    }
}

TEST(PlaceErrors, EachTargetCountsAsMuchHoweverOftenItWasAsked) {
    const auto people = participantErrors({{"P", "a", 0, 0, 1, 0},
                                           {"P", "a", 0, 0, 1, 0},
                                           {"P", "a", 0, 0, 1, 0},
                                           {"P", "b", 10, 0, 15, 0},
                                           {"Q", "b", 10, 0, 10, 2},
                                           {"R", "a", 0, 0.5, 1, 0.4},
                                           {"R", "b", 10, 0.49999999999999994, 1, 0.6}});
    ASSERT_EQ(people.size(), 3u);
    EXPECT_TRUE(people[2].hasGainX);
    EXPECT_FALSE(people[2].hasGainY) << "one height, but for rounding";
    EXPECT_DOUBLE_EQ(people[0].constantX, 3.0);
    EXPECT_DOUBLE_EQ(people[0].distance, 3.0);
    EXPECT_EQ(people[0].targets, 2u);
    EXPECT_TRUE(people[0].hasVariable);
    EXPECT_DOUBLE_EQ(people[0].variable, 0.0) << "of the target that was asked three times";
    EXPECT_TRUE(people[0].hasGainX);
    EXPECT_DOUBLE_EQ(people[0].gainX, 1.4); // 1 at 0, 15 at 10
    EXPECT_FALSE(people[0].hasGainY) << "all targets at one height";
    EXPECT_FALSE(people[1].hasVariable);
    EXPECT_FALSE(people[1].hasGainX);
    EXPECT_DOUBLE_EQ(people[1].constantY, 2.0);
    EXPECT_TRUE(participantErrors({}).empty());
}

TEST(PlaceErrors, TablesOfOtherProgramsAreReadWithTargetsAnywhere) {
    std::string text = "who,landmark,true_x,true_y,touch_x,touch_y\n";
    for (int i = 0; i < 40; ++i)
        text += "P" + std::to_string(i % 4) + ",L" + std::to_string(i % 10) + "," +
                std::to_string(100 + 7 * i) + "," + std::to_string(-3 * i) + "," +
                std::to_string(103 + 7 * i) + "," + std::to_string(4 - 3 * i) + "\n";
    text += "P9,L1,5,5,,\n"; // no answer
    const auto as = [&](const std::vector<std::string>& words, auto reader) {
        const auto columns = parseColumnNames(words).value;
        const NamedText file{text, "t.csv", columns};
        return reader(std::span{&file, 1});
    };
    const std::vector<std::string> words{"participant=who", "stimulus=landmark", "target_x=true_x",
                                         "target_y=true_y", "x=touch_x",         "y=touch_y"};
    const auto read = as(words, readPlaces);
    ASSERT_TRUE(read) << read.error;
    ASSERT_EQ(read.value.groups.front().trials.size(), 40u);
    EXPECT_EQ(read.value.warnings.front(),
              "t.csv: rows left out, with nothing in one of the named columns: 1");
    for (const ParticipantError& one : participantErrors(read.value.groups.front().trials)) {
        EXPECT_DOUBLE_EQ(one.distance, 5.0) << one.participant;
        EXPECT_NEAR(one.gainX, 1.0, 1e-12);
    }
    EXPECT_EQ(as(words, readLocations).error,
              "t.csv: column target_x: expected at most 16 different places, found more; `physvib analyse "
              "places` takes targets on no grid");
    const std::vector<std::string> line{"target_x=true_x", "x=touch_x"}; // and places as names
    const auto one = as(line, readPlaces);
    EXPECT_EQ(one.value.groups.front().trials.front().target, "100");
    EXPECT_EQ(as({"target_x=true_x", "x=touch_x", "y=touch_y"}, readPlaces).error,
              "t.csv: expected both columns target_y and y, or none of them, found y");
    EXPECT_EQ(unitError(parseColumnNames(line).value), "");
    EXPECT_EQ(unitError(parseColumnNames(std::vector<std::string>{"x=touch_x:0:1230", "y=touch_y"}).value),
              "--columns: expected a range of both x and y, or of none of them, as they are compared");
    EXPECT_EQ(
        unitError(parseColumnNames(std::vector<std::string>{"target_x=true_x", "x=touch_x:0:1230"}).value),
        "--columns: expected a range of both x and target_x, or of none of them, as they are compared");
}

TEST(PlaceErrors, OurOwnRowsHaveTheirGridInTheCall) {
    const std::string head = "participant,condition,phase,task,stimulus,target_column,target_row,x,y,"
                             "render\n",
                      call = "\"stimulus phantom --grid 4x2 --cell 2,1 --points middles --layout phone4\"\n";
    std::string text = head + "P1,a,training,explore,,,,0.5,0.5,stimulus phantom --at 0.5\n" +
                       "P1,a,main,locate,\"2,1\",1,2,0.225,0.85," + call +
                       "P1,b,main,locate,\"1,4\",4,1,1,0.5,stimulus phantom --grid 4x2\n";
    const auto read = readOne(readPlaces, text, "t.csv");
    ASSERT_TRUE(read) << read.error;
    ASSERT_EQ(read.value.groups.size(), 2u);
    EXPECT_EQ(read.value.groups[0].trials,
              (std::vector<PlaceTrial>{{"P1", "2,1", 0.125, 0.75, 0.225, 0.85}}));
    EXPECT_EQ(read.value.groups[1].trials, (std::vector<PlaceTrial>{{"P1", "1,4", 1.0, 0.0, 1.0, 0.5}}))
        << "corners unless the call says middles";
    ASSERT_EQ(read.value.warnings.size(), 1u);
    EXPECT_TRUE(has(read.value.warnings[0], "shares of the field's width and height"));
    for (const char* wrong : {"--grid 4x2", "stimulus phantom --at 0.5", "x --grid 4 --seconds 1",
                              "x --grid 4x99", "x --grid 2x1"}) {
        const std::string other = head + "P1,a,main,locate,\"2,3\",3,2,0.2,0.8," + wrong + "\n";
        const auto refused = readOne(readPlaces, other, "t.csv");
        if (std::string_view{wrong} == "--grid 4x2")
            EXPECT_TRUE(refused) << refused.error;
        else
            EXPECT_EQ(refused.error.find("t.csv:2: column render: expected a call with the --grid that the "
                                         "target is of, found "),
                      0u)
                << refused.error;
    }
}

// Points of a grid, and the cell that a place belongs to.

TEST(PhantomGrid, CornersAreSharedAndPointsAreTheirOwnNearest) {
    for (const PhantomGrid grid :
         {PhantomGrid{3, 3}, {4, 4}, {5, 5}, {7, 5}, {7, 5, PhantomGrid::Points::middles}, {1, 1}})
        for (const GridCell& cell : grid.cells()) EXPECT_EQ(grid.nearest(grid.place(cell)), cell);
    EXPECT_EQ((PhantomGrid{5, 5}.place({1, 1})), (FieldPlace{0.0, 0.0}));
    EXPECT_EQ((PhantomGrid{4, 4}.place({4, 4})), (FieldPlace{1.0, 1.0}));
    EXPECT_EQ((PhantomGrid{7, 5}.cells().size()), 35u);
    EXPECT_EQ((PhantomGrid{7, 5, PhantomGrid::Points::middles}.place({1, 7})), (FieldPlace{6.5 / 7, 0.1}));
}

// Moments against a hand calculation, maps against geometry, and data that allows no normal.

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
    ASSERT_EQ(made.error, "");
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
    ASSERT_EQ(made.normals.error, "");
    EXPECT_FALSE(made.normals.normals[0].usesPooledCovariance);
    for (const std::size_t i : {1u, 2u, 4u}) EXPECT_TRUE(made.normals.normals[i].usesPooledCovariance) << i;
    EXPECT_EQ(made.normals.warnings.size(), 4u) << "three that borrow, and column 4 without a response";
    for (const double percent : made.counts.percent) EXPECT_TRUE(std::isfinite(percent));
    EXPECT_EQ(made.counts.percent[3], 0.0);
    EXPECT_NEAR(made.counts.sum(), 100.0, 1e-9);
}

TEST(ResponseMap, TheBorrowedCovarianceIsThatWithinAllTargets) {
    const auto made = responseNormals(
        {{1, 1, 0.1, 0.2}, {1, 1, 0.3, 0.2}, {1, 1, 0.2, 0.5}, {2, 1, 0.7, 0.4}, {2, 1, 0.9, 0.6}});
    ASSERT_EQ(made.error, "");
    const PlaceNormal& n = made.normals[1]; // five responses to two targets: three degrees of freedom
    EXPECT_NEAR(n.varianceX, (0.02 + 0.02) / 3, 1e-12);
    EXPECT_NEAR(n.varianceY, (0.06 + 0.02) / 3, 1e-12);
    EXPECT_NEAR(n.covariance, 0.02 / 3, 1e-12);
    EXPECT_NEAR(n.meanX, 0.8, 1e-12) << "its own";
    EXPECT_NEAR(n.meanY, 0.5, 1e-12) << "its own";
}

TEST(ResponseMap, WhatAllowsNoNormalIsNamed) {
    EXPECT_NE(responseNormals({}).error, "");
    EXPECT_NE(responseNormals({{1, 1, 0.5, 0.5}}).error, "");
    EXPECT_NE(responseNormals({{1, 1, 0.5, 0.5}, {1, 1, 0.5, 0.5}, {2, 1, 0.6, 0.5}, {2, 1, 0.6, 0.5}}).error,
              "");
    EXPECT_TRUE(resolveCondition("none", {}).counts.percent.empty());
}

} // namespace physvib::place_errors_test
