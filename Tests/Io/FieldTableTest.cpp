// SPDX-License-Identifier: MIT
// A table of fields reads and writes a struct: what it refuses, in which words, and what it leaves out.
#include "Io/Json/FieldJson.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/DecimalSeconds.h"
#include "Support/FileTesting.h"
#include <array>
#include <gtest/gtest.h>

namespace physvib::field_table_test {

enum class Colour { red, green };
constexpr std::array<std::string_view, 2> colourNames{"red", "green"};

struct Part {
    int number = -1;
    bool operator==(const Part&) const = default;
};
struct Thing {
    double level = -6.0;
    Colour colour = Colour::red;
    Part part{};
    std::vector<Part> parts{};
    double length = 2.0, width = 3.0;
};

void visitFields(auto& v, FieldsOf<Part>) { v.field("number", &Part::number, kinds::OneBased{0, 9}); }

struct Sizes {}; // a kind of the module's own
std::pair<double, double> readCustom(const JsonField& json, const Sizes&) {
    return {json.item(0).positiveNumber(), json.item(1).positiveNumber()};
}

OrderedJson writeCustom(const Sizes&, const auto& sizes) { return sizes; }

void visitFields(auto& v, FieldsOf<Thing>) {
    v.version("thing", 3);
    v.field("level_db", &Thing::level, kinds::range(-60.0, 0.0));
    v.field("colour", &Thing::colour, kinds::OneOf{colourNames}, Need::optional.from(2));
    v.legacyField("bit", &Thing::part, kinds::Object<Part>{});
    v.field("part", &Thing::part, kinds::Object<Part>{}, Need::required.from(3));
    v.field("parts", &Thing::parts, kinds::Objects<Part>{2, "parts"}, Need::optional);
    v.field("sizes", memberPair(&Thing::length, &Thing::width), Sizes{}, Need::filled);
}

std::string errorOf(const std::string& fields) {
    const auto thing = [](const Json& root) { return kinds::Object<Thing>{}(JsonField{root, {}}); };
    return readJson("{\"thing\": " + fields + "}", "f", 1000, thing).error;
}
Thing read(const std::string& text) {
    const Json json = Json::parse(text);
    return kinds::Object<Thing>{}(JsonField{json, {}});
}

TEST(FieldTable, WhatIsWrongIsNamedWithItsPlace) {
    EXPECT_EQ(errorOf(R"(3, "level_db": -61)"), "f: level_db: expected -60 to 0, found -61");
    EXPECT_EQ(errorOf(R"(3, "level": 1)"), "f: unknown field \"level\"") << "before the one that is missing";
    EXPECT_EQ(errorOf(R"(3, "colour": "red")"), "f: field \"level_db\" is missing");
    EXPECT_EQ(errorOf(R"(3, "level_db": 0, "colour": "blue")"),
              "f: colour: expected one of red, green, found \"blue\"");
    EXPECT_EQ(errorOf(R"(3, "level_db": 0, "parts": [{"number": 0}, {"number": 10}])"),
              "f: parts[1].number: expected 0 to 9, found 10");
    EXPECT_EQ(errorOf(R"(3, "level_db": 0, "parts": [{"number": 0}, {"number": 0}, {"number": 0}])"),
              "f: parts: expected at most 2 parts");
    EXPECT_EQ(errorOf(R"(3, "level_db": 0, "part": {})"), "f: part: field \"number\" is missing");
    EXPECT_EQ(errorOf(R"(4, "new": 1)"), // before its fields
              "f: thing: made for a newer PhysVib: expected a version up to 3, found 4");
}

TEST(FieldTable, AnOlderFileLacksWhatIsNewerAndHasItByTheOldName) {
    const Thing lacking = read(R"({"thing": 1, "level_db": -1})");
    EXPECT_EQ(lacking.colour, Colour::red);
    EXPECT_EQ(lacking.part, Part{});
    EXPECT_EQ(lacking.width, 3.0);
    EXPECT_EQ(read(R"({"thing": 1, "level_db": -1, "bit": {"number": 5}})").part, Part{4});
}

TEST(FieldTable, DefaultsOfOptionalFieldsAreNotWritten) {
    EXPECT_EQ(writeTable(Thing{}).dump(),
              R"({"thing":3,"level_db":-6.0,"part":{"number":0},"sizes":[2.0,3.0]})");
    EXPECT_EQ(writeTable(Thing{0.0, Colour::green, {0}, {{1}}, 1.0, 1.0}).dump(),
              R"({"thing":3,"level_db":0.0,"colour":"green","part":{"number":1},"parts":[{"number":2}],)"
              R"("sizes":[1.0,1.0]})");
}

// Seconds become nanoseconds exactly, whatever way they are written.

std::string written(std::int64_t nanoseconds) {
    std::string text;
    appendSeconds(text, nanoseconds);
    return text;
}

TEST(DecimalSeconds, AreWrittenWithNineDecimals) {
    EXPECT_EQ(written(0), "0.000000000");
    EXPECT_EQ(written(1), "0.000000001");
    EXPECT_EQ(written(250'000'000), "0.250000000");
    EXPECT_EQ(written(12'345'678'901), "12.345678901");
    EXPECT_EQ(written(-1'500'000'000), "-1.500000000");
    EXPECT_EQ(written(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

TEST(DecimalSeconds, ReadBackToTheNanosecond) {
    std::mt19937 random(1);
    for (int i = 0; i < 100'000; ++i) {
        const std::uint64_t high = random();
        const auto range = static_cast<std::uint64_t>(limits::maxTimeNs) + 1;
        const auto nanoseconds = static_cast<std::int64_t>(((high << 32) | random()) % range);
        ASSERT_EQ(parseSeconds(written(nanoseconds)), nanoseconds);
    }
}

TEST(DecimalSeconds, NeverPassThroughADoubleAndRoundHalfToEvenBeyondTheNinthDecimal) {
    for (const auto& [text, nanoseconds] : std::initializer_list<std::pair<const char*, std::int64_t>>{
             {"999999.999999999", 999'999'999'999'999},
             {"123456.789012345", 123'456'789'012'345},
             {"0.30000000000000004", 300'000'000},
             {"0.0000000005", 0},
             {"0.0000000015", 2},
             {"0.0000000025", 2},
             {"0.00000000050000000000000000000000001", 1},
             {"0.00000000149999999999999999999999999", 1},
             {"0.9999999996", 1'000'000'000},
             {"9e-10", 1},
             {"9e-11", 0},
             // short, or with an exponent
             {"7", 7'000'000'000},
             {"7.", 7'000'000'000},
             {".5", 500'000'000},
             {"1e-3", 1'000'000},
             {"1.5E-06", 1'500},
             {"2.5e+2", 250'000'000'000},
             {"000000000000000000000000001", 1'000'000'000},
             {"0e999", 0},
             {"1e-999", 0},
             {"100000000", limits::maxTimeNs},
             {"1e8", limits::maxTimeNs},
             {"100000000.0000000005", limits::maxTimeNs}})
        EXPECT_EQ(parseSeconds(text), nanoseconds) << text;
}

TEST(DecimalSeconds, RefuseWhatIsNoTimeOrBeyondTheLimit) {
    for (const char* text :
         {"",      ".",     "-1",    "-0",   "+1",  "1,5", "1.2.3", "1e", "e5", ".e5",
          "1e+-3", "1e--3", "1e1.5", "0x10", "nan", "inf", "1 ",    " 1", "1s", "1e99999999999",
          "--1",   "1e3e3"})
        EXPECT_EQ(parseSeconds(text), std::nullopt) << text;
    for (const char* text : {"100000000.000000001", "999999999.999999999", "1e9", "1e2147483647",
                             "99999999999999999999999999", "9e18"})
        EXPECT_EQ(parseSeconds(text), std::nullopt) << text;
}

// Tables of words: quotes, comments, and faults named by line.

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

} // namespace physvib::field_table_test
