// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib study check`: what nobody should find out by feeling it.
#include "Studies/StudyCheck.h"
#include "Calls.h"
#include "Core/Actuators/Exposure.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include <map>
#include <sstream>

namespace physvib::study_check_test {

class StudyCheckCommand : public test::CommandLine {
protected:
    /// The built-in protocol with some of its text replaced, as mine.json.
    void change(const std::string& protocol,
                const std::vector<std::pair<std::string, std::string>>& edits) const {
        std::string text = call("study show " + protocol).out;
        for (const auto& [from, to] : edits) {
            ASSERT_TRUE(has(text, from));
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
    const auto outcome = runs("study check model-or-sound --participants 20");
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
    EXPECT_TRUE(hasAll(outcome.out,
                       {"warning: condition drop, pair=rubber-concrete size=small height=1",
                        "below the threshold of detection at 80 Hz",
                        "warning: condition drop, pair=steel-steel size=small height=1",
                        "deviation from the thesis, 5.2.1: three experts match the levels", "trials: 135"}));
}

TEST_F(StudyCheckCommand, WhatNeedsTheLimiterIsRefusedWithWhatItWouldNeed) {
    change("model-or-sound", {{"\"level_db\": -8", "\"level_db\": 0"}});
    const auto outcome = call("study check mine.json");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(
        hasAll(outcome.out, {"error: condition drop, pair=wood-wood size=large height=3, SV: peaks 7.",
                             "expected a layout of at least 4."}));
    refuses("study run mine.json --observer simulated --out other", 1, "which the limiter would lower", 1);
}

TEST_F(StudyCheckCommand, WhatTheGuardTurnsDownIsSaid) {
    const auto outcome = runs("study check eight-methods");
    EXPECT_TRUE(has(outcome.out, "AF-FV"));
    int told = 0;
    std::istringstream lines{outcome.out};
    for (std::string line; std::getline(lines, line);)
        if (line.find("nearly direct current") != line.npos) {
            EXPECT_TRUE(has(line, "AF-FV"));
            ++told;
        }
    EXPECT_GT(told, 0);
    EXPECT_FALSE(has(call("study check model-or-sound").out, "nearly direct current"));
}

TEST_F(StudyCheckCommand, ALevelBeyondTheLayoutIsRefused) {
    change("phantom-grids", {{"\"PHONE-3x3\",", "\"PHONE-3x3\", \"level_g\": 5,"}});
    const auto outcome = call("study check mine.json");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(has(outcome.out, "expected at most its full scale of 1 g, found 5.000 g"));
}

TEST_F(StudyCheckCommand, FullScalesThatDifferAreComparedWithTheirOwnActuators) {
    change("model-or-sound", {{"study1", "mixed.json"}, {"\"level_db\": -8", "\"level_db\": 6"}});
    write(
        "mixed.json",
        R"({"extent_m": [0.2, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "full_scale_g": 1}, {"x_m": 0.2, "y_m": 0, "full_scale_g": 10}]})");
    const std::string out = call("study check mine.json").out;
    ASSERT_TRUE(has(out, "error: condition drop, pair=wood-wood size=large height=3, SV at +6.0 dB: peaks "));
    const std::string line = out.substr(
        out.find("error: condition drop, pair=wood-wood size=large height=3, SV at +6.0 dB: peaks "));
    const auto figure = [&](const std::string& before) {
        return std::stod(line.substr(line.find(before) + before.size()));
    };
    EXPECT_NEAR(figure("a layout of at least "), fromDecibels(figure("dB: peaks ")), 0.05)
        << "of the actuator of 1 g, not of the one that moves most: " << line.substr(0, 300);
}

TEST_F(StudyCheckCommand, ThePageHasWhatTheTextHas) {
    runs("study check phantom-grids --participants 18 --page check.html");
    const std::string html = read("check.html"), out = read(".out");
    for (const char* words :
         {"24 of 30 successions occur", "4.1.1: orders of all six conditions by Latin squares",
          "exposure: A(8)", "PHONE-5x5", "orders are not balanced"}) {
        EXPECT_TRUE(has(html, words));
        EXPECT_TRUE(has(out, words));
    }
    EXPECT_FALSE(has(html, "<script"));
    change("phantom-grids", {{"\"repetitions\": 10", "\"repetitions\": 9"}});
    EXPECT_FALSE(has(call("study check mine.json").out, "deviation from the thesis"))
        << "a changed protocol is nobody's";
}

TEST_F(StudyCheckCommand, TheVersionAsPublishedHasOnlyTheDeviationsThatNoProtocolTakesAway) {
    const auto outcome = runs("study check model-or-sound-thesis --participants 20");
    EXPECT_TRUE(has(outcome.out, "deviation from the thesis, 5.2.1: three experts match the levels"));
    EXPECT_TRUE(hasNone(outcome.out, {"impulses are taken when a contact is released", "a decay rings out"}));
    const auto grids = call("study check phantom-grids-thesis --participants 18");
    EXPECT_TRUE(
        has(grids.out,
            "orders: 18 participants: a condition is at one place 3 to 3 times; 30 of 30 successions occur"));
    EXPECT_FALSE(has(grids.out, "orders are not balanced"));
}

TEST_F(StudyCheckCommand, BreaksThatDoNotHappenAreFound) {
    change("phantom-grids", {{"\"break_before_s\": 120", "\"break_before_s\": 0"},
                             {"\"condition_break_s\": 120", "\"condition_break_s\": 0"}});
    EXPECT_TRUE(
        has(call("study check mine.json").out, "warning: breaks: expected one at least every 30 min, found "))
        << read(".out");
    change("model-or-sound", {{"\"break_s\": 180", "\"break_s\": 0"}});
    EXPECT_TRUE(has(call("study check mine.json").out,
                    "warning: breaks of session main: expected break_s above 0 s beside break_every "
                    "54, found none"))
        << read(".out");
    change("model-or-sound", {{"\"break_every\": 54,", ""}});
    EXPECT_TRUE(has(call("study check mine.json").out,
                    "expected break_every beside break_s 180, found none: there is no break"))
        << read(".out");
}

/// Halfway between two actuators half of the acceleration is at each.
TEST_F(StudyCheckCommand, TheExposureIsThatOfAllTrialsInG) {
    const std::string values = R"(["0.05", "0.1", "0.2", "0.4", "0.8"])",
                      place = "--at 0.5,0.5 --seconds 0.5", call = place + " --level-g {level_g}",
                      sessions = R"("repetitions": 5)";
    using Edits = std::vector<std::pair<std::string, std::string>>;
    const auto exposureOf = [&](Edits edits) {
        edits.insert(edits.begin(), {{values, R"(["0.2", "0.6"])"},
                                     {call, "--at 0,0 --seconds 2 --frequency 40 --level-g {level_g}"},
                                     {sessions, R"("repetitions": 200)"},
                                     {"\"pink_noise\": true", "\"exposure_limit_m_per_s2\": 0.2"}});
        change("magnitudes", edits);
        const std::string words = "exposure: A(8) ", out = this->call("study check mine.json").out;
        EXPECT_TRUE(has(out, words)) << out;
        const double told = std::stod(out.substr(std::min(out.size(), out.find(words) + words.size())));
        EXPECT_EQ(has(out, " is above the protocol's limit of 0.2,"), told > 0.2) << told;
        return told;
    };
    const double squares = 200 * 2.0 * (0.2 * 0.2 + 0.6 * 0.6) / 2.0 * std::pow(handWeighting::gain(40.0), 2);
    const double expected = dailyExposure(squares);
    write("two.json", R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "full_scale_g": 3},
                          {"x_m": 0, "y_m": 0.1, "full_scale_g": 3}]})");
    const std::pair<std::string, std::string> onTwo{R"("name": "PHONE")",
                                                    R"("name": "PHONE", "layout": "two.json")"};
    for (const auto& [share, edits] :
         {std::pair{1.0, Edits{}},
          {2.0, {{"200", "800"}}},
          {0.5, {{"--seconds 2", "--seconds 0.5"}}},
          {0.5, {{"0.2", "0.1"}, {"0.6", "0.3"}}},
          {1.0, {onTwo, {"--at", "--layout two.json --at"}}},
          {std::sqrt(0.5), {onTwo, {"--at 0,0", "--layout two.json --at 0,0.5"}}}})
        EXPECT_NEAR(exposureOf(edits), share * expected, 0.02 * share * expected) << share;
}

/// A staircase that moves at every chance has its reversals after the fewest trials.
TEST(StudyRules, TooFewTrialsForTheReversalsAreToldByTheFewestThatDo) {
    for (const int down : {1, 2, 3, 4})
        for (const int reversals : {2, 3, 8, 11}) {
            StaircasePlan plan{.alternative = "b", .down = down, .reversals = reversals, .maxTrials = 1000};
            Staircase stairs{plan, plan.startDb};
            int trials = 0;
            for (bool isRight = false; !stairs.isDone(); isRight = !isRight)
                for (int n = 0; n < (isRight ? down : 1); ++n) stairs.answer(isRight), ++trials;
            for (const int few : {0, 1}) {
                plan.maxTrials = trials - few;
                Protocol p;
                p.conditions = {{"A", "", "phone4", 205.0, 1.0, GridSet{1, 1}}};
                p.sessions = {{.name = "main", .task = StudyTask::choose, .alternatives = {{"a"}, {"b"}}}};
                p.sessions[0].staircase = plan;
                StudyCheck check;
                checkRules(p, check);
                std::vector<std::string> expected;
                if (few == 1)
                    expected = {"session main: staircase: reversals: " + std::to_string(reversals) +
                                " need " + std::to_string(trials) + " trials at least, and most_trials is " +
                                std::to_string(trials - 1)};
                EXPECT_EQ(check.warnings, expected) << down;
            }
        }
}

} // namespace physvib::study_check_test
