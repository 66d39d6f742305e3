// SPDX-License-Identifier: MIT
// Layouts survive writing and reading to the bit, and a bad one is named by its field.
#include "Scene/LayoutFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Scene/SceneLimits.h"
#include "Support/FileTesting.h"
#include <algorithm>
#include <set>

namespace physvib::layout_file_test {

std::string layoutWith(const std::string& enchanters) {
    return R"({"name": "mine", "extent_m": [0.12, 0.06], "enchanters": [)" + enchanters + "]}";
}

LayoutDescription readGood(const std::string& text) {
    Result<LayoutDescription> read = readLayout(text, "my.json");
    EXPECT_EQ(read.error, "") << text;
    return std::move(read.value);
}

bool isOneLine(const std::string& text) {
    return std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

bool isEmpty(const LayoutDescription& layout) {
    return layout.name.empty() && layout.actuators.empty() && layout.geometry.count == 0 &&
           layout.geometry.extentWidthMetres == 0.0;
}

std::string errorOf(const std::string& text) {
    const Result<LayoutDescription> read = readLayout(text, "my.json");
    EXPECT_FALSE(read) << text;
    EXPECT_TRUE(isEmpty(read.value));
    EXPECT_TRUE(isOneLine(read.error)) << read.error;
    EXPECT_LT(read.error.size(), 300u);
    return read.error;
}

std::string errorOfEnchanter(const std::string& fields) {
    return errorOf(layoutWith(R"({"x_m": 0, "y_m": 0}, {)" + fields + "}"));
}

std::vector<std::string> labelsOf(const LayoutDescription& layout) {
    std::vector<std::string> labels;
    for (const ActuatorDescription& enchanter : layout.actuators) labels.push_back(enchanter.label);
    return labels;
}

double share(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

LayoutDescription randomLayout(std::mt19937& random) {
    LayoutDescription layout;
    layout.name = "n\"\\\xc3\xa4" + std::to_string(random());
    layout.geometry.extentWidthMetres = limits::minExtentMetres + share(random);
    layout.geometry.extentHeightMetres = limits::maxExtentMetres * (1.0 - 0.9 * share(random));
    layout.geometry.count = 1 + static_cast<int>(anyIndex(random, limits::maxActuators));
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.geometry.count); ++j) {
        layout.geometry.places[j] = {layout.geometry.extentWidthMetres * share(random),
                                     layout.geometry.extentHeightMetres * share(random)};
        layout.actuators.push_back(
            {"L" + std::to_string(j), "lra-205", limits::minFullScaleG + share(random)});
    }
    return layout;
}

void expectSame(const LayoutDescription& a, const LayoutDescription& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.geometry.extentWidthMetres, b.geometry.extentWidthMetres);
    EXPECT_EQ(a.geometry.extentHeightMetres, b.geometry.extentHeightMetres);
    EXPECT_TRUE(a.actuators == b.actuators);
    ASSERT_EQ(a.geometry.count, b.geometry.count);
    for (std::size_t j = 0; j < a.geometry.places.size(); ++j) {
        EXPECT_EQ(a.geometry.places[j].xMetres, b.geometry.places[j].xMetres) << j;
        EXPECT_EQ(a.geometry.places[j].yMetres, b.geometry.places[j].yMetres) << j;
        EXPECT_EQ(a.geometry.places[j].zMetres, b.geometry.places[j].zMetres) << j;
        EXPECT_EQ(a.geometry.places[j].part, b.geometry.places[j].part) << j;
    }
}

TEST(LayoutFile, ReadsTheFormOfTheInterface) {
    const LayoutDescription layout = readGood(R"({ "name": "two", "extent_m": [0.12, 0.06], "enchanters": [
        { "label": "L", "x_m": 0, "y_m": 0.03, "actuator": "lra-205", "full_scale_g": 1.5 },
        { "label": "R", "x_m": 0.12, "y_m": 0.06, "actuator": "haptuator-2", "full_scale_g": 3 } ] })");
    EXPECT_EQ(layout.name, "two");
    EXPECT_EQ(layout.geometry.count, 2);
    EXPECT_EQ(layout.geometry.extentWidthMetres, 0.12);
    EXPECT_EQ(layout.geometry.extentHeightMetres, 0.06);
    EXPECT_EQ(layout.geometry.places[1].xMetres, 0.12);
    EXPECT_EQ(layout.geometry.places[0].yMetres, 0.03);
    EXPECT_TRUE((layout.actuators ==
                 std::vector<ActuatorDescription>{{"L", "lra-205", 1.5}, {"R", "haptuator-2", 3.0}}));
    EXPECT_TRUE(isValid(layout.geometry));
}

TEST(LayoutFile, WritesOneEnchanterPerLineInAFixedOrder) {
    EXPECT_EQ(layoutJson(presetLayout("phone2")), R"({
  "name": "phone2",
  "extent_m": [0.12, 0.06],
  "enchanters": [
    { "label": "A", "x_m": 0, "y_m": 0.03, "actuator": "none", "full_scale_g": 1 },
    { "label": "B", "x_m": 0.12, "y_m": 0.03, "actuator": "none", "full_scale_g": 1 }
  ]
}
)");
}

TEST(LayoutFile, WriteThenReadGivesTheSameBits) {
    std::mt19937 random(20);
    for (int i = 0; i < 200; ++i) {
        const LayoutDescription layout = randomLayout(random);
        expectSame(readGood(layoutJson(layout)), layout);
        EXPECT_EQ(layoutJson(readGood(layoutJson(layout))), layoutJson(layout));
    }
}

TEST(LayoutFile, NegativeZeroSurvives) {
    const std::string text = layoutJson(readGood(layoutWith(R"({"x_m": -0.0, "y_m": -0.0})")));
    EXPECT_NE(text.find(R"("x_m": -0.0)"), std::string::npos) << text;
    EXPECT_EQ(layoutJson(readGood(text)), text);
}

TEST(LayoutFile, EveryPresetSurvives) {
    for (const std::string_view name : layoutPresetNames)
        expectSame(readGood(layoutJson(presetLayout(name))), presetLayout(name));
}

TEST(LayoutFile, DepthAndPartAreWrittenWhereThereAreAny) {
    const LayoutDescription layout = readGood(layoutWith(
        R"({"x_m": 0, "y_m": 0, "z_m": -0.25, "part": "left elbow"}, {"x_m": 0.1, "y_m": 0, "part": "palm"})"));
    EXPECT_EQ(layout.geometry.places[0].zMetres, -0.25);
    EXPECT_EQ(layout.geometry.places[0].part, partNamed("left elbow"));
    EXPECT_EQ(layout.actuators[1].part, "palm");
    EXPECT_FALSE(isFlat(layout.geometry));
    const std::string text = layoutJson(layout);
    EXPECT_NE(text.find(R"("z_m": -0.25, "part": "left elbow", "actuator")"), std::string::npos) << text;
    EXPECT_NE(text.find(R"("y_m": 0, "part": "palm", "actuator")"), std::string::npos) << text;
    EXPECT_EQ(layoutJson(readGood(text)), text);
    // who knows the places alone knows the built-in names, and else the number
    const LayoutDescription again = describeLayout("again", layout.geometry);
    EXPECT_EQ(again.actuators[0].part, "part-" + std::to_string(partNamed("left elbow")));
    EXPECT_EQ(again.actuators[1].part, "palm");
    EXPECT_EQ(readGood(layoutJson(again)).geometry.places[0].part, partNamed("left elbow"));
    EXPECT_EQ(errorOfEnchanter(R"("x_m": 0, "y_m": 0, "part": "")"),
              "my.json: enchanters[1].part: expected a name, found an empty string");
    EXPECT_EQ(errorOfEnchanter(R"("x_m": 0, "y_m": 0, "z_m": "up")"),
              "my.json: enchanters[1].z_m: expected a number, found a string");
}

TEST(LayoutFile, MissingFieldsHaveDefaults) {
    const LayoutDescription layout =
        readGood(R"({"extent_m": [1, 1], "enchanters": [{"x_m": 1, "y_m": 0}]})");
    EXPECT_EQ(layout.name, "");
    EXPECT_TRUE((layout.actuators == std::vector<ActuatorDescription>{{"A", "none", 1.0}}));
}

TEST(LayoutFile, MissingLabelsTakeTheFirstFreeLetters) {
    const std::string none = R"({"x_m": 0, "y_m": 0})";
    const std::string b = R"({"x_m": 0, "y_m": 0, "label": "B"})";
    EXPECT_EQ(labelsOf(readGood(layoutWith(none + "," + b + "," + none))),
              (std::vector<std::string>{"A", "B", "C"}));
    EXPECT_EQ(labelsOf(readGood(layoutWith(none + "," + none + "," + b))),
              (std::vector<std::string>{"A", "C", "B"}));
}

TEST(LayoutFile, SixtyFourEnchantersAreLabelledLikeColumns) {
    std::string list = R"({"x_m": 0, "y_m": 0})";
    for (int j = 1; j < limits::maxActuators; ++j) list += R"(,{"x_m": 0, "y_m": 0})";
    const std::vector<std::string> labels = labelsOf(readGood(layoutWith(list)));
    EXPECT_EQ(labels[25], "Z");
    EXPECT_EQ(labels[26], "AA");
    EXPECT_EQ(labels[63], "BL");
    EXPECT_EQ(std::set<std::string>(labels.begin(), labels.end()).size(), 64u);
    EXPECT_EQ(errorOf(layoutWith(list + R"(,{"x_m": 0, "y_m": 0})")),
              "my.json: enchanters: expected at most 64 actuators, found 65");
}

TEST(LayoutFile, NamesTheFieldOfAnEnchanter) {
    const std::string place = R"("x_m": 0, "y_m": 0, )";
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"("x_m": "0", "y_m": 0)", ".x_m: expected a number, found a string"},
        {R"("x_m": null, "y_m": 0)", ".x_m: expected a number, found null"},
        {R"("x_m": 0, "y_m": true)", ".y_m: expected a number, found a boolean"},
        {R"("x_m": 0, "y_m": [])", ".y_m: expected a number, found an array"},
        {R"("x_m": 0)", ": field \"y_m\" is missing"},
        {R"("x_m": 0.13, "y_m": 0)", ".x_m: expected a number from 0 to 0.12, found 0.13"},
        {R"("x_m": 0, "y_m": -0.01)", ".y_m: expected a number from 0 to 0.06, found -0.01"},
        {place + R"("w_m": 0)", ": unknown field \"w_m\""},
        {place + R"("label": 1)", ".label: expected a string, found a number"},
        {place + R"("label": "")", ".label: expected a label, found an empty string"},
        {place + R"("label": "a\nb")", R"(.label: expected text without control characters, found "a\x0ab")"},
        {place + R"("label": ")" + std::string(201, 'x') + "\"",
         ".label: expected at most 200 bytes, found 201"},
        {place + R"("actuator": {})", ".actuator: expected a string, found an object"},
        {place + R"("full_scale_g": 0)", ".full_scale_g: expected 1e-06 to 1e+06, found 0"},
        {place + R"("full_scale_g": -1.5)", ".full_scale_g: expected 1e-06 to 1e+06, found -1.5"},
        {R"("x_m": 0, "x_m": 0)", ": field \"x_m\" appears twice"},
    };
    for (const auto& [fields, message] : cases)
        EXPECT_EQ(errorOfEnchanter(fields), "my.json: enchanters[1]" + message);
}

TEST(LayoutFile, LabelsAreUnique) {
    EXPECT_EQ(
        errorOf(layoutWith(R"({"label": "A", "x_m": 0, "y_m": 0}, {"label": "A", "x_m": 0, "y_m": 0})")),
        "my.json: enchanters[1].label: expected a label of its own, found \"A\" again");
}

TEST(LayoutFile, NamesTheFieldOfTheLayout) {
    const std::string list = R"("enchanters": [{"x_m": 0, "y_m": 0}])";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"[]", "expected an object, found an array"},
        {"3", "expected an object, found a number"},
        {"{}", "field \"extent_m\" is missing"},
        {R"({"extent_m": [1, 1]})", "field \"enchanters\" is missing"},
        {R"({"extent_m": [1, 1], "enchanters": []})", "enchanters: expected at least 1 actuator, found none"},
        {R"({"extent_m": [1, 1], "enchanters": {}})", "enchanters: expected an array, found an object"},
        {R"({"extent_m": [1, 1], "enchanters": [7]})", "enchanters[0]: expected an object, found a number"},
        {R"({"extent_m": [1], )" + list + "}", "extent_m: expected [width, height], found 1 items"},
        {R"({"extent_m": 1, )" + list + "}", "extent_m: expected an array, found a number"},
        {R"({"extent_m": [0, 1], )" + list + "}", "extent_m[0]: expected 0.001 to 1e+06, found 0"},
        {R"({"extent_m": [1, -2], )" + list + "}", "extent_m[1]: expected 0.001 to 1e+06, found -2"},
        {R"({"extent_m": [1, "2"], )" + list + "}", "extent_m[1]: expected a number, found a string"},
        {R"({"name": 1, "extent_m": [1, 1], )" + list + "}", "name: expected a string, found a number"},
        {R"({"colour": 1, "extent_m": [1, 1], )" + list + "}", "unknown field \"colour\""},
        {R"({"name": "a", "name": "b", "extent_m": [1, 1], )" + list + "}", "field \"name\" appears twice"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(errorOf(text), "my.json: " + message);
}

TEST(LayoutFile, SyntaxErrorsNameLineAndColumn) {
    EXPECT_TRUE(errorOf("").starts_with("my.json: line 1, column 1: ")) << errorOf("");
    EXPECT_TRUE(errorOf("{\n  \"name\": oops\n}").starts_with("my.json: line 2, column 11: "))
        << errorOf("{\n  \"name\": oops\n}");
    EXPECT_TRUE(errorOf("{} {}").starts_with("my.json: line 1, column 4: ")) << errorOf("{} {}");
    EXPECT_TRUE(errorOf("{\"name\": \"\xff\"}").starts_with("my.json: line 1, column 11: "))
        << errorOf("{\"name\": \"\xff\"}");
    EXPECT_EQ(errorOf("[1e999]"), "my.json: number overflow parsing '1e999'");
    EXPECT_NE(errorOf("[" + std::string(100'000, '9') + "e999]"), "");
    EXPECT_NE(errorOf("{\"" + std::string(100'000, 'k') + "\": 0}"), "");
    EXPECT_NE(errorOf("\"" + std::string(100'000, 'k')), "");
}

TEST(LayoutFile, DeepNestingIsRefusedNotFollowed) {
    const std::string deep(1'000'000, '[');
    EXPECT_EQ(errorOf(deep), "my.json: nested deeper than 16 levels");
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    EXPECT_EQ(errorOf(objects), "my.json: nested deeper than 16 levels");
    EXPECT_EQ(errorOf(std::string(16, '[') + std::string(16, ']')),
              "my.json: expected an object, found an array");
}

TEST(LayoutFile, RepeatedFieldsAreNamedByTheirPath) {
    EXPECT_EQ(errorOf(R"({"a": [0, [], {"b": {"c": 1, "d": {}, "c": 2}}]})"),
              "my.json: a[2].b: field \"c\" appears twice");
    EXPECT_EQ(errorOf("{\"a\\n\": {\"b\": 1, \"b\": 2}}"), "my.json: a\\x0a: field \"b\" appears twice");
    EXPECT_EQ(errorOf("{\"" + std::string(5000, 'k') + "\": {\"b\": 1, \"b\": 2}}"),
              "my.json: " + std::string(40, 'k') + "...: field \"b\" appears twice");
    std::string nested = R"({"b": 1, "b": 2})";
    for (int depth = 0; depth < 14; ++depth)
        nested = "{\"" + std::string(40, static_cast<char>('a' + depth)) + "\": " + nested + "}";
    EXPECT_LT(errorOf(nested).size(), 200u) << errorOf(nested); // however long the names
}

TEST(LayoutFile, NoMutationCrashesOrHalfLoads) {
    const std::string good = layoutJson(presetLayout("phone3"));
    std::mt19937 random(21);
    int accepted = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Result<LayoutDescription> read =
            readLayout(mutated(good, "0123456789,.-eE{}[]\":\\un \n\xEF", random), "my.json");
        ASSERT_TRUE(isOneLine(read.error)) << read.error;
        if (!read) {
            ASSERT_TRUE(isEmpty(read.value));
            ASSERT_TRUE(read.error.starts_with("my.json: ")) << read.error;
            continue;
        }
        ++accepted;
        ASSERT_TRUE(isValid(read.value.geometry));
        ASSERT_EQ(read.value.actuators.size(), static_cast<std::size_t>(read.value.geometry.count));
        expectSame(readGood(layoutJson(read.value)), read.value);
    }
    EXPECT_GT(accepted, 100);
    EXPECT_LT(accepted, 19'000);
}

TEST(LayoutFile, NoTruncationLoads) {
    const std::string good = layoutJson(presetLayout("ring4"));
    for (std::size_t length = 0; length + 1 < good.size(); ++length) errorOf(good.substr(0, length));
}

TEST(LayoutFile, TextThatIsNotUtf8IsWrittenReadably) {
    LayoutDescription layout = describeLayout("a\xff", ActuatorLayout{1.0, 1.0, 1, {}});
    EXPECT_EQ(readGood(layoutJson(layout)).name, "a\xEF\xBF\xBD");
}

TEST(LayoutFile, ACommaLocaleChangesNothing) {
    std::mt19937 random(22);
    const LayoutDescription layout = randomLayout(random);
    const std::string text = layoutJson(layout);
    const CommaLocale comma;
    EXPECT_EQ(layoutJson(layout), text);
    expectSame(readGood(text), layout);
    EXPECT_EQ(errorOfEnchanter(R"("x_m": 1234.5, "y_m": 0)"),
              "my.json: enchanters[1].x_m: expected a number from 0 to 0.12, found 1234.5");
    if (!comma.hasCLocale)
        GTEST_SKIP() << "no C locale with a decimal comma here; tried with C++ streams only";
}

using LayoutFileOnDiskTest = FolderTest;

TEST_F(LayoutFileOnDiskTest, LoadsWhatWasWrittenAndNamesTheFileInErrors) {
    std::mt19937 random(23);
    const LayoutDescription layout = randomLayout(random);
    ASSERT_EQ(writeFile(folder / "my.json", layoutJson(layout)), "");
    expectSame(loadLayout(folder / "my.json").value, layout);
    ASSERT_EQ(writeFile(folder / "my.json", "{}"), "");
    EXPECT_EQ(loadLayout(folder / "my.json").error,
              (folder / "my.json").string() + ": field \"extent_m\" is missing");
    EXPECT_EQ(loadLayout(folder / "none.json").error,
              (folder / "none.json").string() + ": cannot be read: No such file or directory");
    ASSERT_EQ(writeFile(folder / "big.json", std::string(1'000'001, ' ')), "");
    EXPECT_EQ(loadLayout(folder / "big.json").error,
              (folder / "big.json").string() + ": expected at most 1000000 bytes, found more");
}

} // namespace physvib::layout_file_test
