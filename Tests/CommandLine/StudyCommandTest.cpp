// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib study`: the thesis' studies run whole by the observer, cut off, and analysed.
#include "Calls.h"
#include "Io/Text/CsvTable.h"
#include "TestPlaces.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace physvib::study_command_test {

class Study : public test::CommandLine {
protected:
    /// Runs a study of that many participants; the names of their files.
    std::string run(const std::string& protocol, int participants,
                    const std::string& more = "--observer simulated") const {
        EXPECT_TRUE(
            has(runs("study run " + protocol + " --participants " + std::to_string(participants) + " " + more)
                    .out,
                "SIMULATED"));
        std::string names;
        for (int n = 1; n <= participants; ++n) names += " " + protocol + "-P0" + std::to_string(n) + ".csv";
        return names;
    }
    /// The analysis succeeds, marks the data as simulated, and leaves a picture.
    std::string analyse(const std::string& kind, const std::string& files) const {
        const auto outcome =
            runs("analyse " + kind + files + " --picture " + kind + ".svg --export " + kind + "-export.csv");
        EXPECT_TRUE(outcome.out.starts_with("SIMULATED")) << outcome.out;
        EXPECT_TRUE(read(kind + ".svg").starts_with("<svg "));
        EXPECT_FALSE(has(outcome.out, "nan"));
        return outcome.out;
    }
};

TEST_F(Study, PatternsWhole) {
    const std::string out = analyse("confusion", run("patterns", 3));
    EXPECT_TRUE(hasAll(test::squeezed(out), {"\nPHONE-2 28 84 ", "\nRING-4 168 504 "}));
    EXPECT_TRUE(has(call("analyse icons patterns-P01.csv patterns-P02.csv --meanings 24").out, "enough"));
}

#if !defined(_WIN32) // where there is always one
TEST_F(Study, WithoutADisplayNoPersonAnswersAndItSaysWhere) {
    unsetenv("DISPLAY");
    for (const char* observer : {"", " --observer person"})
        refuses(
            std::string{"study run magnitudes"} + observer, 2,
            "physvib-mixer shows a person what to answer; its tab Studies has the protocol \"magnitudes\"");
    refuses("study run magnitudes --participants 2", 2,
            "--participants: expected one at a time where a person answers");
    refuses("study run model-or-sound --sound 80=hit.wav", 2,
            "--sound: expected sounds in the protocol where a person answers");
}
#endif

TEST_F(Study, PhantomGridsWhole) {
    const std::string files = run("phantom-grids", 2, "--observer simulated-RING");
    EXPECT_TRUE(has(test::squeezed(analyse("confusion", files)), "\nRING-5x5 25 500 4 "));
    EXPECT_TRUE(
        has(test::squeezed(call("analyse confusion" + files + " --tolerance 1").out), "\nPHONE-3x3 9 180 "));
}

TEST_F(Study, PlacesChoicesAndRatingsWhole) {
    for (const auto& [kind, files, lines] :
         {std::tuple{
              "resolution", run("phantom-places", 4, "--observer simulated-RING"),
              std::vector{"\nPHONE-LINEAR ", "\nPHONE-LOGARITHM ", "\nRING-LINEAR ", "\nRING-LOGARITHM "}},
          {"choices", run("model-or-sound", 3), {"\nall AV-FV-DRV ", " 324 3 ", "\nsize=small "}},
          {"ratings", run("eight-methods", 2), {"\nAV-FV-DRV realism 20 2 "}}})
        for (const std::string out = test::squeezed(analyse(kind, files)); const char* line : lines)
            EXPECT_TRUE(has(out, line));
}

TEST_F(Study, RecordingsOfTheCallStandInEveryRowAndWhatIsSyntheticIsNamed) {
    runs("render drop --layout phone1 --set pair=wood-wood --seconds 2 --out wood.wav");
    runs("study run model-or-sound --observer simulated --sound 349=wood.wav");
    const auto table = readCsvTable(read("model-or-sound-P01.csv"), "rows").value;
    std::string last;
    for (const auto& row : table.rows) {
        const std::string& calls = row.cells[*table.column("render")];
        const auto sv = calls.find("--method SV --sound-match rms --level-db -8 --sound 80=synthetic-1 "
                                   "--sound 430=synthetic-1 --sound 349=wood.wav");
        ASSERT_NE(sv, std::string::npos) << calls;
        const auto model = calls.find("--method AV-FV-DRV --sound-match rms --level-db ");
        ASSERT_NE(model, std::string::npos) << calls;
        last = calls.substr(std::min(model, sv) == model ? 0 : calls.find(" ; ") + 3);
        last = last.substr(0, last.find(" ; "));
    }
    runs(last + " --out again.wav");
    // the model at its matched level
    refuses("study run model-or-sound --observer simulated --out other --sound 349=gone.wav", 1,
            "gone.wav: cannot be read", 3);
    refuses("study run model-or-sound --observer simulated --out other --sound gone.wav", 2,
            "--sound: expected MATERIAL=FILE.wav", 3);
}

TEST_F(Study, EveryTrialCarriesWhatRendersItAgain) {
    run("phantom-grids", 1);
    run("patterns", 1);
    for (const char* name : {"phantom-grids-P01.csv", "patterns-P01.csv"}) {
        const auto table = readCsvTable(read(name), name);
        ASSERT_TRUE(table) << table.error;
        const auto render = *table.value.column("render");
        for (std::size_t i = 3; i < table.value.rows.size(); i += 397) {
            const std::string& again = table.value.rows[i].cells[render];
            runs(again + " --out again.wav");
            EXPECT_EQ(read("again.wav").substr(0, 4), "RIFF");
        }
    }
}

TEST_F(Study, CutOffInTheMiddleOfARowItGoesOnAndTheFileIsTheSame) {
    const std::string study = "study run patterns --observer simulated", file = "patterns-P01.csv";
    runs(study);
    const std::string whole = read(file);
    write(file, whole.substr(0, whole.find('\n', whole.size() / 2) + 17));
    EXPECT_TRUE(has(runs(study).out, "of them there before"));
    EXPECT_EQ(read(file), whole);
}

TEST_F(Study, ProtocolsOfOnesOwnNeedNoCode) {
    write("mine.json", runs("study show level-steps").out);
    runs("study run mine.json --observer simulated --participant anna_1");
    EXPECT_TRUE(has(read("level-steps-anna_1.csv"), ",choose,"));
    runs("study run magnitudes --observer simulated");
    EXPECT_TRUE(has(read("magnitudes-P01.csv"), ",estimate,"));
    EXPECT_TRUE(has(test::squeezed(analyse("levels", " level-steps-anna_1.csv")),
                    "\nthreshold by staircase (dB) PHONE "));
    runs("study run level-quest --observer simulated --participants 2");
    const auto quest = test::squeezed(analyse("levels", " level-quest-P01.csv level-quest-P02.csv"));
    EXPECT_TRUE(has(quest, "\nthreshold by QUEST+ (dB; interval: t and error of the widths) PHONE "));
    EXPECT_TRUE(has(test::squeezed(analyse("levels", " magnitudes-P01.csv")),
                    "\ngeometric mean magnitude (SD of log10) PHONE 0.4 "));
    EXPECT_EQ(std::ranges::count(call("study list").out, '\n'), 13) << "eight, and five as published";
}

TEST_F(Study, FilesOfAProtocolAreFoundBesideItAndTheFolderOfRowsIsMade) {
    std::filesystem::create_directories(folder_ / "mine");
    std::filesystem::copy(PHYSVIB_SOURCE_DIR "/Source/Scene/Actuators/lra-205.json",
                          folder_ / "mine/coil.json");
    write(
        "mine/glove.json",
        R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "actuator": "coil.json"}, {"x_m": 0.1, "y_m": 0, "actuator": "coil.json"}]})");
    write(
        "mine/study.json",
        R"({ "physvib_protocol": 1, "name": "study", "conditions": [{ "name": "A", "layout": "glove.json", "at_resonance": true, "stimuli": "grid", "columns": 2, "rows": 1 }], "sessions": [{ "name": "main" }] })");
    runs("study run mine/study.json --observer simulated --out rows/today");
    EXPECT_TRUE(has(read("rows/today/study-P01.csv"), "--layout glove.json"))
        << "the row's call is one for the protocol's folder";
    std::filesystem::remove(folder_ / "mine/glove.json");
    refuses("study run mine/study.json --observer simulated --out rows/tomorrow", 1,
            "glove.json: cannot be read", 2);
}

TEST_F(Study, RendersCanBeCutAsThePublishedOnesWere) {
    runs("render drop --seconds 1 --layout phone1 --out whole.wav");
    runs("render drop --seconds 1 --layout phone1 --gamma 0.1 --out cut.wav");
    EXPECT_NE(read("whole.wav"), read("cut.wav"));
    refuses("render drop --gamma 1 --out a.wav", 2, "--gamma: expected 0 to 0.99", 2);
    runs("render drop --seconds 1 --layout phone1 --method SV --sound 80=synthetic-1 --out sound.wav");
    runs("render drop --seconds 1 --layout phone1 --method SV --sound 80=synthetic-1 --gamma 0.1 "
         "--out uncut.wav");
    const std::string sound = read("sound.wav"), uncut = read("uncut.wav");
    EXPECT_TRUE(sound.substr(sound.find("data")) == uncut.substr(uncut.find("data")))
        << "recordings are played whole";
}

TEST_F(Study, ExpertsSetTheLevelsThatTheMainStudyReads) {
    const std::string conditions =
        R"("sounds": [{ "frequency_hz": 80, "file": "synthetic-1" }], "conditions": [{ "name": "drop", "layout": "phone1", "stimuli": "calls",
        "factors": [{ "name": "height", "values": ["1", "2"] }], "call": "render drop --set height={height} --seconds 1 --layout phone1 --method {alternative} --level-db {level_db}" }], )";
    const std::string alternatives = R"("alternatives": [{ "name": "AV-FV-DRV" }, { "name": "SV" }])";
    write(
        "experts.json",
        R"({ "physvib_protocol": 1, "name": "experts", )" + conditions +
            R"("sessions": [{ "name": "matching", "task": "adjust", "repetitions": 3, )" + alternatives +
            R"(, "adjustment": { "alternative": "AV-FV-DRV", "random_start": true, "least_db": -20, "most_db": 10 } }] })");
    write("main.json",
          R"({ "physvib_protocol": 1, "name": "main", )" + conditions +
              R"("sessions": [{ "name": "main", "task": "choose", "levels_file": "levels.csv", )" +
              alternatives + "}] }");
    refuses("study run main.json --observer simulated", 1, "levels.csv: cannot be read", 2);
    runs("study run experts.json --observer simulated --participants 3");
    EXPECT_TRUE(
        has(runs("study levels experts.json experts-P01.csv experts-P02.csv experts-P03.csv --out levels.csv")
                .out,
            "levels.csv  2 levels of 3 participants"));
    EXPECT_TRUE(has(call("study levels model-or-sound experts-P01.csv --out other.csv").err,
                    "expected trials of the protocol \"model-or-sound\", found \"experts\""));
    const auto levels = readCsvTable(read("levels.csv"), "levels.csv").value;
    ASSERT_EQ(levels.rows.size(), 2u);
    EXPECT_TRUE(has(read("levels.csv"), " observer=simulated\n"));
    runs("study run main.json --observer simulated");
    const auto rows = readCsvTable(read("main-P01.csv"), "main-P01.csv").value;
    for (const auto& row : rows.rows) {
        const auto& level =
            levels.rows[row.cells[*rows.column("stimulus")] == "1" ? 0 : 1].cells[*levels.column("level_db")];
        EXPECT_EQ(row.cells[*rows.column("level_db")], level);
        EXPECT_TRUE(has(row.cells[*rows.column("render")], "--method AV-FV-DRV --level-db " + level));
    }
    write("levels.csv", "condition,stimulus,alternative,level_db\ndrop,1,SV,1\ndrop,2,SV,1\n");
    EXPECT_TRUE(has(call("study run main.json --observer simulated").err,
                    "was begun with another version of the protocol"))
        << "other levels are another study";
    write("levels.csv", "condition,stimulus,alternative,level_db\ndrop,1,SV,1\n");
    EXPECT_TRUE(has(call("study run main.json --observer simulated --participant P09").err,
                    "levels.csv: expected a level of drop, 2, found none"));
}

TEST_F(Study, LevelsAreOfTheOneSessionThatSetsThem) {
    const auto session = [](const std::string& name, const std::string& moved, const std::string& training) {
        return R"({ "name": ")" + name + R"(", "task": "adjust", )" + training +
               R"("alternatives": [{ "name": "AV-FV-DRV" }, { "name": "AV-FF-DRF" }], "adjustment": { "alternative": ")" +
               moved + R"(", "most_db": 10 } })";
    };
    const auto protocol = [&](const std::string& name, const std::string& sessions) {
        write(name + ".json",
              R"({ "physvib_protocol": 1, "name": ")" + name +
                  R"(", "conditions": [{ "name": "drop", "layout": "phone1", "stimuli": "calls",
            "factors": [{ "name": "height", "values": ["1", "2"] }], "call": "render drop --set height={height} --seconds 1 --layout phone1 --method {alternative} --level-db {level_db}" }], "sessions": [)" +
                  sessions + "] }");
        runs("study run " + name + ".json --observer simulated");
        return "study levels " + name + ".json " + name + "-P01.csv --out levels.csv";
    };
    const std::string training = session("first", "AV-FF-DRF", "\"training\": true, "),
                      main = session("main", "AV-FV-DRV", "");
    runs(protocol("tried", training + ", " + main));
    EXPECT_EQ(std::regex_replace(read("levels.csv"), std::regex{"#.*\n|,-?[0-9.]+,1,0\n"}, "\n"),
              "\ncondition,stimulus,alternative,level_db,participants,standard_deviation\n"
              "drop,1,AV-FV-DRV\ndrop,2,AV-FV-DRV\n");
    EXPECT_TRUE(has(call(protocol("twice", main + ", " + session("again", "AV-FF-DRF", ""))).err,
                    "twice.json: expected one session of the task adjust, found 2\n"));
}

// Every trial of the protocol renders one of these calls.
TEST_F(Study, AFixedLevelPeaksAtOneAndAHalfGInEveryTrialOfEightMethodsAndNoLimiterActs) {
    for (const std::string method :
         {"AF-FV-DRV", "AF-FV-DRF", "AF-FF-DRV", "AF-FF-DRF", "AV-FV-DRV", "AV-FF-DRF"})
        for (const std::string pair : {"rubber-concrete", "wood-wood", "steel-steel"}) {
            const std::string render = "render box-study --set pair=" + pair + " --layout study1 --method " +
                                       method + " --rate 48000 --out ";
            EXPECT_FALSE(has(runs(render + "on.wav").err, "limiter"));
            runs(render + "off.wav --limiter off");
            const std::string on = read("on.wav"), off = read("off.wav");
            // Rubber's own frequency is so low that fixed-level hits have a mean of 0.09: the guard acts.
            const bool isGuarded = pair == "rubber-concrete" && method.starts_with("AF-FV");
            EXPECT_EQ(on.substr(on.find("data")) != off.substr(off.find("data")), isGuarded)
                << method << ' ' << pair << ": the limiter or the guard acted";
            float peak = 0.0f, sample = 0.0f;
            for (std::size_t at = on.find("data") + 8; at + 4 <= on.size(); at += 4)
                std::memcpy(&sample, on.data() + at, 4), peak = std::max(peak, std::abs(sample));
            if (method.starts_with("AF")) {
                EXPECT_NEAR(2.0f * peak, 1.5f, 0.015f) << method << ' ' << pair;
            }
        }
    EXPECT_TRUE(has(call("study show eight-methods").out, "--layout study1"));
    std::string text = call("study show eight-methods").out;
    for (std::size_t at = 0; (at = text.find("study1", at)) != std::string::npos;)
        text.replace(at, 6, "phone1");
    write("soft.json", text);
    EXPECT_TRUE(has(call("study run soft.json --observer simulated").err,
                    "expected enchanters of at least 1.68 g (full_scale_g), as 1.5 g and 1 dB of "
                    "headroom are felt, found 1.00 g"));
}

TEST_F(Study, WhatLimiterAndGuardChangeAsPublishedIsAcceptedOrRefused) {
    const auto refused = call("study check eight-methods-thesis");
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_TRUE(has(refused.err, "expected --accept-deviations"));
    const auto accepted = runs("study check eight-methods-thesis --accept-deviations");
    EXPECT_EQ(accepted.out, refused.out) << "what is accepted is read before";
    runs("study check patterns-thesis");
}

TEST_F(Study, PartsOfTheThesisAreFoundByTheirPlaceAndItsEightMethodsDrawn) {
    for (const auto& [place, parts] :
         {std::pair{"'Fig. 5.1'", 1}, {"'Eq. 5.7'", 1}, {"5.3", 3}, {"5.3.2", 2}})
        EXPECT_EQ(std::regex_replace(runs(std::string{"thesis "} + place).out, std::regex{" {4}.*\n|.+"}, ""),
                  std::string(static_cast<std::size_t>(parts), '\n'))
            << place;
    refuses("thesis 'Fig. 9.9'", 2, "found \"Fig. 9.9\"");
    runs("thesis --out t");
    const std::string svg = read("t/fig5-12.svg");
    std::vector<double> heights; // of each method's three hits, in pixels
    for (std::size_t at = 0; (at = svg.find(" d=\"M", at)) != std::string::npos; ++at) {
        std::string path = svg.substr(at + 5, svg.find('"', at + 5) - at - 5);
        std::ranges::replace(path, 'L', ' ');
        std::istringstream numbers{path};
        double x = 0.0, y = 0.0, rest = 0.0;
        for (int n = 0; numbers >> x >> y; ++n) {
            if (n % 1100 == 0) heights.push_back(0.0); // 220 ms at 5 kHz
            if (n == 0) rest = y;
            heights.back() = std::max(heights.back(), rest - y);
        }
    }
    ASSERT_EQ(heights.size(), 24u);
    for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(heights[k], 1.5 * 40.0, 1.0) << "1.5 g";
    for (std::size_t k = 12; k < 24; ++k)
        EXPECT_NEAR(heights[k] / heights[k / 3 * 3 + 2], std::exp2(k % 3) / 4.0, 0.02)
            << "their own strength";
}

TEST_F(Study, BadCallsAndFilesAreRefused) {
    refuses("study run patterns", 2, "--observer");
    refuses("study run patterns --observer GLOVE", 2, "--observer");
    refuses("study run none --observer simulated", 1, "no protocol \"none\" (see physvib study list)");
    refuses("study run none.json --observer simulated", 1, "none.json: cannot be read");
    refuses("study run patterns --observer simulated --participant '../x'", 2, "--participant");
    refuses("study run patterns --observer simulated --out /proc/none", 1, "/proc/none: cannot be made: ");
    refuses("study", 2, "");
    write("patterns-P01.csv", "my diary\n");
    refuses("study run patterns --observer simulated", 1,
            "patterns-P01.csv:1: expected a trial file of physvib, found something else", 1);
    EXPECT_EQ(read("patterns-P01.csv"), "my diary\n");
    write(
        "bad.json",
        R"({ "physvib_protocol": 1, "name": "bad", "conditions": [{ "name": "A", "layout": "phone2", "stimuli": "patterns", "enchanters": 4 }], "sessions": [{ "name": "main" }] })");
    refuses("study run bad.json --observer simulated", 1,
            "bad.json: condition A: expected as many enchanters as the layout has (2), found 4", 2);
}

} // namespace physvib::study_command_test
