// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib study check`: what nobody should find out by feeling it.
#include "Calls.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include <map>
#include <sstream>

namespace physvib {
namespace {

class StudyCheckCommand : public test::CommandLine {
protected:
    /// The built-in protocol with some of its text replaced, as mine.json.
    void change(const std::string& protocol,
                const std::vector<std::pair<std::string, std::string>>& edits) const {
        std::string text = call("study show " + protocol).out;
        for (const auto& [from, to] : edits) {
            ASSERT_NE(text.find(from), std::string::npos) << from;
            for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
                text.replace(at, from.size(), to);
        }
        write("mine.json", text);
    }
    /// Peaks in g by "stimulus part".
    static std::map<std::string, double> peaksOf(const std::string& out) {
        std::map<std::string, double> peaks;
        std::istringstream lines{out};
        for (std::string line; std::getline(lines, line) && !line.empty();) {
            std::vector<std::string> cells;
            std::istringstream row{line};
            for (std::string cell; std::getline(row, cell, '\t');) cells.push_back(cell);
            if (cells.size() > 4 && cells[0] != "condition")
                peaks[cells[1] + " " + cells[2]] = parseNumber<double>(cells[4]).value_or(0.0);
        }
        return peaks;
    }
};

TEST_F(StudyCheckCommand, EveryConditionOfTheFallingObjectsKeepsItsDistancesBelowTheLimiter) {
    const auto outcome = call("study check model-or-sound --participants 20");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    auto peaks = peaksOf(outcome.out);
    ASSERT_EQ(peaks.size(), 54u);
    for (const char* pair : {"rubber-concrete", "wood-wood", "steel-steel"})
        for (const char* size : {"small", "medium", "large"})
            for (const std::string part : {"AV-FV-DRV", "SV"}) {
                const auto at = [&](const char* height) {
                    return toDecibels(peaks.at(std::string{"pair="} + pair + " size=" + size +
                                               " height=" + height + " " + part));
                };
                // Eq. 5.4: as the root of the height
                EXPECT_NEAR(at("2") - at("1"), 3.01, 0.1) << pair << size << part;
                EXPECT_NEAR(at("3") - at("1"), 4.77, 0.1) << pair << size << part;
            }
    EXPECT_NE(outcome.out.find("warning: condition drop, pair=rubber-concrete size=small height=1"),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("below the threshold of detection at 80 Hz"), std::string::npos);
    EXPECT_NE(outcome.out.find("warning: condition drop, pair=steel-steel size=small height=1"),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("deviation from the thesis, 5.2.1: three experts match the levels"),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("trials: 135"), std::string::npos);
}

TEST_F(StudyCheckCommand, WhatNeedsTheLimiterIsRefusedWithWhatItWouldNeed) {
    change("model-or-sound", {{"\"level_db\": -8", "\"level_db\": 0"}});
    const auto outcome = call("study check mine.json");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.out.find("error: condition drop, pair=wood-wood size=large height=3, SV: peaks 7."),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("expected a layout of at least 4."), std::string::npos) << outcome.out;
    refuses("study run mine.json --observer simulated --out other", 1, "which the limiter would lower", 1);
}

TEST_F(StudyCheckCommand, WhatTheGuardTurnsDownIsSaid) {
    const auto outcome = call("study check eight-methods");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("AF-FV"), std::string::npos);
    int told = 0;
    std::istringstream lines{outcome.out};
    for (std::string line; std::getline(lines, line);)
        if (line.find("nearly direct current") != line.npos) {
            EXPECT_NE(line.find("AF-FV"), line.npos) << line;
            ++told;
        }
    EXPECT_GT(told, 0);
    EXPECT_EQ(call("study check model-or-sound").out.find("nearly direct current"), std::string::npos);
}

TEST_F(StudyCheckCommand, ALevelBeyondTheLayoutIsRefused) {
    change("phantom-grids", {{"\"PHONE-3x3\",", "\"PHONE-3x3\", \"level_g\": 5,"}});
    const auto outcome = call("study check mine.json");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.out.find("expected at most its full scale of 1 g, found 5.000 g"), std::string::npos)
        << outcome.out;
}

TEST_F(StudyCheckCommand, FullScalesThatDifferAreComparedWithTheirOwnActuators) {
    change("model-or-sound", {{"study1", "mixed.json"}, {"\"level_db\": -8", "\"level_db\": 6"}});
    write(
        "mixed.json",
        R"({"extent_m": [0.2, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "full_scale_g": 1}, {"x_m": 0.2, "y_m": 0, "full_scale_g": 10}]})");
    const std::string out = call("study check mine.json").out;
    ASSERT_NE(out.find("error: condition drop, pair=wood-wood size=large height=3, SV at +6.0 dB: peaks "),
              std::string::npos)
        << out;
    const std::string line = out.substr(
        out.find("error: condition drop, pair=wood-wood size=large height=3, SV at +6.0 dB: peaks "));
    const auto figure = [&](const std::string& before) {
        return std::stod(line.substr(line.find(before) + before.size()));
    };
    EXPECT_NEAR(figure("a layout of at least "), fromDecibels(figure("dB: peaks ")), 0.05)
        << "of the actuator of 1 g, not of the one that moves most: " << line.substr(0, 300);
}

TEST_F(StudyCheckCommand, ThePageHasWhatTheTextHas) {
    ASSERT_EQ(call("study check phantom-grids --participants 18 --page check.html").exitCode, 0);
    const std::string html = read("check.html"), out = read(".out");
    for (const char* words :
         {"24 of 30 successions occur", "4.1.1: orders of all six conditions by Latin squares",
          "exposure: A(8)", "PHONE-5x5", "orders are not balanced"}) {
        EXPECT_NE(html.find(words), std::string::npos) << words;
        EXPECT_NE(out.find(words), std::string::npos) << words;
    }
    EXPECT_EQ(html.find("<script"), std::string::npos);
    change("phantom-grids", {{"\"repetitions\": 10", "\"repetitions\": 9"}});
    EXPECT_EQ(call("study check mine.json").out.find("deviation from the thesis"), std::string::npos)
        << "a changed protocol is nobody's";
}

TEST_F(StudyCheckCommand, TheVersionAsPublishedHasOnlyTheDeviationsThatNoProtocolTakesAway) {
    const auto outcome = call("study check model-or-sound-thesis --participants 20");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("deviation from the thesis, 5.2.1: three experts match the levels"),
              std::string::npos)
        << outcome.out;
    EXPECT_EQ(outcome.out.find("impulses are taken when a contact is released"), std::string::npos);
    EXPECT_EQ(outcome.out.find("a decay rings out"), std::string::npos);
    const auto grids = call("study check phantom-grids-thesis --participants 18");
    EXPECT_NE(
        grids.out.find(
            "orders: 18 participants: a condition is at one place 3 to 3 times; 30 of 30 successions occur"),
        std::string::npos)
        << grids.out;
    EXPECT_EQ(grids.out.find("orders are not balanced"), std::string::npos);
}

TEST_F(StudyCheckCommand, BreaksThatDoNotHappenAreFound) {
    change("phantom-grids", {{"\"break_before_s\": 120", "\"break_before_s\": 0"},
                             {"\"condition_break_s\": 120", "\"condition_break_s\": 0"}});
    EXPECT_NE(
        call("study check mine.json").out.find("warning: breaks: expected one at least every 30 min, found "),
        std::string::npos)
        << read(".out");
    change("model-or-sound", {{"\"break_s\": 180", "\"break_s\": 0"}});
    EXPECT_NE(call("study check mine.json")
                  .out.find("warning: breaks of session main: expected break_s above 0 s beside break_every "
                            "54, found none"),
              std::string::npos)
        << read(".out");
    change("model-or-sound", {{"\"break_every\": 54,", ""}});
    EXPECT_NE(call("study check mine.json")
                  .out.find("expected break_every beside break_s 180, found none: there is no break"),
              std::string::npos)
        << read(".out");
}

TEST_F(StudyCheckCommand, OrdersAndBreaksAreCounted) {
    const auto patterns = call("study check patterns --participants 5");
    EXPECT_EQ(patterns.exitCode, 0) << patterns.err;
    EXPECT_NE(patterns.out.find("orders: 5 participants"), std::string::npos) << patterns.out;
    EXPECT_NE(patterns.out.find("warning: orders are not balanced: 5 participants"), std::string::npos);
}

} // namespace
} // namespace physvib
