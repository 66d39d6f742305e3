// SPDX-License-Identifier: GPL-3.0-or-later
// Every fact of the methods section comes from a field: each is planted into trials and looked for on the
// page, and is not there without it.
#include "Calls.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/AnalysisScript.h"
#include "Support/Studies.h"
#include "System/Process.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace physvib::report_fields_test {

class ReportFields : public test::CommandLine {
protected:
    /// Trials of so many simulated participants as if they were people's, felt with that apparatus.
    void plant(const std::string& protocol, int participants, const std::string& apparatus) const {
        runs("study run " + protocol + " --observer simulated --participants " +
             std::to_string(participants));
        for (int number = 1; number <= participants; ++number) {
            const std::string name =
                protocol + (number < 10 ? "-P0" : "-P") + std::to_string(number) + ".csv";
            std::istringstream lines{read(name)};
            std::string text;
            for (std::string line; std::getline(lines, line);) {
                // limiter_db, master_db, noise_db, device, version, left, again
                if (line.ends_with(",,,,,,")) line.replace(line.size() - 6, 6, apparatus + ",1.0,1,0");
                for (std::size_t at = line.find("simulated"); at != std::string::npos;
                     at = line.find("simulated"))
                    line.replace(at, 9, "person");
                text += line + "\n";
            }
            write(name, text);
        }
    }
    std::string page(const std::string& call) const {
        std::filesystem::remove_all(folder_ / "out");
        const auto outcome = this->call(call);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return read("out/index.html");
    }
};

// A break of 2 and 3 minutes, from which somebody is away for two hours; then a sitting that is cut off.
TEST_F(ReportFields, WhoIsAwayIsCountedApartFromBreaks) {
    plant("magnitudes", 1, "0,-3,-30,JACK:system");
    std::vector<StudyEvent> entries;
    for (const auto& [time, event] : {std::pair{"10:00", "start"},
                                      {"10:10", "break"},
                                      {"10:12", "leave"},
                                      {"12:12", "resume"},
                                      {"12:15", "go-on"},
                                      {"12:16", "pause"},
                                      {"12:20", "go-on"},
                                      {"12:40", "resume"},
                                      {"12:50", "end"}})
        entries.push_back({std::string("2026-01-01T") + time + ":00Z", event, 0, "ko", "1 2 3 4", "5 6"});
    ASSERT_EQ(writeStudyTimes(folder_ / "magnitudes-P01.times.txt", entries), "");
    const std::string text = page("report magnitudes-P01.csv --out out");
    const std::size_t row = text.find("2026-01-01T12:50:00Z");
    ASSERT_NE(row, std::string::npos) << text;
    std::string cells = text.substr(row, text.find("</tr>", row) - row);
    for (std::size_t at = 0; (at = cells.find('<')) != std::string::npos;)
        cells.replace(at, cells.find('>', at) + 1 - at, " ");
    std::istringstream words{cells};
    std::vector<std::string> told;
    for (std::string word; words >> word && told.size() < 8;) told.push_back(word);
    EXPECT_EQ(told, (std::vector<std::string>{"2026-01-01T12:50:00Z", "yes", "3", "140", "1", "1", "5", "1"}))
        << "end, whether it ended, sittings, minutes between them, cut off, breaks, minutes of them, pauses";
}

TEST_F(ReportFields, EveryPlantedFieldHasItsSentence) {
    plant("phantom-grids", 4, "0,-3,-30,JACK:system");
    write("people.csv", "participant,age,sex,handedness,excluded,group\nP01,21,female,right,,a\nP02,25,male,"
                        "left,,b\nP03,26,female,right,,b\nP04,60,male,right,took off the headphones,a\n");
    const std::string call = "report phantom-grids-P01.csv phantom-grids-P02.csv phantom-grids-P03.csv "
                             "phantom-grids-P04.csv --out out";
    const std::string
        bare = page(call),
        whole = page(call +
                     " --people people.csv --ethics 'Approved by the board, no. 7.' --consent 'All signed.'");
    const auto cells = [](std::initializer_list<const char*> all) {
        std::string row;
        for (const std::string one : all)
            row += (one.find_first_not_of("0123456789.") == one.npos && !one.empty() ? "<td class=\"number\">"
                                                                                     : "<td>") +
                   one + "</td>";
        return row;
    };
    const std::string planted[] = {
        cells({"age, mean (years)", "24", "3"}),
        cells({"age, SD (years)", "2.6", "3"}),
        cells({"age, least (years)", "21", "3"}),
        cells({"age, most (years)", "26", "3"}),
        cells({"sex", "female", "2"}),
        cells({"handedness", "right", "2"}),
        cells({"group", "b", "2"}),
        cells({"participants who are not excluded", "", "3"}),
        cells({"took off the headphones", "all trials"}),
        cells({"ethics", "Approved by the board, no. 7.", ""}),
        cells({"consent", "All signed.", ""}),
    };
    for (const std::string& sentence : planted) {
        EXPECT_TRUE(has(whole, sentence)) << whole.substr(whole.find("<h2>Participants"), 2500);
        EXPECT_FALSE(has(bare, sentence));
    }
    EXPECT_TRUE(has(bare, cells({"ethics", "not stated", ""})) &&
                has(bare, cells({"consent", "not stated", ""})));
    EXPECT_FALSE(has(read("out/trials.csv"), "\nP04,")) << "excluded from every analysis";
    EXPECT_TRUE(has(read("out/participants.csv"), "excluded"));
    EXPECT_TRUE(has(read("out/participants.csv"), ",,b\nP03")) << "which analysis.R compares";
    EXPECT_TRUE(has(read("out/orders.csv"), "P01,1,"));
    EXPECT_TRUE(has(whole, "<th>place 6</th>"));
}

TEST_F(ReportFields, LevelsStandByStimulusAndPart) {
    runs("study run model-or-sound --observer simulated");
    std::istringstream lines{read("model-or-sound-P01.csv")};
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        // peak_g, rms_g, a8_m_per_s2
        if (line.ends_with(",,,,,,,,,,"))
            line.replace(line.size() - 10, 3,
                         line.find("height=3") < line.size() ? ",0.5|0.3,0.2|0.1," : ",0.4|0.3,0.2|0.1,");
        text += line + "\n";
    }
    write("model-or-sound-P01.csv", text);
    const std::string whole = page("report model-or-sound-P01.csv --out out"),
                      table = read("out/levels-by-stimulus.csv");
    EXPECT_TRUE(hasAll(table, {"drop,main,pair=wood-wood size=small height=3,AV-FV-DRV,peak_g,4,0.3,",
                               "drop,main,pair=wood-wood size=small height=1,SV,peak_g,4,0.3,"}));
    EXPECT_TRUE(has(whole, "<li>study1: 2 g, assumed</li>"));
    EXPECT_FALSE(has(whole, "the peak of what was felt"));
}

TEST_F(ReportFields, PeopleOfOneNumberAreNamed) {
    for (const char* code : {"A", "B"})
        runs(std::string{"study run magnitudes --observer simulated --number 1 --participant "} + code);
    runs("study run magnitudes --observer simulated --number 2 --participant C");
    EXPECT_TRUE(has(page("report magnitudes-A.csv magnitudes-B.csv --out out"),
                    "participants A, B have the same number, 1"));
    EXPECT_FALSE(has(page("report magnitudes-A.csv magnitudes-C.csv --out out"), "have the same number"));
}

TEST_F(ReportFields, TheNoiseOfTheRoomIsToldWhereThereWasAny) {
    plant("level-steps", 1, "0,0,-30,JACK:system");
    EXPECT_TRUE(has(page("report level-steps-P01.csv --out out"), "noise at the ear</td><td>not stated"));
    const std::string told = page("report level-steps-P01.csv --out out --noise 'Pink, 62 dB(A).'");
    EXPECT_TRUE(has(told, "noise at the ear</td><td>Pink, 62 dB(A)."));
    std::string rows = read("level-steps-P01.csv");
    for (std::size_t at = rows.find(",-30,JACK"); at != std::string::npos; at = rows.find(",-30,JACK"))
        rows.replace(at, 9, ",off,JACK");
    write("level-steps-P01.csv", rows);
    refuses("report level-steps-P01.csv --out out --noise 'Pink, 62 dB(A).'", 1,
            "level-steps-P01.csv: --noise: expected trials with pink noise, found none", 2);
}

TEST_F(ReportFields, BadTablesOfPeopleAreOneLine) {
    plant("level-steps", 1, "0,0,off,none");
    const auto refusesPeople = [&](const std::string& people, const std::string& words) {
        write("people.csv", people);
        refuses("report level-steps-P01.csv --out out --people people.csv", 1, words, 2);
    };
    refusesPeople("participant,shoes\nP01,43\n", "people.csv: expected the columns participant, age, sex, "
                                                 "handedness, group, excluded, found \"shoes\"");
    refusesPeople("participant,age\nP01,old\n",
                  "people.csv:2: column age: expected years from 0 to 130, found \"old\"");
    refusesPeople("participant,age\nP01,20\nP01,21\n",
                  "people.csv:3: column participant: expected a code of its own for each participant");
    refusesPeople("age\n20\n", "people.csv: expected a column participant, found none");
    refusesPeople("participant,excluded\nP01,too late\n",
                  "expected a participant who is not excluded, found none");
}

// Thresholds of conditions in a report: a row per person and condition, compared within people.

class ReportThresholds : public test::CommandLine {
protected:
    /// Writes study.json: a protocol in three conditions.
    void writeThree(Protocol protocol) const {
        protocol.name = "three-" + protocol.name;
        protocol.conditions.resize(3, protocol.conditions.front());
        for (std::size_t i = 0; i < 3; ++i)
            protocol.conditions[i].name = std::string("C").append(1, "abc"[i]);
        write("study.json", protocolJson(protocol));
    }
};

TEST_F(ReportThresholds, AreComparedWithinPeople) {
    for (const auto& [name, method] :
         {std::pair<std::string, std::string>{"level-steps", "staircase"}, {"level-quest", "quest"}}) {
        writeThree(findProtocol(name).value);
        runs("study run study.json --observer simulated --participants 4");
        runs("report three-" + name + "-P*.csv --out out");
        std::map<std::string, int> people;
        for (const CsvRow& row : readCsvTable(read("out/thresholds.csv"), "t").value.rows)
            people[row.cells[0] + row.cells[1]] += 1;
        EXPECT_EQ(people,
                  (std::map<std::string, int>{{method + "Ca", 4}, {method + "Cb", 4}, {method + "Cc", 4}}));
        if (hasProgram("Rscript"))
            EXPECT_TRUE(has(read("out/tests.csv"), "pairs by t of threshold by " + method + " by condition"));
    }
}

TEST_F(ReportThresholds, OfConstantStimuliArePlanned) {
    if (!hasProgram("Rscript")) GTEST_SKIP() << "Rscript (Debian: r-base-core) is not here";
    writeThree(example("frequency-constant"));
    const std::string plan = call("study plan study.json --participants 4 --out plan.txt").out;
    EXPECT_TRUE(hasAll(
        plan, {"- threshold and half interquartile range of a function: ",
               "likelihood, logistic, guess rate 50 %, lapse rate up to 10 %; threshold: 75 %, apart from "
               "lapses\n",
               "analysis of variance of threshold by condition",
               "pairs by t of half interquartile range by condition"}));
}

TEST_F(ReportThresholds, AndMatchesArePlannedWhateverTheSimulatedObserverFeels) {
    if (!hasProgram("Rscript")) GTEST_SKIP() << "Rscript (Debian: r-base-core) is not here";
    for (const auto& [name, test] :
         {std::pair<std::string, std::string>{"detection-quest", "threshold by quest by condition"},
          {"gap-steps", "threshold by staircase by condition"},
          {"equal-sensation", "matched levels in match-60 by condition"}}) {
        Protocol protocol = example(name);
        for (SessionPlan& session : protocol.sessions)
            if (session.adjustment)
                session.adjustment->minDb = session.adjustment->startDb = 10.0; // felt as strong at its end
        writeThree(protocol);
        std::filesystem::remove(folder_ / "analysis.R");
        const auto plan = call("study plan study.json --participants 4 --out plan.txt");
        EXPECT_TRUE(has(plan.out, "- test: pairs by t of " + test)) << plan.err;
    }
}

TEST_F(ReportThresholds, OfTrainingsAreNotPlanned) {
    for (Protocol one : {findProtocol("level-steps").value, example("left-right")}) {
        one.sessions.push_back(one.sessions.front());
        one.sessions.front().isTraining = true, one.sessions.front().name = "practice";
        one.sessions.back() = example("likert-seven").sessions.back();
        write("study.json", protocolJson(one));
        std::filesystem::remove(folder_ / "analysis.R");
        const auto outcome = runs("study plan study.json --participants 4 --out plan.txt");
        EXPECT_TRUE(has(outcome.out, "\nMeasures, of each participant\n- scale: mean score\n\n"));
        EXPECT_TRUE(hasNone(outcome.out, {"- threshold", "- staircases", "- functions"}));
    }
}

TEST_F(ReportThresholds, PlansHaveTheirMeasuresAndTheTestsOfTimeThatRanOut) {
    for (const double seconds : {0.0, 20.0}) {
        Protocol protocol = findProtocol("level-steps").value;
        protocol.sessions.back().answerSeconds = seconds;
        writeThree(protocol);
        const std::string plan = call("study plan study.json --participants 4 --out plan.txt").out;
        if (hasProgram("Rscript"))
            EXPECT_EQ(plan.find("trials that ran out of time in main by condition") != plan.npos,
                      seconds > 0.0)
                << plan;
        EXPECT_TRUE(has(
            plan, "\nMeasures, of each participant\n- threshold of a staircase: mean of the later half of"));
    }
    std::filesystem::remove(folder_ / "analysis.R");
    write("matches.json", read(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/equal-sensation.json"));
    write("pairs.json", read(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/pairs-similarity.json"));
    for (const auto& [name, measure] :
         {std::pair<std::string, std::string>{"magnitudes", "magnitude: geometric"},
          {"matches.json", "matched level: mean"},
          {"pairs.json", "pairs of stimuli: means"},
          {"eight-methods", ""}}) {
        std::filesystem::remove(folder_ / "analysis.R");
        const std::string plan = call("study plan " + name + " --participants 4 --out plan.txt").out;
        for (const char* one :
             {"magnitude: geometric", "matched level: mean", "pairs of stimuli: means", "threshold of"})
            EXPECT_EQ(plan.find(std::string{"\nMeasures, of each participant\n- "} + one) != plan.npos,
                      one == measure)
                << name << plan;
    }
    runs("study run pairs.json --observer simulated --participants 3");
    runs("report pairs-similarity-P*.csv --protocol pairs.json --out out");
    if (hasProgram("Rscript"))
        EXPECT_TRUE(has(read("out/index.html"), "Tables by R: mds.csv, similarity.csv, tests.csv."));
}

// Trials as a BIDS dataset: the files that its validator wants, nothing lost, nothing that breaks a row.

CsvTable trials() {
    return {"t.csv",
            {},
            {"participant", "observer", "condition", "trial", "response", "response_s", "realism"},
            {{2, {"P-1", "person", "box", "1", "a\tb", "1.5", "70"}},
             {3, {"P1", "person", "box", "1", "", "2", "60"}},
             {4, {"P-1", "person", "box", "2", "c", "0.5", "50"}}}};
}

TEST(BidsDataset, HasTheFilesThatBidsAsksFor) {
    const auto files = bidsDataset(trials(), {"A study", "eight-methods", "0.1", {{"seed", "1"}}, false});
    std::vector<std::string> names;
    for (const auto& [name, text] : files) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{
                         "README", "dataset_description.json", "participants.json", "participants.tsv",
                         "sub-P1/beh/sub-P1_task-eightmethods_beh.tsv",
                         "sub-P1x2/beh/sub-P1x2_task-eightmethods_beh.tsv", "task-eightmethods_beh.json"}));
    EXPECT_EQ(files.at("participants.tsv"),
              "participant_id\tcode\tobserver\nsub-P1\tP-1\tperson\nsub-P1x2\tP1\tperson\n");
    EXPECT_EQ(files.at("sub-P1/beh/sub-P1_task-eightmethods_beh.tsv"),
              "observer\tcondition\ttrial\tresponse\tresponse_time\trealism\nperson\tbox\t1\ta\\x09b\t1."
              "5\t70\nperson\tbox\t2\tc\t0.5\t50\n");
    EXPECT_TRUE(has(files.at("sub-P1x2/beh/sub-P1x2_task-eightmethods_beh.tsv"), "\tn/a\t2\t60\n"));
}

TEST(BidsDataset, EveryColumnIsDescribed) {
    const auto files = bidsDataset(trials(), {"A study", "t", "0.1", {}, true});
    const auto sidecar = nlohmann::json::parse(files.at("task-t_beh.json"));
    for (const char* column : {"observer", "condition", "trial", "response", "response_time", "realism"})
        EXPECT_TRUE(sidecar.at(column).contains("Description")) << column;
    EXPECT_EQ(sidecar.at("response_time").at("Units"), "s");
    EXPECT_EQ(sidecar.at("realism").at("Description"), "Column realism of the tables that were read");
    const auto told = bidsDataset(trials(), {"s", "t", "0", {}, false, {{"realism", "Rating from 1 to 7"}}});
    EXPECT_TRUE(has(told.at("task-t_beh.json"), "\"Rating from 1 to 7\""));
    const auto description = nlohmann::json::parse(files.at("dataset_description.json"));
    EXPECT_EQ(description.at("BIDSVersion"), "1.8.0");
    EXPECT_TRUE(has(description.at("Name").get<std::string>(), "SIMULATED"));
    EXPECT_TRUE(has(files.at("README"), "SIMULATED"));
}

} // namespace physvib::report_fields_test
