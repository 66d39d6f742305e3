// SPDX-License-Identifier: MIT
// Tables of words: quotes, comments, and faults named by line.
#include "Io/Text/CsvTable.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace std::string_view_literals;

TEST(CsvTable, CellsWithCommasStandInQuotes) {
    const auto table = readCsvTable("\xEF\xBB\xBF# physvib 1 seed=2\r\n\r\nstimulus,response\r\n\"1,2\" , "
                                    "\"say \"\"hi\"\"\"\r\n a ,\r\n\r\n",
                                    "t.csv");
    ASSERT_TRUE(table) << table.error;
    EXPECT_EQ(table.value.comments, std::vector<std::string>{"physvib 1 seed=2"});
    EXPECT_EQ(table.value.columns, (std::vector<std::string>{"stimulus", "response"}));
    ASSERT_EQ(table.value.rows.size(), 2u);
    EXPECT_EQ(table.value.rows[0].cells, (std::vector<std::string>{"1,2", "say \"hi\""}));
    EXPECT_EQ(table.value.rows[1].cells, (std::vector<std::string>{"a", ""}));
    EXPECT_EQ(table.value.rows[1].line, 5u);
    EXPECT_TRUE(table.value.column("response") == 1u && !table.value.column("x"));
}

TEST(CsvTable, FaultsAreNamedByLine) {
    const auto fault = [](std::string_view text) { return readCsvTable(text, "t.csv").error; };
    EXPECT_EQ(fault(""), "t.csv:1: expected a header line, found the end of the file");
    EXPECT_EQ(fault("a,a\n1,2\n"), "t.csv:1: column a appears twice");
    EXPECT_EQ(fault("a,,b\n1,2,3\n"), "t.csv:1: expected a name for every column");
    EXPECT_EQ(fault("a,\n1,2\n"), "t.csv:2: expected nothing in the last column, which has no name");
    for (const auto wide : {"\xFF\xFE,"sv, "a\0,\0b\0\n\0"sv, "\0a\0,\0b\0\n"sv})
        EXPECT_EQ(fault(wide), "t.csv:1: expected UTF-8, found UTF-16: save it as CSV UTF-8");
    EXPECT_EQ(fault("a,b\n1,2,3\n"),
              "t.csv:2: expected 2 cells, found 3 (a cell with a comma stands in quotes)");
    EXPECT_EQ(fault("a,b\n1,2\n\n1,2\n"),
              "t.csv:3: expected 2 cells, found 0 (a cell with a comma stands in quotes)");
    for (const char* quotes : {"a\n\"1\n", "a\n\"1\"2\n", "a\n1\"2\n"})
        EXPECT_EQ(fault(quotes), "t.csv:2: expected quotes around whole cells, and in pairs");
    EXPECT_EQ(fault("a\n"), "t.csv:1: expected rows after the header, found none");
}

TEST(CsvTable, SpreadsheetsAndExperimentsSeparateCellsOtherwise) {
    for (const char* text : {"a,b,\n1.5,x,\n", "a;b\n1,5;x\n", "sep=;\na;b\n1,5;x\n", "sep=,\na,b\n1.5,x\n",
                             "a\tb\n1.5\tx\n", "a\tb\n1,5\tx\n", "\"a\";\"b\"\n1,5;\"x\"\n"}) {
        const auto table = readCsvTable(text, "t.csv");
        ASSERT_TRUE(table) << text << table.error;
        EXPECT_EQ(table.value.columns, (std::vector<std::string>{"a", "b"})) << text;
        EXPECT_EQ(table.value.rows.front().cells, (std::vector<std::string>{"1.5", "x"})) << text;
    }
    EXPECT_EQ(readCsvTable("a\tb\tc\n1\t\t\n", "t.csv").value.rows.front().cells[0], "1") << "empty cells";
}

TEST(CsvTable, WrittenCellsAreReadBack) {
    for (const std::string words : {"plain", "1,2", "say \"hi\"", " blanks ", "#no comment", "", "=1+1",
                                    "-1+1", "@SUM(a)", "+a", "'=1", "''", "'a", "-5", "-"}) {
        std::string line;
        appendCell(line, words);
        const auto table = readCsvTable("a,b\n" + line + ",1\n", "t.csv");
        ASSERT_TRUE(table) << table.error << line;
        EXPECT_EQ(table.value.rows[0].cells[0], words);
    }
}

TEST(CsvTable, FormulasStandBehindAnApostropheNumbersDoNot) {
    const auto cell = [](std::string_view words) {
        std::string line;
        appendCell(line, words);
        return line;
    };
    EXPECT_EQ(cell("=HYPERLINK(\"a\")"), "\"'=HYPERLINK(\"\"a\"\")\"");
    EXPECT_EQ(cell("@a"), "'@a");
    EXPECT_EQ(cell("-a"), "'-a");
    EXPECT_EQ(cell("-5.5"), "-5.5");
    EXPECT_EQ(cell("a=b"), "a=b");
}

TEST(CsvTable, IsBoundedInCellsHoweverFewBytesTheyHave) {
    std::string text, row(255, ',');
    for (int c = 0; c < 256; ++c) text += (c == 0 ? "c" : ",c") + std::to_string(c);
    row += '\n';
    text += '\n';
    for (int r = 0; r < 12'000; ++r) text += row;
    EXPECT_EQ(readCsvTable(text, "t.csv").error, "t.csv:11720: expected at most 3000000 cells in all");
}

} // namespace
} // namespace physvib
