// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of conditions in a report: a row per person and condition, compared within people.
#include "Calls.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Files/ProtocolFile.h"
#include "System/Process.h"
#include <algorithm>
#include <map>

namespace physvib {
namespace {

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
        ASSERT_EQ(call("study run study.json --observer simulated --participants 4").exitCode, 0);
        ASSERT_EQ(call("report three-" + name + "-P*.csv --out out").exitCode, 0);
        std::map<std::string, int> people;
        for (const CsvRow& row : readCsvTable(read("out/thresholds.csv"), "t").value.rows)
            people[row.cells[0] + row.cells[1]] += 1;
        EXPECT_EQ(people,
                  (std::map<std::string, int>{{method + "Ca", 4}, {method + "Cb", 4}, {method + "Cc", 4}}));
        if (hasProgram("Rscript"))
            EXPECT_NE(read("out/tests.csv").find("pairs by t of threshold by " + method + " by condition"),
                      std::string::npos);
    }
}

TEST_F(ReportThresholds, OfConstantStimuliArePlanned) {
    if (!hasProgram("Rscript")) GTEST_SKIP() << "Rscript (Debian: r-base-core) is not here";
    writeThree(loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/frequency-constant.json").value);
    const std::string plan = call("study plan study.json --participants 4 --out plan.txt").out;
    for (const char* test :
         {"- threshold and half interquartile range of a function: ",
          "likelihood, logistic, guess rate 50 %, lapse rate up to 10 %; threshold: 75 %, apart from "
          "lapses\n",
          "analysis of variance of threshold by condition",
          "pairs by t of half interquartile range by condition"})
        EXPECT_NE(plan.find(test), std::string::npos) << plan;
}

TEST_F(ReportThresholds, AndMatchesArePlannedWhateverTheSimulatedObserverFeels) {
    if (!hasProgram("Rscript")) GTEST_SKIP() << "Rscript (Debian: r-base-core) is not here";
    for (const auto& [name, test] :
         {std::pair<std::string, std::string>{"detection-quest", "threshold by quest by condition"},
          {"gap-steps", "threshold by staircase by condition"},
          {"equal-sensation", "matched levels in match-60 by condition"}}) {
        Protocol protocol =
            loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/" + name + ".json").value;
        for (SessionPlan& session : protocol.sessions)
            if (session.adjustment)
                session.adjustment->leastDb = session.adjustment->startDb = 10.0; // felt as strong at its end
        writeThree(protocol);
        std::filesystem::remove(folder_ / "analysis.R");
        const auto plan = call("study plan study.json --participants 4 --out plan.txt");
        EXPECT_NE(plan.out.find("- test: pairs by t of " + test), std::string::npos) << plan.out << plan.err;
    }
}

TEST_F(ReportThresholds, OfTrainingsAreNotPlanned) {
    for (Protocol one : {findProtocol("level-steps").value,
                         loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/left-right.json").value}) {
        one.sessions.push_back(one.sessions.front());
        one.sessions.front().isTraining = true, one.sessions.front().name = "practice";
        one.sessions.back() = loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/likert-seven.json")
                                  .value.sessions.back();
        write("study.json", protocolJson(one));
        std::filesystem::remove(folder_ / "analysis.R");
        const auto outcome = call("study plan study.json --participants 4 --out plan.txt");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("\nMeasures, of each participant\n- scale: mean score\n\n"),
                  std::string::npos)
            << outcome.out;
        for (const char* words : {"- threshold", "- staircases", "- functions"})
            EXPECT_EQ(outcome.out.find(words), std::string::npos) << outcome.out;
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
        EXPECT_NE(
            plan.find(
                "\nMeasures, of each participant\n- threshold of a staircase: mean of the later half of"),
            std::string::npos)
            << plan;
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
    ASSERT_EQ(call("study run pairs.json --observer simulated --participants 3").exitCode, 0);
    ASSERT_EQ(call("report pairs-similarity-P*.csv --protocol pairs.json --out out").exitCode, 0);
    if (hasProgram("Rscript"))
        EXPECT_NE(read("out/index.html").find("Tables by R: mds.csv, similarity.csv, tests.csv."),
                  std::string::npos);
}

} // namespace
} // namespace physvib
