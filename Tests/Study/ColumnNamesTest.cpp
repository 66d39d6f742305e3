// SPDX-License-Identifier: MIT
// Tables of experiment programs under our columns' names.
#include "Lab/Files/StudyCsv.h"
#include "Lab/Files/StudyTables.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

const std::string psychopy = "sound,key_resp.keys,key_resp.rt,participant,expInfo,\n"
                             "A,A,0.4,7,x,\n"
                             ",,,7,x,\n"
                             "B,A,0.6,7,x,\n";

template <class Read>
auto as(Read read, std::string_view text, const std::vector<std::string>& words = {}) {
    const auto columns = parseColumnNames(words).value;
    const NamedText file{text, "t.csv", columns};
    return read(std::span{&file, 1});
}

TEST(ColumnNames, ATableOfPsychoPyIsReadByTheNamesThatItHas) {
    const auto read = as(readIdentification, psychopy,
                         {"stimulus=sound", "response=key_resp.keys", "participant=participant"});
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.conditions.front().trials,
              (std::vector<IdentificationTrial>{{"A", "A", "7"}, {"B", "A", "7"}}));
    EXPECT_EQ(read.value.warnings,
              std::vector<std::string>{"t.csv: rows left out, with nothing in one of the named columns: 1"});
    EXPECT_EQ(as(readIdentification, psychopy).error, "t.csv: expected a column stimulus, found none");
}

TEST(ColumnNames, OnlyNamedColumnsCountAndFaultsNameTheLine) {
    const auto ratings =
        as(readRatings, psychopy, {"stimulus=sound", "realism=key_resp.rt", "participant=participant"});
    ASSERT_TRUE(ratings) << ratings.error;
    EXPECT_EQ(ratings.value.scales, std::vector<std::string>{"realism"});
    EXPECT_EQ(as(readRatings, psychopy, {"stimulus=sound", "realism=key_resp.keys"}).error,
              "t.csv:2: column realism: expected a number from 0 to 100, found \"A\"");
    EXPECT_EQ(as(readRatings, psychopy, {"stimulus=picture"}).error,
              "t.csv: expected a column picture, found none");
}

TEST(ColumnNames, TruePlacesInPixelsBecomeRowsAndColumns) {
    const std::string text =
        "who,true_x,true_y,touch_x,touch_y\nP,100,50,123,0\nP,500,50,615,635\nP,100,350,1230,127\n";
    // y upwards
    const auto read =
        as(readLocations, text,
           {"participant=who", "target_x=true_x", "target_y=true_y", "x=touch_x:0:1230", "y=touch_y:635:0"});
    ASSERT_TRUE(read) << read.error;
    const auto& trials = read.value.conditions.front().trials;
    ASSERT_EQ(trials.size(), 3u);
    EXPECT_TRUE(trials[1].targetColumn == 2 && trials[1].targetRow == 1);
    EXPECT_TRUE(trials[2].targetColumn == 1 && trials[2].targetRow == 2);
    EXPECT_NEAR(trials[0].x, 0.1, 1e-9);
    EXPECT_NEAR(trials[0].y, 1.0, 1e-9);
    EXPECT_NEAR(trials[2].y, 0.8, 1e-9);
    EXPECT_EQ(
        as(readLocations, text, {"target_x=true_x", "target_y=true_y", "x=touch_x:0:1000", "y=touch_y:0:635"})
            .error,
        "t.csv:4: column x: expected a number from 0 to 1, found \"1.23\"");
    EXPECT_EQ(
        as(readLocations, text, {"target_x=who", "target_y=true_y", "x=touch_x:0:1230", "y=touch_y:0:635"})
            .error,
        "t.csv:2: column target_x: expected a number, found \"P\"");
}

TEST(ColumnNames, ASimulationStaysMarked) {
    const std::string text = "s,r,observer\nA,A,simulated\n";
    EXPECT_TRUE(as(readIdentification, text, {"stimulus=s", "response=r"}).value.isSimulated);
}

TEST(ColumnNames, WordsThatNameNothingAreRefused) {
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"response"}).error,
              "expected NAME=COLUMN of the table, e.g. response=key_resp.keys, found \"response\"");
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b", "a=c"}).error,
              "expected each name once, found \"a\" twice");
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b=c"}).value.front().theirs, "b=c");
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b:c:1"}).value.front().theirs, "b:c:1")
        << "no two numbers: a name with colons";
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b:0:1"}).value.front().theirs, "b");
}

} // namespace
} // namespace physvib
