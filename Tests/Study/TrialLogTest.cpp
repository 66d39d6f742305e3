// SPDX-License-Identifier: MIT
// Trial files: rows come back as records, cut ends are dropped, other people's files are left alone.
#include "Lab/Files/TrialLog.h"
#include "Support/FileTesting.h"
#if !defined(_WIN32)
#include "Support/FullDisk.h"
#endif
#include "Support/Has.h"
#include "Support/Studies.h"
#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

namespace physvib::trial_log_test {

const Participant participant{"P01", 1, "simulated"};

std::string wholeFile(const Protocol& p) { return trialFile(p, participant, answered(p, participant)); }

TEST(TrialLog, EveryProtocolsRowsAreTheExperimentAgain) {
    for (const Protocol& p : builtInProtocols()) {
        const std::string text = wholeFile(p);
        const auto log = readTrialLog(text, "t.csv", p, participant);
        ASSERT_TRUE(log) << p.name << ": " << log.error;
        EXPECT_EQ(log.value.completeBytes, text.size());
        Experiment experiment{p, participant};
        std::string again = trialHeader(p, participant, "0");
        for (const TrialRecord& record : log.value.records) {
            const Trial trial = experiment.trial();
            ASSERT_EQ(experiment.replay(record), "") << p.name;
            again += trialRow(p, participant, {trial, record.answer});
        }
        EXPECT_TRUE(experiment.isDone());
        EXPECT_EQ(again, text) << p.name;
    }
}

TEST(TrialLog, ManyLongCallsOfATrialAreReadBack) {
    Protocol p = findProtocol("magnitudes").value;
    p.conditions.resize(1);
    p.conditions[0].stimuli =
        CallSet{{{"n", {"one"}}}, "render drop --set pair={object} --layout " + std::string(1500, 'l')};
    p.sessions.resize(1);
    p.sessions[0].task = StudyTask::rate;
    p.sessions[0].scales = {"liking"};
    for (int i = 0; i < 64; ++i) p.sessions[0].objects.push_back("object " + std::to_string(i));
    ASSERT_EQ(validate(p), "");
    const std::string text = wholeFile(p);
    EXPECT_GT(text.size(), 64u * 1500);
    const auto log = readTrialLog(text, "t.csv", p, participant);
    ASSERT_TRUE(log) << log.error;
    EXPECT_EQ(log.value.completeBytes, text.size());
}

TEST(TrialLog, NumbersThatAnObserverGivesOfAnyLevelAreReadBack) {
    Protocol p = findProtocol("magnitudes").value;
    p.conditions.resize(1);
    p.conditions[0].stimuli =
        CallSet{{{"level_g", {"1e-60", "0.1", "1e60"}}}, "stimulus phantom --level-g {level_g}"};
    const auto log = readTrialLog(wholeFile(p), "t.csv", p, participant);
    ASSERT_TRUE(log) << log.error;
    Experiment experiment{p, participant};
    for (const double number : {0.0, 1e-13, 1e13, std::nan(""), HUGE_VAL}) {
        Answer answer;
        answer.value = number;
        EXPECT_EQ(experiment.answerError(answer), "expected a number from 1e-12 to 1e12");
    }
}

TEST(TrialLog, CutAnywhereTheWholeRowsRemain) {
    const Protocol protocol = findProtocol("level-steps").value;
    const std::string text = wholeFile(protocol);
    const std::size_t rows = readTrialLog(text, "t.csv", protocol, participant).value.records.size();
    for (std::size_t bytes = 0; bytes < text.size(); bytes += 13) {
        const auto log =
            readTrialLog(std::string_view{text}.substr(0, bytes), "t.csv", protocol, participant);
        ASSERT_TRUE(log) << log.error;
        EXPECT_LE(log.value.completeBytes, bytes);
        EXPECT_LT(log.value.records.size(), rows);
        if (log.value.completeBytes > 0) {
            EXPECT_EQ(text[log.value.completeBytes - 1], '\n');
        }
    }
}

TEST(TrialLog, FilesOfOthersAreRefused) {
    const Protocol p = findProtocol("level-steps").value;
    const std::string text = wholeFile(p);
    const auto refusal = [&](const Protocol& protocol, const Participant& who) {
        return readTrialLog(text, "t.csv", protocol, who).error;
    };
    EXPECT_EQ(refusal(p, participant), "");
    EXPECT_EQ(refusal(p, {"P02", 1, "simulated"}), "t.csv:1: expected trials of participant P02, found P01");
    EXPECT_EQ(refusal(p, {"P01", 2, "simulated"}), "t.csv:1: expected trials of number 2, found 1");
    EXPECT_EQ(refusal(p, {"P01", 1, "person"}),
              "t.csv:1: expected trials of observer person, found simulated");
    EXPECT_EQ(refusal(findProtocol("magnitudes").value, participant),
              "t.csv:1: expected trials of protocol magnitudes, found level-steps");
    Protocol changed = p;
    changed.seed = 9;
    EXPECT_EQ(refusal(changed, participant), "t.csv:1: expected trials of seed 9, found 1");
    EXPECT_EQ(readTrialLog("my diary", "t.csv", p, participant).error,
              "t.csv:1: expected a trial file of physvib, found something else")
        << "even a single line without an end";
}

TEST(TrialLog, WhatWasFeltIsKeptAndTheExposureComesBack) {
    const Protocol p = findProtocol("level-steps").value;
    Experiment experiment{p, participant};
    Answer answer{.response = "stronger"};
    answer.playedLevels = {{0.25, 0.125}, {1.0 / 3.0, 0.2}};
    answer.exposure = 0.0123456789;
    const std::string text =
        trialHeader(p, participant, "0") + trialRow(p, participant, experiment.acceptAnswer(answer));
    EXPECT_TRUE(text.ends_with(",0.25|0.333333,0.125|0.2,0.0123457,,,,,,,\n")) << text;
    const auto log = readTrialLog(text, "t.csv", p, participant);
    ASSERT_TRUE(log) << log.error;
    EXPECT_EQ(log.value.records.front().answer.exposure, 0.0123457);
}

TEST(TrialLog, AProtocolThatHasChangedSinceIsToldAsThat) {
    const Protocol p = findProtocol("level-steps").value;
    const std::string text = wholeFile(p);
    Protocol changed = p;
    changed.sessions.front().question = "Which one is stronger now?";
    EXPECT_EQ(readTrialLog(text, "t.csv", changed, participant).error,
              "t.csv:1: was begun with another version of the protocol level-steps (hash " + protocolHash(p) +
                  ", now " + protocolHash(changed) +
                  "), so it does not go on: keep it, and begin anew in another folder");
}

TEST(TrialLog, BadRowsAreNamed) {
    const Protocol p = findProtocol("level-steps").value;
    std::string text = wholeFile(p);
    const std::size_t at = text.find(",choose,");
    text.replace(text.find("P01,simulated,PHONE", at - 60), 19, "P01,simulated,GLOVE");
    EXPECT_EQ(readTrialLog(text, "t.csv", p, participant).error,
              "t.csv:3: column condition: expected a condition of the protocol, found \"GLOVE\"");
}

class TrialLogFiles : public FolderTest {
protected:
    void SetUp() override {
        FolderTest::SetUp();
        path = folder / "t.csv";
    }
    /// As a study does: what the file has is done again, the rest answered and kept; `change(answer)` before.
    template <class Change>
    void goOn(const Protocol& p, Change change) const {
        TrialLogFile log{path, p, participant, "0"};
        ASSERT_EQ(log.error(), "");
        Experiment experiment{p, participant};
        const SimulatedObserver observer{{}, p, participant};
        for (const auto& record : log.records()) ASSERT_EQ(experiment.replay(record), "");
        while (!experiment.isDone()) {
            Answer answer = observer.answer(experiment);
            change(answer);
            ASSERT_TRUE(log.append(experiment.acceptAnswer(answer)));
            EXPECT_EQ(contentOf(path).back(), '\n') << "each row is there at once";
        }
    }
    std::filesystem::path path;
};

TEST_F(TrialLogFiles, GoOnWhereTheyWereCut) {
    const Protocol p = findProtocol("magnitudes").value;
    const std::string text = wholeFile(p);
    for (const std::size_t bytes :
         {std::size_t{0}, std::size_t{40}, text.size() / 3, text.size() / 2, text.size() - 1}) {
        put(path, text.substr(0, bytes));
        goOn(p, [](Answer&) {});
        EXPECT_EQ(contentOf(path), text) << bytes;
    }
    put(path, "my diary");
    EXPECT_NE((TrialLogFile{path, p, participant, "0"}.error()), "");
    EXPECT_EQ(contentOf(path), "my diary");
}

TEST_F(TrialLogFiles, OfOlderVersionsGoOnInTheirOwnColumns) {
    const Protocol p = findProtocol("magnitudes").value;
    for (const auto& [newest, columns] : {std::pair{",peak_g,rms_g,a8_m_per_s2", std::size_t{10}},
                                          {",limiter_db,master_db", std::size_t{7}},
                                          {",left,again", std::size_t{2}}}) {
        std::string old;
        std::istringstream lines{wholeFile(p)};
        for (std::string line; std::getline(lines, line);) {
            const std::size_t at = line.find(newest);
            if (at != std::string::npos)
                line.resize(at);
            else if (line.ends_with(std::string(columns, ',')))
                line.resize(line.size() - columns);
            old += line + "\n";
        }
        ASSERT_FALSE(has(old, newest));
        put(path, old.substr(0, old.size() / 2));
        goOn(p, [newest = newest](Answer& answer) {
            if (std::string{newest} != ",left,again")
                answer.apparatus = Apparatus{"1.0", "JACK:system", -6.0};
            answer.wasDelivered = true;
        });
        EXPECT_EQ(contentOf(path), old) << newest;
    }
}

TEST_F(TrialLogFiles, SayWithWhatTrialsWereFelt) {
    const Protocol p = findProtocol("magnitudes").value;
    const Apparatus with{"1.0", "JACK:system", -6.0, -40.5};
    goOn(p, [&](Answer& answer) { answer.apparatus = with, answer.limiterDb = 1.25; });
    const std::string text = contentOf(path);
    EXPECT_TRUE(has(text, ",1.25,-6,-40.5,JACK:system,1.0,,\n"));
    const auto log = readTrialLog(text, "t.csv", p, participant);
    ASSERT_TRUE(log) << log.error;
    for (const TrialRecord& record : log.value.records) {
        EXPECT_EQ(record.answer.apparatus, with);
        EXPECT_EQ(record.answer.limiterDb, 1.25);
    }
}

TEST_F(TrialLogFiles, SayWhetherEveryPartLeftAndGoOnAlike) {
    const Protocol p = findProtocol("level-steps").value;
    int n = 0;
    goOn(p, [&](Answer& answer) {
        answer.wasDelivered = ++n % 3 != 0;
        answer.revokedPlays = n % 3;
    });
    const std::string text = contentOf(path);
    EXPECT_TRUE(hasAll(text, {",0,0\n", ",1,2\n"}));
    const auto log = readTrialLog(text, "t.csv", p, participant);
    ASSERT_TRUE(log) << log.error;
    Experiment again{p, participant};
    double levelDb = -1.0;
    for (const TrialRecord& record : log.value.records) {
        if (levelDb >= 0.0) EXPECT_EQ(again.trial().levelDb, levelDb) << "what did not leave moves no level";
        ASSERT_EQ(again.replay(record), "");
        levelDb = *record.answer.wasDelivered ? -1.0 : record.trial.levelDb;
    }
    EXPECT_TRUE(again.isDone());
}

TEST_F(TrialLogFiles, KeepAnswersInWords) {
    Protocol p = findProtocol("magnitudes").value;
    p.sessions = {{.name = "main", .task = StudyTask::describe, .mayBeEmpty = true}};
    const std::vector<std::string> words{"a, b", "\"c\"", "=1+1", "'=x", "# no comment", "", "\uac15", "x'"};
    std::size_t n = 0;
    goOn(p, [&](Answer& answer) { answer.response = words[n++ % words.size()]; });
    const auto log = readTrialLog(contentOf(path), "t.csv", p, participant);
    ASSERT_TRUE(log) << log.error;
    ASSERT_EQ(log.value.records.size(), n);
    for (std::size_t i = 0; i < n; ++i)
        EXPECT_EQ(log.value.records[i].answer.response, words[i % words.size()]);
    EXPECT_TRUE(has(contentOf(path), ",'=1+1,")) << "no formula";
}

TEST_F(TrialLogFiles, HaveOneWriterAtATime) {
    const Protocol p = findProtocol("magnitudes").value;
    Experiment experiment{p, participant};
    const SimulatedObserver observer{{}, p, participant};
    {
        TrialLogFile log{path, p, participant, "0"};
        EXPECT_EQ((TrialLogFile{path, p, participant, "0"}.error()),
                  path.string() + ": another program is writing it: the participant's study runs already");
        EXPECT_TRUE(log.append(experiment.acceptAnswer(observer.answer(experiment))));
    }
    const TrialLogFile next{path, p, participant, "0"};
    EXPECT_EQ(next.error(), "");
    EXPECT_EQ(next.records().size(), 1u);
}

#if !defined(_WIN32)
TEST_F(TrialLogFiles, AFullDiskLeavesWholeRows) {
    const Protocol p = findProtocol("magnitudes").value;
    const std::string text = wholeFile(p);
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{10}, text.size() / 2, text.size() - 1}) {
        std::filesystem::remove(path);
        {
            const FileSizeLimit full(bytes);
            TrialLogFile log{path, p, participant, "0"};
            Experiment experiment{p, participant};
            const SimulatedObserver observer{{}, p, participant};
            while (!experiment.isDone() && log.append(experiment.acceptAnswer(observer.answer(experiment)))) {
            }
            EXPECT_EQ(log.error(), path.string() + ": cannot be written: File too large");
        }
        const std::string kept = contentOf(path);
        EXPECT_EQ(kept, text.substr(0, bytes < 100 ? 0 : text.rfind('\n', bytes - 1) + 1));
        EXPECT_EQ(std::filesystem::exists(path), !kept.empty());
    }
}
#endif

TEST(TrialLog, RowsByQuestSayWhatTheirThresholdIsMadeOf) {
    const Protocol p = findProtocol("level-quest").value;
    std::string text = wholeFile(p);
    const auto summaries = [&text]() -> Result<std::vector<LevelSummary>> {
        const auto levels = readOne(readLevels, text, "t.csv");
        if (!levels) return Failure{levels.error};
        return summariseLevels(levels.value.groups.front().trials);
    };
    const auto read = summaries();
    ASSERT_TRUE(read) << read.error;
    ASSERT_EQ(read.value.size(), 1u);
    EXPECT_EQ(read.value[0].kind, LevelTrial::Kind::quest);
    EXPECT_EQ(read.value[0].trials, 30u);
    EXPECT_NEAR(read.value[0].estimate, 0.674 * std::sqrt(2.0) * 2.0, read.value[0].halfInterval)
        << "75 % of comparisons with 2 dB of noise";
    const std::string words = ",weibull guess 0.5 lapse 0.02 levels_db 0 0.5 12 widths_db 2 20,,,,,,,,,,\n";
    ASSERT_NE(text.rfind(words), std::string::npos);
    text.replace(text.rfind(words), words.size(), ",weibull,,,,,,,,,,\n");
    EXPECT_EQ(summaries().error,
              "t.csv:32: column quest: expected the words of a QUEST+ session, found \"weibull\"");
}

} // namespace physvib::trial_log_test
