// SPDX-License-Identifier: MIT
// Long tables from any CSV: columns by name, factors inside labels, choices as numbers, and a million rows.
#include "Lab/Files/LongTableCsv.h"
#include "Lab/Statistics/RankTests.h"
#include "Lab/Statistics/RepeatedMeasures.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

Result<LongTableData> read(const std::string& text, const LongTableColumns& columns) {
    const NamedText file{text, "t.csv"};
    return readLongTable(std::span{&file, 1}, columns);
}

TEST(LongTableCsv, ColumnsAreNamed) {
    const auto data =
        read("who,law,ignored,score\nA,lin,x,1\nA,log,x,2.5\nB,lin,x,3\nB,log,x,7\nB,log,x,NA\nB,log,x,\n",
             {"score", {"law"}, "", "who"});
    ASSERT_EQ(data.error, "");
    EXPECT_EQ(data.value.table.rows(), 4u);
    const Design design = Design::of(data.value.table);
    EXPECT_EQ(design.participants, (std::vector<std::string>{"A", "B"}));
    EXPECT_EQ(design.value(1, 1), 7.0);
}

TEST(LongTableCsv, TrialFilesOfStudiesAreTables) {
    const auto data = read("participant,observer,phase,stimulus,choice\n"
                           "A,simulated,training,pair=wood size=small,SV\nA,simulated,main,pair=wood "
                           "size=small,RM\nA,simulated,main,pair=steel size=small,SV\n"
                           "B,simulated,main,pair=wood size=small,RM\nB,simulated,main,pair=wood "
                           "size=large,SV\nB,simulated,main,pair=steel size=small,RM\n",
                           {"choice=RM", {"pair"}, "", ""});
    ASSERT_EQ(data.error, "");
    EXPECT_TRUE(data.value.isSimulated);
    const Design design = Design::of(data.value.table);
    EXPECT_EQ(design.values, (std::vector<double>{1, 0, 0.5, 1}));
    EXPECT_EQ(design.warnings.size(), 1u) << "averaging is told";
}

TEST(LongTableCsv, MethodsOfTheThesisAreThreeFactors) {
    std::string text = "participant,stimulus,realism\n";
    for (const char* p : {"P1", "P2"})
        for (const char* method : {"AV-FV-DRV", "AV-FV-DRF", "AV-FF-DRV", "AV-FF-DRF", "AF-FV-DRV",
                                   "AF-FV-DRF", "AF-FF-DRV", "AF-FF-DRF"})
            text += std::string(p) + "," + method + "," + p[1] + "\n";
    const auto data = read(text, {"realism", {"A", "F", "DR"}, "", ""});
    ASSERT_EQ(data.error, "");
    const Design design = Design::of(data.value.table);
    EXPECT_EQ(design.cells(), 8u);
    EXPECT_EQ(design.cellName(3), "A=V:F=F:DR=F");
    EXPECT_EQ(read(text, {"realism", {"R"}, "", ""}).error,
              "t.csv:2: column stimulus: expected a word R=..., found \"AV-FV-DRV\"");
}

TEST(LongTableCsv, RefusalsNameFileLineAndColumn) {
    const std::string table = "participant,law,score\nA,lin,1\nA,,2\n";
    EXPECT_EQ(read(table, {"score", {"law"}, "", ""}).error,
              "t.csv:3: column law: expected a level, found \"\"");
    EXPECT_EQ(read(table, {"law", {}, "", ""}).error,
              "t.csv:2: column law: expected a number from -1e100 to 1e100, found \"lin\"");
    EXPECT_EQ(read(table, {"scores", {}, "", ""}).error, "t.csv: expected a column scores, found none");
    EXPECT_EQ(read(table, {"score", {"device"}, "", ""}).error,
              "t.csv: expected a column device, found none");
    EXPECT_EQ(read(table, {"score", {}, "", "subject"}).error,
              "t.csv: expected a column subject, found none");
    EXPECT_EQ(read("law,score\nlin,1\n", {"score", {"law"}, "", ""}).error,
              "t.csv: expected a column participant, found none");
    EXPECT_EQ(read("participant,score\nA,\n", {"score", {}, "", ""}).error,
              "t.csv: column score: expected numbers, found none");
    EXPECT_EQ(read("participant,stimulus,score\nA,size=small,1\n", {"score", {"pair"}, "", ""}).error,
              "t.csv:2: column stimulus: expected a word pair=..., found \"size=small\"");
    EXPECT_EQ(read("participant,score\nA,1\nA\n", {"score", {}, "", ""}).error,
              "t.csv:3: expected 2 cells, found 1 (a cell with a comma stands in quotes)");
    EXPECT_EQ(read("participant,score\n", {"score", {}, "", ""}).error,
              "t.csv:1: expected rows after the header, found none");
}

TEST(LongTableCsv, AMillionRowsAreOneDesign) {
    std::string text = "participant,law,device,group,score\n";
    text.reserve(22'000'000);
    for (int row = 0; row < 1'000'000; ++row) {
        const int p = row % 100, law = row / 100 % 5, device = row / 500 % 4;
        text.append("P")
            .append(std::to_string(p))
            .append(",l")
            .append(std::to_string(law))
            .append(",d")
            .append(std::to_string(device));
        text.append(p % 2 ? ",old," : ",new,")
            .append(std::to_string((row * 7919LL + p * law * 31) % 1000))
            .append("\n");
    }
    const auto data = read(text, {"score", {"law", "device"}, "group", ""});
    ASSERT_EQ(data.error, "");
    EXPECT_EQ(data.value.table.rows(), 1'000'000u);
    const auto report = repeatedMeasures(Design::of(data.value.table));
    EXPECT_EQ(report.fault, "");
    EXPECT_EQ(report.lines.size(), 7u);
}

} // namespace
} // namespace physvib
