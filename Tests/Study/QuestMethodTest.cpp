// SPDX-License-Identifier: MIT
// QUEST+ as a session of a protocol: what simulated observers' rows come to, beside a staircase's.
#include "Lab/Study/Summaries.h"
#include "Support/Studies.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iterator>
#include <map>

namespace physvib::quest_method_test {

Protocol withSession(SessionPlan session) {
    session.name = "main";
    session.task = StudyTask::choose;
    session.alternatives = {{"standard"}, {"stronger"}};
    Protocol p;
    p.name = "thresholds";
    p.conditions = {{"A", "", "phone4", 205.0, 1.0, GridSet{1, 1}}};
    p.sessions = {std::move(session)};
    EXPECT_EQ(validate(p), "");
    return p;
}

const QuestMethod method{.alternative = "stronger",
                         .maxDb = 30.0,
                         .stepDb = 1.0,
                         .minWidthDb = 3.0,
                         .maxWidthDb = 12.0,
                         .trials = 40};

Protocol questProtocol(const QuestMethod& quest) { return withSession({.quest = quest}); }

/// An observer whose answers follow a known function of the level, through a whole study: its rows.
std::vector<TrialRecord> recordsOf(const Protocol& p, const PsychometricFunction& truth, int number) {
    Experiment experiment{p, {"P", number}};
    SeededRandom random{static_cast<std::uint64_t>(number), "answers"};
    std::vector<TrialRecord> records;
    while (!experiment.isDone()) {
        const bool isRight = random.chance(truth.probability(experiment.trial().levelDb));
        records.push_back(experiment.acceptAnswer({.response = isRight ? "stronger" : "standard"}));
    }
    return records;
}

/// As an analysis gets them from a file.
std::vector<LevelTrial> levelTrialsOf(const Protocol& p, const std::vector<TrialRecord>& records,
                                      const std::string& participant) {
    std::vector<LevelTrial> trials;
    for (const auto& record : records) {
        LevelTrial trial{
            LevelTrial::Kind::staircase, participant,          "A",
            record.trial.stimulus,       record.trial.levelDb, *isCorrect(p, record) ? 1.0 : 0.0};
        if (const auto& quest = p.sessions[0].quest) {
            trial.kind = LevelTrial::Kind::quest;
            trial.quest = questText(*quest, p.sessions[0].guessRate());
        }
        trials.push_back(std::move(trial));
    }
    return trials;
}

LevelSummary summaryOf(const Protocol& p, const std::vector<TrialRecord>& records) {
    return summariseLevels(levelTrialsOf(p, records, "P")).front();
}

PsychometricFunction someObserver(SeededRandom& random) {
    return {PsychometricShape::weibull, 6.0 + 10.0 * random.uniform(), 4.0 + 5.0 * random.uniform(), 0.5,
            0.02};
}

TEST(QuestMethod, ErrsNoMoreThanAStaircaseWithTwoThirdsOfItsTrials) {
    const Protocol stairs = withSession({.staircase = StaircasePlan{.alternative = "stronger",
                                                                    .startDb = 25.0,
                                                                    .stepDb = 4.0,
                                                                    .minStepDb = 1.0,
                                                                    .maxDb = 30.0,
                                                                    .reversals = 12}});
    SeededRandom random{21, "observers"};
    double stairsSquares = 0.0, questSquares = 0.0;
    std::size_t stairsTrials = 0, questTrials = 0;
    constexpr int observers = 300;
    for (int number = 1; number <= observers; ++number) {
        const PsychometricFunction truth = someObserver(random);
        const auto byStairs = recordsOf(stairs, truth, number);
        QuestMethod shorter = method;
        shorter.trials = static_cast<int>(2 * byStairs.size() / 3);
        const Protocol quest = questProtocol(shorter);
        const auto byQuest = recordsOf(quest, truth, number);
        stairsTrials += byStairs.size(), questTrials += byQuest.size();
        if (const auto found = summaryOf(stairs, byStairs); found.excluded.empty()) // two down, one up
            stairsSquares += std::pow(found.estimate - truth.levelAt(std::sqrt(0.5)), 2);
        questSquares += std::pow(summaryOf(quest, byQuest).estimate - truth.threshold, 2);
    }
    EXPECT_LE(questTrials, 2 * stairsTrials / 3);
    EXPECT_LE(questSquares, stairsSquares);
}

/// One of those that the plan thinks possible, all alike likely.
PsychometricFunction plannedObserver(SeededRandom& random) {
    // seven widths, each for half a step to either side
    const double share = (7.0 * random.uniform() - 0.5) / 6.0;
    return {PsychometricShape::weibull, -0.5 + 31.0 * random.uniform(),
            method.minWidthDb * std::pow(method.maxWidthDb / method.minWidthDb, share), 0.5, method.lapse};
}

TEST(QuestMethod, ThresholdsAreUnbiasedAndIntervalsHold) {
    for (const auto draw : {plannedObserver, someObserver}) {
        const Protocol p = questProtocol(method);
        SeededRandom random{22, "observers"};
        double off = 0.0, widths = 0.0;
        int held = 0, observers = 0;
        for (int number = 1; number <= 500; ++number) {
            const PsychometricFunction truth = draw(random);
            const LevelSummary summary = summaryOf(p, recordsOf(p, truth, number));
            if (!summary.excluded.empty()) continue; // at an end of the levels: told, and no threshold
            ++observers;
            off += summary.estimate - truth.threshold;
            widths += truth.width;
            held += std::abs(summary.estimate - truth.threshold) <= summary.halfInterval;
        }
        EXPECT_LT(std::abs(off), 0.02 * widths);
        EXPECT_GE(held, 0.93 * observers);
        if (draw == plannedObserver)
            EXPECT_LE(held, 0.97 * observers)
                << "of those in the middle of what is thought possible more may be held";
    }
}

TEST(QuestMethod, EstimateAndDeviationAreThoseOfThePosterior) {
    QuestPlan plan = questPlan(method, 0.5);
    plan.lapses = {0.01, 0.05};
    QuestPlus quest{plan};
    SeededRandom random{24, "answers"};
    std::vector<std::pair<double, bool>> answers;
    for (int trial = 0; trial <= 30; ++trial) {
        double sum = 0.0, widths = 0.0, lapses = 0.0, thresholds = 0.0, squares = 0.0;
        for (const double threshold : plan.thresholds)
            for (const double width : plan.widths)
                for (const double lapse : plan.lapses) {
                    const PsychometricFunction f{plan.shape, threshold, width, plan.guess, lapse};
                    double p = 1.0;
                    for (const auto& [level, isRight] : answers)
                        p *= isRight ? f.probability(level) : 1.0 - f.probability(level);
                    sum += p, thresholds += p * threshold, squares += p * threshold * threshold;
                    widths += p * width, lapses += p * lapse;
                }
        const double mean = thresholds / sum;
        EXPECT_NEAR(quest.estimate().threshold, mean, 1e-9) << trial;
        EXPECT_NEAR(quest.estimate().width, widths / sum, 1e-9) << trial;
        EXPECT_NEAR(quest.estimate().lapse, lapses / sum, 1e-9) << trial;
        EXPECT_NEAR(quest.thresholdDeviation(), std::sqrt(squares / sum - mean * mean), 1e-6) << trial;
        answers.emplace_back(quest.level(), random.chance(0.7));
        quest.answer(answers.back().second);
    }
}

/// As the header says it, by plain sums: widths are log-normal over people, with 25 medians and two spreads.
TEST(QuestMethod, PooledThresholdsAndTheirDeviationAreThoseOfThePosteriorOfTheWidths) {
    const QuestPlan plan = questPlan(method, 0.5);
    const std::vector<std::vector<LevelCount>> runs{{{5.0, 6, 10}, {10.0, 8, 10}, {15.0, 10, 10}},
                                                    {{8.0, 5, 10}, {12.0, 9, 10}}};
    std::array<double, 25> widths{};
    for (std::size_t w = 0; w < widths.size(); ++w)
        widths[w] = 3.0 * std::pow(4.0, static_cast<double>(w) / 24.0);
    double sum = 0.0, squares = 0.0;
    std::array<double, 2> thresholds{};
    for (const double spread : {0.15, 0.3})
        for (const double median : widths) {
            double weight = 1.0, mean = 0.0;
            std::array<double, 2> own{};
            for (std::size_t r = 0; r < runs.size(); ++r) {
                double likelihood = 0.0, moment = 0.0, shares = 0.0;
                for (const double width : widths) {
                    const double share = std::exp(-0.5 * std::pow(std::log(width / median) / spread, 2));
                    shares += share;
                    for (const double threshold : plan.thresholds) {
                        const double p =
                            share *
                            std::exp(logLikelihood(runs[r], {plan.shape, threshold, width, 0.5, 0.02}));
                        likelihood += p, moment += p * threshold;
                    }
                }
                weight *= likelihood / shares, own[r] = moment / likelihood, mean += 0.5 * own[r];
            }
            sum += weight, squares += weight * mean * mean;
            for (std::size_t r = 0; r < runs.size(); ++r) thresholds[r] += weight * own[r];
        }
    const PooledThresholds pooled = pooledThresholds(plan, runs);
    for (std::size_t r = 0; r < runs.size(); ++r)
        EXPECT_NEAR(pooled.thresholds[r], thresholds[r] / sum, 1e-9) << r;
    const double mean = 0.5 * (thresholds[0] + thresholds[1]) / sum;
    EXPECT_NEAR(pooled.deviation, std::sqrt(squares / sum - mean * mean), 1e-6);
    EXPECT_GT(pooled.deviation, 0.01);
}

TEST(QuestMethod, GoesOnAfterEveryCutWithTheLevelsThatWouldHaveBeen) {
    const Protocol p = questProtocol(method);
    const SimulatedObserver observer{{}, p, {}};
    const auto records = answered(p);
    ASSERT_EQ(records.size(), 40u);
    for (std::size_t cut = 0; cut < records.size(); cut += 13) {
        Experiment experiment{p, {}};
        for (std::size_t i = 0; i < cut; ++i) ASSERT_EQ(experiment.replay(records[i]), "");
        for (std::size_t i = cut; i < records.size(); ++i) {
            EXPECT_EQ(experiment.trial().partLevelsDb, records[i].trial.partLevelsDb);
            EXPECT_EQ(experiment.acceptAnswer(observer.answer(experiment)).answer, records[i].answer);
        }
    }
}

TEST(QuestMethod, ARowOfAnotherLevelIsAnotherAnswer) {
    const Protocol p = questProtocol(method);
    EXPECT_EQ(Experiment(p, {}).sessionTrials(), 40);
    TrialRecord moved = answered(p).front();
    moved.trial.levelDb += 1.0;
    EXPECT_TRUE(Experiment(p, {}).replay(moved).starts_with("expected the level "));
}

TEST(QuestMethod, EndsOnceTheThresholdIsKnownWellEnough) {
    QuestMethod early = method;
    early.trials = 400;
    early.deviationDb = 1.0;
    const Protocol p = questProtocol(early);
    EXPECT_EQ(Experiment(p, {}).sessionTrials(), 0);
    const auto records = recordsOf(p, {PsychometricShape::weibull, 10.0, 6.0, 0.5, 0.02}, 1);
    EXPECT_LT(records.size(), 150u);
    EXPECT_LE(summaryOf(p, records).halfInterval, 1.96);
}

TEST(QuestMethod, SeveralParticipantsAndSessionsAreKeptApart) {
    const Protocol p = questProtocol(method);
    std::vector<LevelTrial> trials;
    double mean = 0.0;
    for (int number = 1; number <= 3; ++number) {
        const auto records =
            recordsOf(p, {PsychometricShape::weibull, 6.0 + 2.0 * number, 6.0, 0.5, 0.02}, number);
        mean += summaryOf(p, records).estimate / 3.0;
        for (const char* session : {"one", "two"})
            for (LevelTrial trial : levelTrialsOf(p, records, "P" + std::to_string(number)))
                trial.session = session, trials.push_back(trial);
    }
    std::vector<LevelTrial> one;
    std::ranges::copy_if(trials, std::back_inserter(one),
                         [](const LevelTrial& trial) { return trial.participant == "P1"; });
    const double half =
        summaryOf(p, recordsOf(p, {PsychometricShape::weibull, 8.0, 6.0, 0.5, 0.02}, 1)).halfInterval;
    EXPECT_NEAR(summariseLevels(one).front().halfInterval, half / std::sqrt(2.0), 1e-12) << "a mean of two";
    const auto summaries = summariseLevels(trials);
    ASSERT_EQ(summaries.size(), 1u);
    EXPECT_NEAR(summaries[0].estimate, mean, 0.5) << "near each one's own, though widths are common";
    EXPECT_EQ(summaries[0].participants, 3u);
    ASSERT_EQ(summaries[0].thresholds.size(), 3u);
    EXPECT_LT(summaries[0].thresholds[0].second, summaries[0].thresholds[2].second);
    EXPECT_GT(summaries[0].halfInterval, summaries[0].deviation) << "Student's t of three";
}

TEST(QuestMethod, SeveralPeopleTellTheWidthTogether) {
    // narrower than most of what is thought possible: each alone is off to one side
    const QuestMethod usual{.alternative = "stronger"};
    const Protocol p = questProtocol(usual);
    SeededRandom random{23, "observers"};
    std::vector<LevelTrial> trials;
    double truth = 0.0, alone = 0.0;
    constexpr int observers = 200;
    for (int number = 1; number <= observers; ++number) {
        const PsychometricFunction observer{PsychometricShape::weibull, 10.0 + 1.5 * random.normal(), 3.0,
                                            0.5, 0.02};
        const auto own = levelTrialsOf(p, recordsOf(p, observer, number), "P" + std::to_string(number));
        truth += observer.threshold / observers;
        alone += summariseLevels(own).front().estimate / observers;
        trials.insert(trials.end(), own.begin(), own.end());
    }
    const LevelSummary together = summariseLevels(trials).front();
    EXPECT_LT(alone, truth - 0.3);
    EXPECT_NEAR(together.estimate, truth, 0.1);
    EXPECT_GT(together.halfInterval, studentQuantile(0.975, observers - 1) * together.deviation /
                                         std::sqrt(static_cast<double>(observers)))
        << "what is unknown of the widths counts";
}

TEST(QuestMethod, WhatIsUnknownOfTheWidthsCountsByTheShareOfThePlansRuns) {
    QuestMethod coarse = method;
    coarse.stepDb = 2.0;
    const std::map<double, std::uint64_t> hits{{6.0, 6}, {10.0, 8}, {16.0, 10}};
    std::vector<LevelTrial> trials;
    const auto addRun = [&](const std::string& participant, const std::string& session,
                            const QuestMethod& plan) {
        for (const auto& [level, right] : hits)
            for (std::uint64_t n = 0; n < 10; ++n)
                trials.push_back({LevelTrial::Kind::quest, participant, "A", "", level, n < right ? 1.0 : 0.0,
                                  session, questText(plan, 0.5)});
    };
    addRun("P1", "one", method), addRun("P2", "one", method), addRun("P2", "two", coarse);
    std::vector<LevelCount> run;
    for (const auto& [level, right] : hits) run.push_back({level, right, 10});
    const double fine = pooledThresholds(questPlan(method, 0.5), std::vector{run, run}).deviation,
                 other = pooledThresholds(questPlan(coarse, 0.5), std::span{&run, 1}).deviation;
    const LevelSummary summary = summariseLevels(trials).front();
    const double spread = studentQuantile(0.975, 1) * summary.deviation / std::sqrt(2.0);
    EXPECT_NEAR(summary.halfInterval,
                std::hypot(spread, normalQuantile(0.975) * std::hypot(fine * 2.0 / 3.0, other / 3.0)), 1e-9);
}

TEST(QuestMethod, ItsWordsAreThePlan) {
    const std::string words = questText(method, 0.5);
    EXPECT_EQ(words, "weibull guess 0.5 lapse 0.02 levels_db 0 1 30 widths_db 3 12");
    const auto plan = questPlan(words);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->levels, questPlan(method, 0.5).levels);
    EXPECT_EQ(plan->levels.size(), 31u);
    EXPECT_EQ(plan->widths, questPlan(method, 0.5).widths);
    for (const char* bad : {"", "weibull", "cosine guess 0.5 lapse 0.02 levels_db 0 1 30 widths_db 3 12",
                            "weibull guess 0 lapse 0.02 levels_db 0 1 30 widths_db 3 12",
                            "weibull guess 0.5 lapse 0.02 levels_db 0 0 30 widths_db 3 12",
                            "weibull guess 0.5 lapse 0.02 levels_db 0 1e-9 30 widths_db 3 12",
                            "weibull guess 0.5 lapse 0.02 levels_db 0 1 nan widths_db 3 12",
                            "weibull guess 0.5 lapse 0 levels_db 0 1 30 widths_db 3 12"})
        EXPECT_FALSE(questPlan(std::string_view{bad})) << bad;
}

TEST(QuestMethod, WhatMakesNoSenseIsRefusedByItsField) {
    const auto fault = [](auto change) {
        Protocol p = questProtocol(method);
        change(p.sessions[0]);
        return validate(p);
    };
    EXPECT_EQ(fault([](SessionPlan& s) { s.quest->alternative = "weaker"; }),
              "sessions[0].quest.alternative: expected the name of an alternative");
    EXPECT_EQ(fault([](SessionPlan& s) { s.quest->maxDb = 0.0; }),
              "sessions[0].quest: expected least_db < most_db");
    EXPECT_EQ(fault([](SessionPlan& s) { s.quest->minWidthDb = 13.0; }),
              "sessions[0].quest: expected least_width_db <= most_width_db");
    EXPECT_EQ(fault([](SessionPlan& s) { s.quest->stepDb = 0.1; }),
              "sessions[0].quest.step_db: expected at most 201 levels, found 301");
    EXPECT_EQ(fault([](SessionPlan& s) { s.bothOrders = true; }),
              "sessions[0].quest: expected alternatives in random order");
    EXPECT_EQ(fault([](SessionPlan& s) { s.staircase = StaircasePlan{.alternative = "stronger"}; }),
              "sessions[0].quest: expected it or a staircase, found both");
    EXPECT_EQ(fault([](SessionPlan& s) { s.task = StudyTask::identify, s.alternatives.clear(); }),
              "sessions[0].quest: expected it of the task choose only");
}

} // namespace physvib::quest_method_test
