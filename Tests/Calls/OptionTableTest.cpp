// SPDX-License-Identifier: GPL-3.0-or-later
// What a table of options takes, refuses and shows.
#include "Options/OptionTable.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib {
namespace {

struct Values {
    int count = 3;
    double level = 0.5;
    bool isOn = true, isFlagged = false;
    std::string name = "anna", folder;
    std::vector<std::string> several;
    std::vector<double> pairs;
};

/// A table of one row of each kind.
struct Rig {
    Rig() {
        table.add("name", values.name, "who");
        table.add("--count", values.count, "how many").in(1, 9, " pieces");
        table.add("--level", values.level, "how much").positive();
        table.addSwitch("--light", values.isOn, "on or off");
        table.add("-f,--flag", values.isFlagged, "a flag");
        table.add("--several", values.several, "words").single();
        table.addRead(
            "--half", "2",
            [this](const std::string& word) {
                return word == "2" ? (values.level = 1.0, std::string{}) : "expected 2, found " + word;
            },
            "read");
        table
            .addRow("--all", WordsReader{[this](const std::vector<std::string>& words) {
                        return values.several = words, std::string{};
                    }},
                    "read together")
            .single();
    }
    std::string fault(const std::string& call) { return parseText(table, call).reason(); }
    Values values;
    OptionTable table{"program", "a program"};
};

TEST(OptionTables, ADeprecatedOptionSaysSoOnce) {
    std::string quick = "--quick", program = "program";
    for (const std::string& expected :
         {std::string{"--quick is deprecated: write --speed 2\n"}, std::string{}}) {
        bool isQuick = false;
        OptionTable table{"program", "a program"};
        table.addCommand("run", "runs").add("--quick", isQuick, "soon").deprecated("write --speed 2");
        std::string run = "run";
        char* words[]{program.data(), run.data(), quick.data()};
        testing::internal::CaptureStderr();
        EXPECT_EQ(parseArguments(table, expected.empty() ? 2 : 3, words).fault, "");
        EXPECT_EQ(testing::internal::GetCapturedStderr(), expected);
        EXPECT_EQ(isQuick, !expected.empty());
    }
}

TEST(OptionTables, WhatIsSaidLandsInItsValue) {
    Rig rig;
    EXPECT_EQ(rig.fault("bea --count 9 --level=0.25 --light off -f --several a --several b"), "");
    EXPECT_EQ(rig.values.name, "bea");
    EXPECT_EQ(rig.values.count, 9);
    EXPECT_EQ(rig.values.level, 0.25);
    EXPECT_FALSE(rig.values.isOn);
    EXPECT_TRUE(rig.values.isFlagged);
    EXPECT_EQ(rig.values.several, (std::vector<std::string>{"a", "b"}));
}

TEST(OptionTables, WhatIsNotSaidStaysAsItWas) {
    Rig rig;
    EXPECT_EQ(rig.fault(""), "");
    EXPECT_EQ(rig.values.name, "anna");
    EXPECT_EQ(rig.values.count, 3);
    EXPECT_TRUE(rig.values.isOn);
    EXPECT_EQ(rig.values.level, 0.5);
}

TEST(OptionTables, AReaderSaysWhatItExpectedAndTheTableOfWhat) {
    Rig rig;
    EXPECT_EQ(rig.fault("--half 3"), "--half: expected 2, found 3");
    EXPECT_EQ(rig.fault("--half 2"), "");
    EXPECT_EQ(rig.values.level, 1.0);
    EXPECT_EQ(rig.fault("--all x --all y"), "");
    EXPECT_EQ(rig.values.several, (std::vector<std::string>{"x", "y"}));
}

TEST(OptionTables, WrongWordsAreRefused) {
    Rig rig;
    EXPECT_EQ(rig.fault("--count 10"), "--count: expected 1 to 9 pieces, found \"10\"");
    EXPECT_EQ(rig.fault("--count nan"), "--count: expected 1 to 9 pieces, found \"nan\"");
    EXPECT_EQ(rig.fault("--level nan"), "--level: expected more than 0, found \"nan\"");
    EXPECT_EQ(rig.fault("--level 0"), "--level: expected more than 0, found \"0\"");
    EXPECT_EQ(rig.fault("--light dim"), "--light: dim not in {on,off}");
    EXPECT_EQ(rig.fault("--colour red"), "unknown: --colour");
}

TEST(OptionTables, WhatACallSaidIsKnownAfterwards) {
    Rig rig;
    ASSERT_EQ(rig.fault("--count 4 --light on"), "");
    for (const Option& option : rig.table.options) {
        const bool isSaid = option.spellings.front() == "--count" || option.spellings.front() == "--light";
        EXPECT_EQ(!option.said.empty(), isSaid) << option.spellings.front();
    }
}

TEST(OptionTables, RowsShowWhatTheyTakeAndWhatTheyAreIfNobodySaysIt) {
    Rig rig;
    const auto row = [&](const std::string& name) -> const Option& {
        return *std::ranges::find_if(rig.table.options,
                                     [&](const Option& option) { return option.spellings.back() == name; });
    };
    EXPECT_EQ(row("--count").value(), "INT:1 to 9 pieces");
    EXPECT_EQ(row("--count").initial, "3");
    EXPECT_EQ(row("--light").value(), "TEXT:{on,off}");
    EXPECT_EQ(row("--light").initial, "on");
    EXPECT_EQ(row("--half").initial, "2");
    EXPECT_EQ(row("--flag").value(), "");
}

TEST(OptionTables, TheCommandOfACallIsKnown) {
    OptionTable program{"program", "a program"};
    std::string from, to;
    program.addCommand("take", "takes").add("--from", from, "where");
    program.addCommand("put", "puts").add("--to", to, "where");
    EXPECT_EQ(parseText(program, "put --to there").reason(), "");
    EXPECT_TRUE(program.isCalled("put"));
    EXPECT_EQ(to, "there");
    EXPECT_NE(parseText(program, "").fault, "");
}

} // namespace
} // namespace physvib
