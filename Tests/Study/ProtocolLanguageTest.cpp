// SPDX-License-Identifier: MIT
// Protocols of one's own: variables that follow the level, weighted staircases, levels that can be reached,
// equal energy, the schema; and the times of a study.
#include "Core/Actuators/Exposure.h"
#include "Lab/Study/StudyPlan.h"
#include "Lab/Study/StudyRun.h"
#include "Lab/Study/Summaries.h"
#include "Stimuli/SeededRandom.h"
#include "Support/FileTesting.h"
#include "Support/Has.h"
#include "Support/Studies.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace physvib::protocol_language_test {

/// Two alternatives of one call, of which "higher" is moved.
std::string frequencies(const std::string& more = {}) {
    return R"({"physvib_protocol": 1, "name": "own", "conditions": [{"name": "c", "layout": "phone2", "stimuli": "calls",
  "factors": [{"name": "s", "values": ["0.3"]}], "variables": [{"name": "hz", "at_0_db": 200}],
  "call": "stimulus phantom --at 0.5,0.5 --frequency {hz} --seconds {s} --layout phone2 --level-g 0.5"}],
  "sessions": [{"name": "main", "task": "choose", "alternatives": [{"name": "standard"}, {"name": "higher"}],
  "staircase": {"alternative": "higher", "start_db": 2, "step_db": 1, "least_step_db": 1, "most_db": 4, "up_ratio": 3, "down": 1})" +
           more + "}]}";
}

TEST(ProtocolLanguage, AVariableFollowsTheLevelInEveryCall) {
    const auto read = readProtocol(frequencies(), "own.json");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(readProtocol(protocolJson(read.value), "again").value, read.value);
    Experiment experiment{read.value, {}};
    const Trial trial = experiment.trial();
    const auto jobs = trialJobs(read.value, {trial, {}});
    ASSERT_EQ(jobs.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string& call = std::get<ResolvedCall>(jobs[i]).words;
        const char* hz = trial.parts[i] == "higher" ? "--frequency 251.785082 " : "--frequency 200 ";
        EXPECT_TRUE(has(call, hz));
    }
}

TEST(ProtocolLanguage, EveryLevelOfAVariableIsPlannedAndOfAGainTheEnds) {
    std::map<std::string, std::set<double>> levels;
    for (const PlannedStimulus& s : plannedStimuli(readProtocol(frequencies(), "own").value))
        levels[s.part].insert(s.levelDb);
    EXPECT_EQ(levels["standard"], std::set<double>{0.0});
    EXPECT_EQ(levels["higher"], (std::set<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
    levels.clear();
    for (const PlannedStimulus& s : plannedStimuli(findProtocol("level-steps").value)) {
        levels[s.part].insert(s.levelDb);
        EXPECT_EQ(s.isHighest, s.part == "standard" || s.levelDb == 12.0) << s.levelDb;
    }
    EXPECT_EQ(levels["stronger"], (std::set<double>{0.0, 12.0}));
}

TEST(ProtocolLanguage, MoreThan512LevelsAreSpreadEvenlyOverTheirRange) {
    Protocol protocol = readProtocol(frequencies(), "own").value;
    StaircasePlan& stairs = *protocol.sessions.front().staircase;
    stairs.upRatio = 2.7182818; // steps that do not divide one another
    std::vector<double> levels;
    for (const PlannedStimulus& s : plannedStimuli(protocol)) {
        EXPECT_EQ(s.isEvenlySpaced, s.part == "higher");
        if (s.part == "higher") levels.push_back(s.levelDb);
    }
    ASSERT_EQ(levels.size(), 513u);
    EXPECT_EQ(levels.front(), 0.0);
    EXPECT_EQ(levels.back(), 4.0);
    for (std::size_t i = 1; i < levels.size(); ++i) EXPECT_NEAR(levels[i] - levels[i - 1], 4.0 / 512, 1e-12);
    for (const PlannedStimulus& s : plannedStimuli(readProtocol(frequencies(), "own").value))
        EXPECT_FALSE(s.isEvenlySpaced);
}

TEST(ProtocolLanguage, LevelsThatWereSetMayBeAnyBetweenTheirEnds) {
    Protocol protocol = findProtocol("model-or-sound").value;
    for (ConditionPlan& condition : protocol.conditions) {
        auto& set = std::get<WorldSet>(condition.stimuli);
        set.call += " --frequency {hz}";
        set.variables = {{"hz", 100.0}};
    }
    std::set<double> levels;
    for (const PlannedStimulus& s : plannedStimuli(protocol))
        if (s.part != "SV") levels.insert(s.levelDb);
    EXPECT_GE(levels.size(), 513u) << "a mean of what was set is between its steps";
}

TEST(ProtocolLanguage, NamesAndFieldsThatCannotBeAreRefusedWithTheirPlace) {
    const auto refused = [](std::string text, const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
        return readProtocol(text, "own.json").error;
    };
    EXPECT_EQ(refused(frequencies(), "\"name\": \"hz\"", "\"name\": \"level_db\""),
              "own.json: conditions[0].variables: expected a name of its own for each, without braces, found "
              "level_db");
    EXPECT_TRUE(has(refused(frequencies(), "{hz}", "{khz}"), "names of factors or variables"));
    EXPECT_TRUE(has(refused(frequencies(), "\"at_0_db\": 200", "\"at_0_db\": 0"), "at_0_db: expected 1e-06"));
    const std::string rate =
        R"({"physvib_protocol": 1, "name": "own", "conditions": [{"name": "c", "stimuli": "grid", "columns": 1, "rows": 1}],
  "sessions": [{"name": "main", "task": "rate", "scales": ["a"], "feedback": true}]})";
    EXPECT_TRUE(has(readProtocol(rate, "own.json").error, "sessions[0].feedback: expected it where"));
    EXPECT_TRUE(has(refused(rate, "\"feedback\": true", "\"interval_s\": 0.5"), "sessions[0].interval_s"));
}

// Kaernbach 1991: one down, one up, steps up three times as large: 3 (1 - p) = p at 75 %.
TEST(ProtocolLanguage, AWeightedStaircaseComesToThreeQuarters) {
    StaircasePlan plan;
    plan.startDb = 20.0, plan.minDb = -40.0, plan.stepDb = plan.minStepDb = 0.25;
    plan.upRatio = 3.0, plan.down = 1, plan.reversals = 100, plan.maxTrials = 10000;
    double sum = 0.0;
    constexpr int runs = 60;
    for (int run = 0; run < runs; ++run) {
        SeededRandom random{1, "weighted " + std::to_string(run)};
        Staircase stairs{plan, plan.startDb};
        while (!stairs.isDone())
            stairs.answer(random.chance(0.5 + 0.5 / (1.0 + std::exp(-(stairs.levelDb() - 5.0)))));
        sum += thresholdDb(stairs);
    }
    EXPECT_NEAR(sum / runs, 5.0, 0.25) << "where 75 % are right";
}

TEST(ProtocolLanguage, EqualRmsAndEnergyAreThoseOfTheSamples) {
    for (const double decay : {0.0, 5.0, 80.0})
        for (const double seconds : {0.1, 0.7}) {
            double squares = 0.0;
            constexpr int steps = 100000;
            for (int i = 0; i < steps; ++i)
                squares += std::exp(-2.0 * decay * seconds * (i + 0.5) / steps) * seconds / steps;
            PhantomJob job{FieldPlace{0.5, 0.5}, PanningLaw::linear, 1.0, seconds, decay};
            EXPECT_EQ(job.peakFactor(205.0), 1.0);
            job.levelMeasure = LevelMeasure::rms;
            EXPECT_NEAR(job.peakFactor(205.0) * std::sqrt(squares / seconds), 1.0, 1e-6);
            job.levelMeasure = LevelMeasure::energy;
            EXPECT_NEAR(job.peakFactor(205.0) * std::sqrt(squares), 1.0, 1e-6);
        }
    StimulusJob plain{PhantomJob{FieldPlace{0.5, 0.5}}};
    EXPECT_FALSE(has(textOf(plain), "--decay")) << "rows of before stay the same";
    std::get<PhantomJob>(plain.stimulus).decayPerSecond = 30.0;
    std::get<PhantomJob>(plain.stimulus).levelMeasure = LevelMeasure::energy;
    EXPECT_TRUE(has(textOf(plain), "--decay 30 --level-of energy --seconds 1"));
}

TEST(ProtocolLanguage, EqualWeightedLevelsAreThoseOfTheWeightedSamples) {
    PhantomJob job{.target = FieldPlace{0.5, 0.5}, .levelMeasure = LevelMeasure::weighted};
    constexpr int rate = 192000;
    for (const double hz : {12.5, 40.0, 205.0, 1000.0})
        for (const double decay : {0.0, 30.0, 300.0})
            for (const double seconds : {0.005, 0.1, 1.0}) {
                HandWeighting weighting{rate};
                double squares = 0.0;
                const int frames = static_cast<int>(seconds * rate);
                for (int n = 0; n < frames; ++n) {
                    const double t = static_cast<double>(n) / rate,
                                 y = weighting.process(std::exp(-decay * t) *
                                                       std::sin(2.0 * std::numbers::pi * hz * t));
                    squares += y * y / frames;
                }
                job.seconds = seconds, job.decayPerSecond = decay;
                EXPECT_NEAR(job.peakFactor(hz) * std::sqrt(2.0 * squares), 1.0, 0.02)
                    << hz << " Hz, " << decay << " 1/s, " << seconds << " s";
            }
    job.seconds = 600.0, job.decayPerSecond = 0.0;
    for (const double hz : {12.5, 205.0, 1000.0})
        EXPECT_NEAR(job.peakFactor(hz) * handWeighting::gain(hz), 1.0, 1e-3) << hz;
}

TEST(ProtocolLanguage, TheSchemaHasEveryFieldThatIsReadAndItsRange) {
    const std::string schema = protocolSchema();
    EXPECT_TRUE(hasAll(schema, {"\"physvib_protocol\"", "\"variables\"", "\"at_0_db\"", "\"up_ratio\"",
                                "\"interval_s\"", "\"feedback\"", "\"instruction\"", "\"stimuli\"",
                                "\"additionalProperties\": false", "\"latin-square\"", "\"estimate\"",
                                "\"if\"", "\"then\""}));
    EXPECT_TRUE(readProtocol("{\"$schema\": \"protocol.schema.json\", " + frequencies().substr(1), "own"));
}

std::vector<std::string> wordsOf(const Protocol& protocol, const TrialRecord& record) {
    std::vector<std::string> words;
    for (const TrialJob& job : trialJobs(protocol, record))
        words.push_back(std::get<ResolvedCall>(job).words);
    return words;
}

TEST(ProtocolLanguage, ConstantStimuliMoveOneAlternativeAndHaveARightOne) {
    const Protocol protocol = example("frequency-constant");
    EXPECT_EQ(readProtocol(protocolJson(protocol), "again").value, protocol);
    Experiment experiment{protocol, {}};
    std::string rows = trialHeader(protocol, {}, "0");
    std::set<double> roved;
    while (!experiment.isDone()) {
        const Trial trial = experiment.trial();
        const auto calls = wordsOf(protocol, {trial, {}});
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_TRUE(
                has(calls[i], "--frequency " + (trial.parts[i] == "higher" ? trial.stimulus : "200")));
        EXPECT_EQ(trial.partLevelsDb[0], trial.partLevelsDb[1]) << "both rove together";
        EXPECT_LE(std::abs(trial.partLevelsDb[0]), 3.0);
        roved.insert(trial.partLevelsDb[0]);
        const auto record = experiment.acceptAnswer({.response = trial.number % 4 ? "higher" : "standard"});
        EXPECT_EQ(isCorrect(protocol, record), trial.number % 4 != 0);
        rows += trialRow(protocol, {}, record);
    }
    EXPECT_GT(roved.size(), 20u);
    EXPECT_FALSE(readOne(readLevels, rows)) << "nothing is adaptive";
    const NamedText file{rows, "rows.csv"};
    const auto answers = readLevelAnswers({&file, 1}, {"stimulus", "correct", false});
    ASSERT_TRUE(answers) << answers.error;
    EXPECT_EQ(answers.value.groups.front().trials.size(), 100u);
    std::set<double> levels;
    for (const PlannedStimulus& s : plannedStimuli(protocol)) levels.insert(s.levelDb);
    EXPECT_EQ(*levels.begin(), -3.0);
    EXPECT_EQ(*levels.rbegin(), 3.0);
}

/// A study of an example by the simulated observer; its rows are read back.
std::vector<TrialRecord> ranThrough(const Protocol& protocol) {
    EXPECT_EQ(readProtocol(protocolJson(protocol), "again").value, protocol);
    const auto records = answered(protocol);
    const std::string rows = trialFile(protocol, {}, records);
    Experiment again{protocol, {}};
    for (const TrialRecord& record : readTrialLog(rows, "rows.csv", protocol, {}).value.records)
        EXPECT_EQ(again.replay(record), "");
    EXPECT_TRUE(again.isDone()) << rows;
    return records;
}

TEST(ProtocolLanguage, AQuestionnaireIsAskedOncePerConditionAndFeelsNothing) {
    const Protocol protocol = example("task-load");
    int asked = 0;
    for (const TrialRecord& record : ranThrough(protocol))
        if (record.trial.task == StudyTask::rate) {
            ++asked;
            EXPECT_TRUE(record.trial.stimulus.empty() && trialJobs(protocol, record).empty());
            EXPECT_TRUE(TrialProgress(protocol.sessions[1], record.trial).canAnswer());
        }
    EXPECT_EQ(asked, 2) << "conditions";
    EXPECT_EQ(maxSessionTrials(protocol.sessions[1], 14), 1);
}

TEST(ProtocolLanguage, PointsAreWholeNumbers) {
    const Protocol protocol = example("likert-seven");
    ranThrough(protocol);
    for (const auto& [score, fits] :
         {std::pair{0.0, false}, {1.0, true}, {3.5, false}, {7.0, true}, {8.0, false}})
        EXPECT_EQ(Experiment(protocol, {}).answerError({.scores = {score, 4.0}}).empty(), fits) << score;
}

TEST(ProtocolLanguage, ATrialThatRunsOutOfTimeHasNoOtherAnswerAndMovesNoLevel) {
    Protocol points = example("likert-seven");
    for (SessionPlan& session : points.sessions) session.answerSeconds = 1.5;
    std::set<bool> outcomes;
    for (const TrialRecord& record : ranThrough(points)) {
        EXPECT_EQ(record.answer.scores.empty(), record.answer.timedOut);
        EXPECT_TRUE(!record.answer.timedOut || record.answer.seconds == 1.5);
        outcomes.insert(record.answer.timedOut);
    }
    EXPECT_EQ(outcomes.size(), 2u);
    Protocol steps = findProtocol("level-steps").value;
    EXPECT_NE(Experiment(steps, {}).answerError({.timedOut = true}), "") << "time is not limited";
    steps.sessions.front().answerSeconds = 2.0;
    Experiment experiment{steps, {}};
    std::string rows = trialHeader(steps, {}, "0");
    for (int n = 1; !experiment.isDone(); ++n) {
        const double before = experiment.trial().levelDb;
        const Answer answer = n % 3 == 0 ? Answer{.timedOut = true} : Answer{.response = "standard"};
        ASSERT_EQ(experiment.answerError(answer), "");
        const TrialRecord record = experiment.acceptAnswer(answer);
        rows += trialRow(steps, {}, record);
        EXPECT_EQ(isCorrect(steps, record).has_value(), !record.answer.timedOut);
        if (n % 3 == 0 && !experiment.isDone()) EXPECT_EQ(experiment.trial().levelDb, before);
    }
    Experiment again{steps, {}};
    const auto log = readTrialLog(rows, "rows.csv", steps, {});
    for (const TrialRecord& record : log.value.records) ASSERT_EQ(again.replay(record), "");
    EXPECT_EQ(log.value.records.size(), 299u) << "200 answers";
    const auto levels = readOne(readLevels, rows, "rows.csv");
    EXPECT_EQ(levels.value.groups.front().trials.size(), 200u);
    EXPECT_EQ(levels.value.warnings,
              std::vector<std::string>{"rows.csv: left out: 99 trials ran out of time, without an answer"});
    steps.sessions.front().staircase.reset(), steps.sessions.front().task = StudyTask::adjust;
    steps.sessions.front().adjustment = Adjustment{.alternative = "stronger"};
    EXPECT_TRUE(has(validate(steps), "answer_within_s: expected it of other tasks"));
}

TEST(ProtocolLanguage, SideBySideTheReferenceComesOpenlyAndHidden) {
    const Protocol protocol = example("side-by-side");
    std::set<std::string> orders;
    for (const TrialRecord& record : ranThrough(protocol)) {
        const auto calls = wordsOf(protocol, record);
        ASSERT_EQ(calls.size(), 5u);
        EXPECT_TRUE(has(calls[0], "--frequency 200 "));
        EXPECT_EQ(std::ranges::count(calls, calls[0]), 2);
        EXPECT_EQ(record.answer.scores.size(), 4u);
        orders.insert(resolvedCalls(protocol, record).substr(calls[0].size()));
    }
    EXPECT_GT(orders.size(), 4u);
}

TEST(ProtocolLanguage, PairsAreEveryTwoStimuliInBothOrders) {
    const Protocol protocol = example("pairs-similarity");
    std::set<std::string> all;
    for (const TrialRecord& record : ranThrough(protocol)) {
        const auto calls = wordsOf(protocol, record);
        ASSERT_EQ(calls.size(), 2u);
        EXPECT_NE(calls[0], calls[1]);
        EXPECT_TRUE(all.insert(resolvedCalls(protocol, record)).second);
    }
    EXPECT_EQ(all.size(), 30u);
}

TEST(ProtocolLanguage, AnswersAreOfOneIntervalAndAVariableRovesAlone) {
    const Protocol sides = example("left-right");
    std::set<std::string> given;
    for (const TrialRecord& record : ranThrough(sides)) {
        EXPECT_EQ(wordsOf(sides, record).size(), 1u);
        EXPECT_FALSE(isCorrect(sides, record));
        given.insert(record.answer.response);
    }
    EXPECT_EQ(given, (std::set<std::string>{"left", "right"}));
    const Protocol roved = example("frequency-roved");
    std::set<double> levels;
    for (const TrialRecord& record : ranThrough(roved)) {
        const auto calls = wordsOf(roved, record);
        const auto g = [](const std::string& call) { return call.substr(call.find("--level-g")); };
        EXPECT_EQ(g(calls[0]), g(calls[1]));
        const auto standard = std::ranges::find(record.trial.parts, "standard") - record.trial.parts.begin();
        EXPECT_TRUE(has(calls[static_cast<std::size_t>(standard)], "--frequency 150 "));
        levels.insert(record.trial.roveDb);
    }
    EXPECT_GT(levels.size(), 10u);
    EXPECT_TRUE(nonGainVariables(roved.conditions[0], true).empty()) << "what roves is the strength";
    Protocol mixed = roved;
    mixed.conditions.push_back(roved.conditions[0]);
    mixed.conditions[1].name = "other";
    EXPECT_EQ(validate(mixed), "");
    for (auto& variable : std::get<CallSet>(mixed.conditions[1].stimuli).variables) variable.isRoving = false;
    EXPECT_EQ(validate(mixed), "conditions: expected a variable that roves in each of them, or in none");
}

TEST(ProtocolLanguage, PracticeEndsAfterSoManyRightAnswersInARow) {
    const Protocol protocol = example("yes-no");
    Experiment experiment{protocol, {}};
    int trials = 0;
    for (; !experiment.isDone() && experiment.session().isTraining; ++trials) {
        EXPECT_EQ(experiment.sessionTrials(), 0) << "nobody knows";
        const std::string shown = experiment.trial().stimulus;
        ASSERT_TRUE(shown == "yes" || shown == "no") << shown;
        EXPECT_TRUE(has(wordsOf(protocol, {experiment.trial(), {}})[0],
                        shown == "yes" ? "--level-g 0.05" : "--level-g 0.001"));
        experiment.acceptAnswer({.response = trials != 3 ? shown : shown == "yes" ? "no" : "yes"});
    }
    EXPECT_EQ(trials, 4 + 6) << "the fourth answer was wrong";
    EXPECT_EQ(experiment.sessionTrials(), 80);
}

TEST(ProtocolLanguage, InterleavedStaircasesAreMixedAndEachGoesItsOwnWay) {
    const Protocol protocol = example("level-mixed");
    EXPECT_EQ(readProtocol(protocolJson(protocol), "again").value, protocol);
    const StaircasePlan& plan = *protocol.sessions.front().staircase;
    Experiment experiment{protocol, {}};
    Staircase alone[] = {{plan, 8.0}, {plan, 1.0}};
    std::string rows = trialHeader(protocol, {}, "0");
    std::vector<TrialRecord> records;
    std::size_t changes = 0;
    SeededRandom random{1, "listener"};
    while (!experiment.isDone()) {
        const Trial trial = experiment.trial();
        ASSERT_TRUE(trial.staircase == 1 || trial.staircase == 2);
        Staircase& own = alone[trial.staircase - 1];
        ASSERT_FALSE(own.isDone()) << "a staircase that is over has no more trials";
        EXPECT_EQ(trial.levelDb, own.levelDb());
        changes += !records.empty() && records.back().trial.staircase != trial.staircase ? 1 : 0;
        const bool isRight = random.chance(trial.levelDb > 3.0 ? 0.95 : 0.6);
        own.answer(isRight);
        records.push_back(experiment.acceptAnswer({.response = isRight ? "stronger" : "standard"}));
        rows += trialRow(protocol, {}, records.back());
    }
    EXPECT_TRUE(alone[0].isDone() && alone[1].isDone());
    EXPECT_GT(changes, records.size() / 4) << "trials are mixed";
    const auto levels = readOne(readLevels, rows, "rows.csv");
    ASSERT_TRUE(levels) << levels.error;
    const auto summary = summariseLevels(levels.value.groups.front().trials).front();
    EXPECT_NEAR(summary.estimate, 0.5 * (thresholdDb(alone[0]) + thresholdDb(alone[1])), 0.5);
    Experiment resumed{protocol, {}};
    const auto log = readTrialLog(rows, "rows.csv", protocol, {});
    ASSERT_TRUE(log) << log.error;
    for (const TrialRecord& record : log.value.records) ASSERT_EQ(resumed.replay(record), "");
    EXPECT_TRUE(resumed.isDone());
    Protocol wrong = protocol;
    wrong.sessions.front().staircase->startsDb[1] = 12.0;
    EXPECT_TRUE(has(validate(wrong), "staircase: expected least_db <= start_db <= most_db"));
}

TEST(ProtocolLanguage, AModulusComesFirstInEachTrial) {
    const Protocol protocol = example("strength-modulus");
    Experiment experiment{protocol, {}};
    for (; !experiment.isDone();) {
        const Trial trial = experiment.trial();
        const auto calls = wordsOf(protocol, {trial, {}});
        ASSERT_EQ(calls.size(), 2u);
        EXPECT_TRUE(has(calls[0], "--level-g 0.2"));
        EXPECT_TRUE(has(calls[1], "--level-g " + trial.stimulus));
        experiment.acceptAnswer({.value = 10.0});
    }
    double plays = 0.0;
    for (const PlannedTrials& planned : plannedTrials(protocol)) plays += planned.count;
    EXPECT_EQ(plays, 40.0) << "of 20 trials, each with the modulus";
}

TEST(ProtocolLanguage, FactorsMayBeLeftOutAndFieldsThatDoNotFitAreRefused) {
    std::string text = frequencies();
    const std::string factors = R"("factors": [{"name": "s", "values": ["0.3"]}], )";
    text.erase(text.find(factors), factors.size());
    text.replace(text.find("{s}"), 3, "0.3");
    const auto read = readProtocol(text, "own");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(conditionStimuli(read.value.conditions.front()).size(), 1u);
    Protocol wrong = example("frequency-constant");
    const auto fault = [&](auto edit) {
        Protocol edited = wrong;
        edit(edited.sessions.front(), std::get<CallSet>(edited.conditions.front().stimuli));
        return validate(edited);
    };
    using S = SessionPlan;
    using C = CallSet;
    EXPECT_TRUE(has(fault([](S& s, C&) { s.correct = "lower"; }), "correct: expected the name"));
    EXPECT_TRUE(
        has(fault([](S&, C& c) { c.call.replace(c.call.find("{g}"), 3, "0.2"), c.variables.clear(); }),
            "expected {level_db} or a variable"));
    EXPECT_TRUE(has(fault([](S& s, C&) { s.modulus = "210"; }), "modulus: expected it of"));
    EXPECT_TRUE(has(fault([](S& s, C&) { s.correct = {}, s.untilCorrect = 3; }), "until_correct: expected"));
    EXPECT_TRUE(has(fault([](S&, C& c) { c.factors[0].otherValue = {}; }), "alternative and otherwise"));
    EXPECT_TRUE(has(fault([](S&, C& c) { c.factors[0].labels = {"a"}; }), "a label of each value"));
    wrong = example("strength-modulus");
    EXPECT_TRUE(has(fault([](S& s, C&) { s.modulus = "9"; }), "expected the modulus of session main"));
}

class TimesOfAStudy : public FolderTest {
protected:
    StudyRun run() const { return {findProtocol("magnitudes").value, {"P07", 1, "person"}, folder}; }
    Apparatus with(std::string outputs, std::string noise) const {
        Apparatus apparatus{"0.2.0", "Fake:hands", 0.0};
        apparatus.outputs = std::move(outputs), apparatus.noiseOutputs = std::move(noise);
        apparatus.language = "ko";
        return apparatus;
    }
    void answer(StudyInProgress& study) const {
        Answer one;
        one.value = 10.0;
        one.apparatus = with("1 2 3 4", "5 6");
        ASSERT_TRUE(study.acceptAnswer(one)) << study.error();
    }
};

TEST_F(TimesOfAStudy, OtherOutputsAreRefusedAndTheTrialFileHasNoTimes) {
    std::string before;
    {
        StudyInProgress study{run()};
        ASSERT_EQ(study.error(), "");
        ASSERT_EQ(study.logStart(with("1 2 3 4", "5 6")), "");
        answer(study);
        ASSERT_EQ(study.logEvent(studyEvents::breakStart), "");
    }
    {
        StudyInProgress study{run()};
        ASSERT_EQ(study.error(), "");
        EXPECT_TRUE(has(study.apparatusError(with("1 2 3 7", "5 6")),
                        "expected the outputs as in the trials before, 1 2 3 4, found 1 2 3 7"));
        EXPECT_TRUE(has(study.apparatusError(with("1 2 3 4", "7 8")), "the outputs of the noise"));
        ASSERT_EQ(study.apparatusError(with("1 2 3 4", "5 6")), "");
        ASSERT_EQ(study.logStart(with("1 2 3 4", "5 6")), "");
    }
    const auto times = loadStudyTimes(timesPath(run().trialFile()));
    ASSERT_TRUE(times) << times.error;
    ASSERT_EQ(times.value.size(), 3u);
    EXPECT_EQ(times.value[0].event, "start");
    EXPECT_EQ(times.value[1].event, "break");
    EXPECT_EQ(times.value[2].event, "resume");
    EXPECT_EQ(times.value[2].trials, 1);
    EXPECT_EQ(times.value[2].language, "ko");
    for (const StudyEvent& m : times.value) EXPECT_GT(unixSeconds(m.timeUtc), 1.7e9) << m.timeUtc;
    EXPECT_FALSE(has(contentOf(run().trialFile()), "5 6"));
}

TEST_F(TimesOfAStudy, ABreakGoesOnWhileTheWindowIsClosedAndAStudyEndsOnce) {
    StudyRun one = run();
    one.protocol.sessions.front().breakBeforeSeconds = 600.0;
    const auto timesWith = [&](std::vector<std::pair<std::string, std::string>> events) {
        std::vector<StudyEvent> moments;
        for (auto& [time, event] : events) moments.push_back({time, event, 0, {}, {}, {}});
        ASSERT_EQ(writeStudyTimes(timesPath(one.trialFile()), moments), "");
    };
    EXPECT_EQ(StudyInProgress{one}.remainingBreakSeconds(), 600.0);
    EXPECT_FALSE(StudyInProgress{one}.hasBreakBegun());
    timesWith({{utcNow(), "start"}, {utcNow(), "break"}, {utcNow(), "pause"}});
    EXPECT_NEAR(StudyInProgress{one}.remainingBreakSeconds(), 595.0, 5.0);
    EXPECT_TRUE(StudyInProgress{one}.isOnBreak());
    timesWith(
        {{utcNow(), "start"}, {"2026-01-01T00:00:00Z", "break"}, {utcNow(), "pause"}, {utcNow(), "go-on"}});
    EXPECT_EQ(StudyInProgress{one}.remainingBreakSeconds(), 0.0);
    EXPECT_TRUE(StudyInProgress{one}.isOnBreak()) << "that go-on ended the pause";
    StudyInProgress study{one};
    ASSERT_EQ(study.logEvent(studyEvents::goOn), "");
    EXPECT_FALSE(study.isOnBreak());
    while (!study.experiment().isDone()) answer(study);
    for (const std::string_view event : {studyEvents::end, studyEvents::resume, studyEvents::end})
        ASSERT_EQ(study.logEvent(event), "");
    const auto times = loadStudyTimes(timesPath(one.trialFile()));
    ASSERT_EQ(times.value.size(), 6u);
    EXPECT_EQ(times.value.back().event, "end");
}

TEST(StudyTimes, SecondsAreThoseOfTheCalendar) {
    EXPECT_EQ(unixSeconds("1970-01-01T00:00:00Z"), 0.0);
    EXPECT_EQ(unixSeconds("2026-11-24T14:02:31Z"), 1795528951.0);
    for (const char* wrong :
         {"", "2026-02-30T00:00:00Z", "2026-11-24 14:02:31Z", "2026-11-24T24:00:00Z", "x026-11-24T14:02:31Z"})
        EXPECT_TRUE(std::isnan(unixSeconds(wrong))) << wrong;
}

} // namespace physvib::protocol_language_test
