// SPDX-License-Identifier: MIT
// A table of fields reads and writes a struct: what it refuses, in which words, and what it leaves out.
#include "Io/Json/FieldJson.h"
#include <array>
#include <gtest/gtest.h>

namespace physvib {
namespace {

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

void visitFields(auto& v, FieldsOf<Part>) { v.field("number", &Part::number, kinds::FromOne{0, 9}); }

struct Sizes {}; // a kind of the module's own
std::pair<double, double> readKind(const JsonField& json, const Sizes&) {
    return {json.item(0).positiveNumber(), json.item(1).positiveNumber()};
}

OrderedJson writeKind(const Sizes&, const auto& sizes) { return sizes; }

void visitFields(auto& v, FieldsOf<Thing>) {
    v.version("thing", 3);
    v.field("level_db", &Thing::level, kinds::within(-60.0, 0.0));
    v.field("colour", &Thing::colour, kinds::OneOf{colourNames}, Need::optional.from(2));
    v.formerly("bit", &Thing::part, kinds::Object<Part>{});
    v.field("part", &Thing::part, kinds::Object<Part>{}, Need::required.from(3));
    v.field("parts", &Thing::parts, kinds::Objects<Part>{2, "parts"}, Need::optional);
    v.field("sizes", both(&Thing::length, &Thing::width), Sizes{}, Need::filled);
}

std::string errorOf(const std::string& fields) {
    return readJson(R"({"thing": 3, )" + fields + "}", "f", 1000,
                    [](const Json& root) {
                        return kinds::Object<Thing>{}(JsonField{root, {}});
                    })
        .error;
}
Thing read(const std::string& text) {
    const Json json = Json::parse(text);
    return kinds::Object<Thing>{}(JsonField{json, {}});
}

TEST(FieldTable, WhatIsWrongIsNamedWithItsPlace) {
    EXPECT_EQ(errorOf(R"("level_db": -61)"), "f: level_db: expected -60 to 0, found -61");
    EXPECT_EQ(errorOf(R"("level": 1)"), "f: unknown field \"level\"") << "before the one that is missing";
    EXPECT_EQ(errorOf(R"("colour": "red")"), "f: field \"level_db\" is missing");
    EXPECT_EQ(errorOf(R"("level_db": 0, "colour": "blue")"),
              "f: colour: expected one of red, green, found \"blue\"");
    EXPECT_EQ(errorOf(R"("level_db": 0, "parts": [{"number": 0}, {"number": 10}])"),
              "f: parts[1].number: expected 0 to 9, found 10");
    EXPECT_EQ(errorOf(R"("level_db": 0, "parts": [{"number": 0}, {"number": 0}, {"number": 0}])"),
              "f: parts: expected at most 2 parts");
    EXPECT_EQ(errorOf(R"("level_db": 0, "part": {})"), "f: part: field \"number\" is missing");
}

TEST(FieldTable, ANewerVersionIsRefusedBeforeItsFields) {
    EXPECT_EQ(readJson(R"({"thing": 4, "new": 1})", "f", 1000,
                       [](const Json& root) {
                           return kinds::Object<Thing>{}(JsonField{root, {}});
                       })
                  .error,
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

} // namespace
} // namespace physvib
