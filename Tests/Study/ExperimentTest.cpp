// SPDX-License-Identifier: MIT
// Studies trial by trial: what is presented, what is refused, what unlocks, and going on after a cut.
#include "Lab/Study/Experiment.h"
#include "Support/Has.h"
#include "Support/Studies.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace physvib::experiment_test {

Protocol protocolOf(StimulusSet stimuli, std::vector<SessionPlan> sessions) {
    Protocol p;
    p.name = "test";
    p.conditions = {{"A", "", "phone4", 205.0, 1.0, std::move(stimuli)}};
    p.sessions = std::move(sessions);
    EXPECT_EQ(validate(p), "");
    return p;
}

const Protocol patterns =
    protocolOf(PatternSet{2}, {{.name = "training", .isTraining = true, .task = StudyTask::explore},
                               {.name = "main", .breakBeforeSeconds = 120.0}});

TEST(Experiment, TrainingShowsEveryPatternAndTheMainSessionEachOnce) {
    const auto records = answered(patterns);
    ASSERT_EQ(records.size(), 28u + 28u);
    std::map<std::string, int> felt, asked;
    for (const auto& [trial, answer] : records)
        trial.session == 0 ? ++felt[answer.response] : ++asked[trial.stimulus];
    EXPECT_EQ(felt.size(), 28u);
    EXPECT_EQ(asked.size(), 28u);
    EXPECT_EQ(records[28].trial.breakSeconds, 120.0);
    EXPECT_EQ(records[29].trial.breakSeconds, 0.0);
}

TEST(Experiment, WhoExploresSaysWhenTheTrainingEndsAndAFileOfItGoesOnThere) {
    const auto felt = [](Experiment& experiment, int touches) {
        std::vector<TrialRecord> records;
        for (int n = 0; n < touches; ++n)
            records.push_back(experiment.acceptAnswer({.place = FieldPlace{0.5, 0.5}}));
        return records;
    };
    const auto p = protocolOf(
        GridSet{2, 2}, {{.name = "training", .isTraining = true, .task = StudyTask::explore, .minTouches = 3},
                        {.name = "main", .task = StudyTask::locate}});
    Experiment experiment{p, {}, true};
    auto records = felt(experiment, 2);
    EXPECT_FALSE(experiment.mayEnd());
    for (auto& record : felt(experiment, 3)) records.push_back(record);
    EXPECT_TRUE(experiment.mayEnd());
    EXPECT_EQ(experiment.sessionTrials(), 0) << "how many are left is not told";
    experiment.endSession();
    EXPECT_EQ(experiment.session().name, "main");
    for (auto& record : felt(experiment, 1)) records.push_back(record);
    Experiment again{p, {}, true};
    for (const auto& record : records) ASSERT_EQ(again.replay(record), "");
    EXPECT_EQ(again.trial().number, 2);
    Experiment soon{p, {}, true};
    ASSERT_EQ(soon.replay(records[0]), "");
    EXPECT_EQ(soon.replay(records[5]), "expected the session training") << "too early";
}

TEST(Experiment, ABreakLiesBetweenConditionsAsBeforeSessions) {
    auto p = protocolOf(GridSet{2, 1}, {{.name = "training", .isTraining = true, .task = StudyTask::explore},
                                        {.name = "main", .breakBeforeSeconds = 120.0}});
    p.conditions.push_back(p.conditions.front());
    p.conditions.back().name = "other";
    p.conditionBreakSeconds = 60.0;
    std::vector<double> rests;
    for (const auto& record : answered(p))
        if (record.trial.number == 1) rests.push_back(record.trial.breakSeconds);
    EXPECT_EQ(rests, (std::vector<double>{0.0, 120.0, 60.0, 120.0}));
}

TEST(Experiment, OrdersDifferByParticipantAndRepeatBySeed) {
    const auto stimuli = [](const std::vector<TrialRecord>& records) {
        std::vector<std::string> all;
        for (const auto& r : records) all.push_back(r.trial.stimulus);
        return all;
    };
    EXPECT_EQ(stimuli(answered(patterns, {"P01", 1})), stimuli(answered(patterns, {"P01", 1})));
    EXPECT_NE(stimuli(answered(patterns, {"P01", 1})), stimuli(answered(patterns, {"P02", 2})));
}

TEST(Experiment, RecordsOfAnotherStudyAreRefused) {
    const auto whole = answered(patterns);
    Experiment experiment{patterns, {"P02", 2}};
    for (std::size_t i = 0; i < 28; ++i) ASSERT_EQ(experiment.replay(whole[i]), "");
    EXPECT_TRUE(experiment.replay(whole[28]).starts_with("expected the stimulus "))
        << "the other participant's order";
    EXPECT_EQ(experiment.replay(whole[29]), "expected trial 1");
    EXPECT_EQ(experiment.answeredTrials(), 28);
    auto broken = whole[0];
    broken.answer.response = "Z-100";
    EXPECT_NE(Experiment(patterns, {}).replay(broken), "");
}

TEST(Experiment, AnswersAreCheckedByTask) {
    const auto protocol = protocolOf(GridSet{2, 2}, {{.name = "main", .task = StudyTask::locate}});
    Experiment experiment{protocol, {}};
    EXPECT_EQ(experiment.answerError({.place = FieldPlace{0.5, 1.0}}), "");
    EXPECT_EQ(experiment.answerError({.place = FieldPlace{0.5, 1.1}}), "expected a place on the field");
    EXPECT_EQ(experiment.answerError({.place = FieldPlace{std::nan(""), 0.0}}),
              "expected a place on the field");
    EXPECT_EQ(experiment.answerError({.response = "1,1"}), "expected a place on the field");
    EXPECT_EQ(experiment.answerError({.place = FieldPlace{0.5, 0.5}, .plays = 0}),
              "expected that the stimulus was felt");
}

TEST(Experiment, FreeTouchesAreCountedNotListed) {
    const auto p =
        protocolOf(GridSet{7, 5},
                   {{.name = "training", .isTraining = true, .task = StudyTask::explore, .minTouches = 100},
                    {.name = "main", .task = StudyTask::locate, .repetitions = 5}});
    const auto records = answered(p);
    EXPECT_EQ(records.size(), 100u + 175u);
    EXPECT_TRUE(records.front().answer.place);
    EXPECT_TRUE(resolvedCalls(p, records.front()).starts_with("stimulus phantom --at "))
        << resolvedCalls(p, records.front());
    EXPECT_TRUE(resolvedCalls(p, records.back()).starts_with("stimulus phantom --grid 7x5 --cell "));
}

TEST(Experiment, BothButtonOrdersOfEveryConditionAppearOncePerBlock) {
    SessionPlan main{.name = "main",
                     .task = StudyTask::choose,
                     .order = SessionPlan::Order::blocks,
                     .repetitions = 2,
                     .alternatives = {{"RM"}, {"SV"}},
                     .bothOrders = true};
    const auto p = protocolOf(
        CallSet{{{"pair", {"a", "b", "c"}}, {"size", {"1", "2", "3"}}, {"height", {"1", "2", "3"}}},
                "render drop {pair} {alternative}"},
        {main});
    const auto records = answered(p);
    ASSERT_EQ(records.size(), 108u);
    std::map<std::pair<std::string, std::string>, int> seen;
    for (std::size_t i = 0; i < 54; ++i) ++seen[{records[i].trial.stimulus, records[i].trial.parts.front()}];
    EXPECT_EQ(seen.size(), 54u);
    EXPECT_EQ(resolvedCalls(p, records.front()).find('{'), std::string::npos);
    EXPECT_TRUE(has(resolvedCalls(p, records.front()), " ; "));
}

TEST(Experiment, AdjustedLevelsHoldInLaterSessions) {
    SessionPlan matching{.name = "matching",
                         .isTraining = true,
                         .task = StudyTask::adjust,
                         .repetitions = 2,
                         .alternatives = {{"RM"}, {"SV"}},
                         .adjustment = Adjustment{"RM"}};
    SessionPlan main{.name = "main",
                     .task = StudyTask::choose,
                     .alternatives = {{"RM"}, {"SV"}},
                     .levelsFrom = "matching"};
    const auto p = protocolOf(CallSet{{{"pair", {"a", "b"}}}, "render {pair} {alternative} {level_db}"},
                              {matching, main});
    Experiment experiment{p, {}};
    std::map<std::string, double> sums;
    while (experiment.trial().task == StudyTask::adjust) {
        const double db = experiment.trial().stimulus == "a" ? -6.0 + experiment.answeredTrials() : 3.0;
        sums[experiment.trial().stimulus] += db;
        experiment.acceptAnswer({.value = db});
    }
    EXPECT_NEAR(*experiment.adjustedDb(0, "matching", "a"), sums["a"] / 2, 1e-12);
    EXPECT_FALSE(experiment.adjustedDb(0, "matching", "z"));
    while (!experiment.isDone()) {
        const Trial trial = experiment.trial();
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_NEAR(trial.partLevelsDb[i], trial.parts[i] == "RM" ? sums[trial.stimulus] / 2 : 0.0,
                        1e-12);
        experiment.acceptAnswer({.response = "RM"});
    }
}

/// A session may only take from the one before what its protocol says: also where a study was cut.
TEST(Experiment, EverySessionOfEveryConditionBeginsAnewAndAFileOfThemGoesOn) {
    const SessionPlan look{.name = "look", .isTraining = true, .task = StudyTask::explore};
    const SessionPlan learn{.name = "learn", .isTraining = true, .repetitions = 4, .untilCorrect = 3};
    const SessionPlan choose{
        .name = "choose", .task = StudyTask::choose, .repetitions = 2, .alternatives = {{"a"}, {"b"}}};
    SessionPlan stairs = choose;
    stairs.name = "stairs", stairs.staircase = StaircasePlan{.alternative = "a", .maxTrials = 5};
    const auto again = [](SessionPlan session) {
        session.name += " again";
        return session;
    };
    for (const auto& [sessions, expected] :
         {std::pair{std::vector{look}, std::vector{2}},
          std::pair{std::vector{look, again(look), learn, again(learn), stairs, again(stairs), choose},
                    std::vector{2, 2, 3, 3, 5, 5, 4}}}) {
        auto p = protocolOf(GridSet{2, 1}, sessions);
        p.conditions.push_back(p.conditions.front());
        p.conditions.back().name = "B";
        Experiment experiment{p, {}, true};
        std::vector<TrialRecord> records;
        std::vector<int> counts(2 * sessions.size());
        while (!experiment.isDone()) {
            if (experiment.mayEnd()) {
                experiment.endSession();
                continue;
            }
            const Trial& trial = experiment.trial();
            ++counts[trial.condition * sessions.size() + trial.session];
            Answer answer{.response = trial.stimulus};
            if (trial.task == StudyTask::explore) answer.response = trial.number == 1 ? "1,1" : "1,2";
            if (trial.task == StudyTask::choose) answer.response = "a";
            ASSERT_EQ(experiment.answerError(answer), "");
            records.push_back(experiment.acceptAnswer(answer));
        }
        auto twice = expected;
        twice.insert(twice.end(), expected.begin(), expected.end());
        EXPECT_EQ(counts, twice);
        Experiment resumed{p, {}, true};
        for (const TrialRecord& record : records) ASSERT_EQ(resumed.replay(record), "");
        EXPECT_TRUE(resumed.isDone() || resumed.mayEnd());
        EXPECT_EQ(resumed.answeredTrials(), experiment.answeredTrials());
    }
}

TEST(Experiment, AdjustedLevelsAreThoseOfTheSameConditionAndOfTheSessionThatIsNamed) {
    const SessionPlan first{.name = "first",
                            .task = StudyTask::adjust,
                            .alternatives = {{"RM"}, {"SV"}},
                            .adjustment = Adjustment{"RM"}};
    SessionPlan second = first, main = first;
    second.name = "second";
    main.name = "main", main.task = StudyTask::choose, main.adjustment.reset(), main.levelsFrom = "first";
    auto p = protocolOf(CallSet{{{"pair", {"a", "b"}}}, "render {pair} {alternative} {level_db}"},
                        {first, second, main});
    p.conditions.push_back(p.conditions.front());
    p.conditions.back().name = "B";
    for (Experiment experiment{p, {}}; !experiment.isDone();) {
        const Trial trial = experiment.trial();
        const double setDb = (trial.condition == 0 ? 0.0 : 10.0) + (trial.stimulus == "a" ? 1.0 : 2.0);
        if (trial.task == StudyTask::choose) EXPECT_EQ(trial.levelDb, setDb) << trial.condition;
        experiment.acceptAnswer({.response = "RM", .value = trial.session == 1 ? -setDb : setDb});
    }
}

TEST(Experiment, LevelsThatWereSetByWhatDidNotLeaveDoNotCount) {
    const SessionPlan set{.name = "set",
                          .task = StudyTask::adjust,
                          .repetitions = 3,
                          .alternatives = {{"RM"}, {"SV"}},
                          .adjustment = Adjustment{"RM"}};
    SessionPlan main = set;
    main.name = "main", main.task = StudyTask::choose, main.adjustment.reset(), main.levelsFrom = "set";
    const auto p =
        protocolOf(CallSet{{{"pair", {"a"}}}, "render {pair} {alternative} {level_db}"}, {set, main});
    Experiment experiment{p, {}};
    experiment.acceptAnswer({.value = 1.0});
    experiment.acceptAnswer({.value = 8.0, .wasDelivered = false});
    experiment.acceptAnswer({.value = 2.0, .wasDelivered = true});
    EXPECT_EQ(experiment.trial().levelDb, 1.5);
}

TEST(Experiment, AnAnswerToWhatDidNotLeaveIsNeitherRightNorWrongInARow) {
    const auto p = protocolOf(GridSet{2, 1}, {{.name = "main", .repetitions = 5, .untilCorrect = 3}});
    for (const bool isRight : {false, true}) {
        Experiment experiment{p, {}};
        for (const bool wasDelivered : {true, true, false, true}) {
            ASSERT_FALSE(experiment.isDone());
            const std::string& truth = experiment.trial().stimulus;
            const std::string wrong = truth == "1,1" ? "1,2" : "1,1";
            experiment.acceptAnswer(
                {.response = wasDelivered || isRight ? truth : wrong, .wasDelivered = wasDelivered});
        }
        EXPECT_TRUE(experiment.isDone()) << isRight;
    }
}

TEST(Experiment, AdjustmentsMayStartAnywhereByTheSeed) {
    SessionPlan matching{
        .name = "matching",
        .task = StudyTask::adjust,
        .repetitions = 20,
        .alternatives = {{"RM"}, {"SV"}},
        .adjustment = Adjustment{
            .alternative = "RM", .stepDb = 2.0, .minDb = -10.0, .maxDb = 5.0, .hasRandomStart = true}};
    const auto p =
        protocolOf(CallSet{{{"pair", {"a", "b"}}}, "render {pair} {alternative} {level_db}"}, {matching});
    std::set<double> starts;
    for (const auto& record : answered(p)) {
        const double step = (record.trial.levelDb + 10.0) / 2.0;
        EXPECT_EQ(step, std::round(step));
        EXPECT_GE(step, 0.0);
        EXPECT_LE(step, 7.0);
        starts.insert(record.trial.levelDb);
    }
    EXPECT_GT(starts.size(), 5u);
    EXPECT_EQ(answered(p)[7].trial.levelDb, answered(p)[7].trial.levelDb);
}

TEST(Experiment, LevelsOfExpertsHoldForTheAlternativeThatTheyMoved) {
    SessionPlan main{.name = "main",
                     .task = StudyTask::choose,
                     .alternatives = {{"RM"}, {"SV", 1.0}},
                     .levelsFile = "levels.csv"};
    auto p = protocolOf(CallSet{{{"pair", {"a", "b"}}}, "render {pair} {alternative} {level_db}"}, {main});
    EXPECT_EQ(levelsError(p), "levels.csv: expected a level of A, a, found none");
    using Kind = LevelTrial::Kind;
    std::vector<LevelTrial> experts;
    // E1 twice
    for (const double db : {-4.0, -8.0}) experts.push_back({Kind::adjustment, "E1", "A", "a", 0.0, db});
    experts.push_back({Kind::adjustment, "E2", "A", "a", 0.0, 0.0});
    experts.push_back({Kind::adjustment, "E2", "A", "b", 0.0, 3.0});
    p.levels = averageLevels(experts, "RM");
    ASSERT_EQ(p.levels.size(), 2u);
    EXPECT_EQ(p.levels[0].levelDb, -3.0) << "everybody counts once";
    EXPECT_EQ(p.levels[0].participants, 2u);
    EXPECT_EQ(levelsError(p), "");
    for (const auto& record : answered(p))
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_EQ(record.trial.partLevelsDb[i], record.trial.parts[i] == "SV"  ? 1.0
                                                    : record.trial.stimulus == "a" ? -3.0
                                                                                   : 3.0);
    p.levels = averageLevels(experts, "AV");
    EXPECT_EQ(levelsError(p), "levels.csv: expected levels of an alternative of session main, found AV");
}

TEST(Experiment, RatingsWaitForEveryObject) {
    SessionPlan main{.name = "main",
                     .task = StudyTask::rate,
                     .repetitions = 10,
                     .minSeconds = 10.0,
                     .breakEvery = 20,
                     .breakSeconds = 120.0,
                     .objects = {"a", "b", "c"},
                     .scales = {"realism", "harmony", "liking"}};
    const auto p = protocolOf(
        CallSet{{{"method", {"1", "2", "3", "4", "5", "6", "7", "8"}}}, "render {object} {method}"}, {main});
    Experiment experiment{p, {}};
    TrialProgress progress{experiment.session(), experiment.trial()};
    for (std::size_t part = 0; part < 3; ++part) {
        EXPECT_FALSE(progress.canAnswer());
        progress.addPlay(part);
        progress.addSeconds(part, 9.0);
        EXPECT_FALSE(progress.canAnswer());
        progress.addSeconds(part, 1.0);
    }
    EXPECT_TRUE(progress.canAnswer());
    EXPECT_EQ(progress.plays(), 3);
    EXPECT_NE(experiment.answerError({.scores = {50, 50}}), "");
    EXPECT_NE(experiment.answerError({.scores = {50, 50, 101}}), "");
    const auto records = answered(p);
    ASSERT_EQ(records.size(), 80u);
    int breaks = 0;
    for (const auto& r : records) breaks += r.trial.breakSeconds > 0.0;
    EXPECT_EQ(breaks, 3);
}

TEST(Experiment, WordsMayBeEmptyWhereTheProtocolSaysSo) {
    for (const bool mayBeEmpty : {false, true}) {
        const auto p = protocolOf(GridSet{2, 1},
                                  {{.name = "main", .task = StudyTask::describe, .mayBeEmpty = mayBeEmpty}});
        ASSERT_EQ(validate(p), "");
        const Experiment experiment{p, {}};
        EXPECT_EQ(experiment.answerError({}), mayBeEmpty ? "" : "expected words, found none");
        EXPECT_EQ(experiment.answerError({.response = std::string(4000, 'x')}), "");
        EXPECT_EQ(experiment.answerError({.response = std::string(4001, 'x')}),
                  "expected at most 4000 bytes of words");
    }
}

TEST(Experiment, APlayThatWasLostIsOwedAndCountsForNothing) {
    const SessionPlan session{.maxPlays = 2, .minSeconds = 1.0};
    TrialProgress progress{session, {}};
    progress.addPlay(0);
    progress.addSeconds(0, 1.0);
    EXPECT_TRUE(progress.canAnswer());
    progress.addPlay(0);
    progress.revokePlay(0);
    EXPECT_FALSE(progress.canAnswer()) << "though it was felt before";
    EXPECT_TRUE(progress.canPlay(0));
    EXPECT_EQ(progress.plays(), 1);
    EXPECT_EQ(progress.revokedPlays(), 1);
    progress.addPlay(0);
    EXPECT_FALSE(progress.canAnswer()) << "the time of the lost play is lost, too";
    progress.addSeconds(0, 1.0);
    EXPECT_TRUE(progress.canAnswer());
    EXPECT_FALSE(progress.canPlay(0));
}

TEST(Staircase, TwoDownOneUpFindsTheLevelOf71PercentCorrect) {
    StaircasePlan plan;
    plan.alternative = "stronger";
    plan.startDb = 10.0;
    plan.reversals = 60;
    plan.maxTrials = 5000;
    Staircase stairs{plan, plan.startDb};
    SeededRandom random{5};
    constexpr double noiseDb = 3.0; // of either of two levels: 70.7 % at 0.545 sqrt(2) noise
    while (!stairs.isDone())
        stairs.answer(stairs.levelDb() + noiseDb * random.normal() > noiseDb * random.normal());
    EXPECT_NEAR(thresholdDb(stairs), 0.545 * std::sqrt(2.0) * noiseDb, 0.5);
    EXPECT_EQ(stairs.reversals().size(), 60u);
}

} // namespace physvib::experiment_test
