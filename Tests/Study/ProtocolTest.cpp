// SPDX-License-Identifier: MIT
// What a protocol may say, the stimuli it names, and the orders it makes.
#include "Lab/Study/Protocol.h"
#include "Io/Disk/ReadFile.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/StimulusJob.h"
#include "Lab/Study/StudyPlan.h"
#include "Lab/Study/StudyTasks.h"
#include "Support/Has.h"
#include "TestPlaces.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace physvib::protocol_test {

Protocol gridProtocol() {
    Protocol p;
    p.name = "grid";
    p.conditions = {{"A", "", "phone4", 205.0, 1.0, GridSet{3, 2}}};
    p.sessions = {{.name = "main"}};
    return p;
}

std::string fault(auto change) {
    Protocol p = gridProtocol();
    change(p);
    return validate(p);
}

TEST(Protocol, FaultsAreNamedByTheirField) {
    EXPECT_EQ(fault([](Protocol&) {}), "");
    EXPECT_EQ(fault([](Protocol& p) { p.sessions.push_back(p.sessions[0]); }),
              "sessions: expected a name of its own for each");
    EXPECT_EQ(fault([](Protocol& p) {
                  p.conditions[0].stimuli = PatternSet{4}, p.sessions[0].task = StudyTask::locate;
              }),
              "conditions[0].stimuli: expected a grid, which the task locate needs");
    EXPECT_EQ(fault([](Protocol& p) { p.conditions[0].stimuli = PatternSet{26}; }),
              "conditions[0].stimuli: expected at most 4096 of them");
    EXPECT_EQ(fault([](Protocol& p) {
                  p.conditions[0].stimuli = PatternSet{2, {0.1, 0.1}};
              }),
              "conditions[0].stimuli: expected no two of the same label");
    EXPECT_EQ(fault([](Protocol& p) {
                  p.conditions[0].stimuli = PatternSet{2, {0.1004}};
              }),
              "conditions[0].pulse_s: expected whole milliseconds");
    EXPECT_EQ(fault([](Protocol& p) { p.conditions.clear(); }),
              "conditions: expected one or more, found none");
}

TEST(Protocol, FieldsOfASessionThatDoNotGoTogetherAreNamed) {
    for (
        const auto& [fields, expected] : std::initializer_list<std::pair<std::string, std::string>>{
            {R"("choose")", "alternatives: expected two or more, found 0"},
            {R"("identify", "alternatives": [{"name": "a"}, {"name": "b"}])",
             "alternatives: expected them of the tasks choose and adjust only"},
            {R"("choose", "alternatives": [{"name": "a"}, {"name": "a"}])",
             "alternatives: expected a name of its own for each"},
            {R"("choose", "alternatives": [{"name": "a|b"}, {"name": "a"}])",
             "alternatives: expected names without |, which parts them in trial files"},
            {R"("identify", "answers": ["yes", "no"])",
             "answers: expected two or more of the task choose, in place of alternatives"},
            {R"("choose", "answers": ["a", "a"])", "answers: expected no two alike"},
            {R"("identify", "both_orders": true)",
             "both_orders: expected it of two alternatives to choose from, or of pairs"},
            {R"("rate")", "scales: expected them of the task rate, and of no other"},
            {R"("rate", "scales": ["a", "a"])", "scales: expected a name of its own for each"},
            {R"("identify", "points": 5)", "objects, points, pairs: expected them of the task rate only"},
            {R"("rate", "objects": ["a", "b", "a"])", "objects: expected a name of its own for each"},
            {R"("rate", "objects": ["a|b", "b"])",
             "objects: expected names without |, which parts them in trial files"},
            {R"("rate", "scales": ["a"], "reference": "b")",
             "reference: expected one of the objects, which are rated side by side, without scales"},
            {R"("locate", "once": true)",
             "once: expected it of the tasks rate and describe, where nothing is felt"},
            {R"("describe", "once": true, "most_plays": 1)",
             "once: expected it of the tasks rate and describe, where nothing is felt"},
            {R"("identify", "may_be_empty": true)", "may_be_empty: expected it of the task describe only"},
            {R"("explore")", "task: expected explore in a training session only"},
            {R"("describe", "adjustment": {"alternative": "a"})",
             "adjustment: expected it of the task adjust, and of no other"},
            {R"("adjust", "alternatives": [{"name": "a"}, {"name": "b"}], "adjustment": {"alternative": "c"})",
             "adjustment.alternative: expected the name of an alternative"},
            {R"("adjust", "alternatives": [{"name": "a"}, {"name": "b"}],
                 "adjustment": {"alternative": "a", "least_db": 5, "most_db": -5})",
             "adjustment: expected least_db <= start_db <= most_db"},
            {R"("identify", "levels_from": "main")",
             "levels_from: expected an earlier session of the task adjust"},
            {R"("locate", "levels_file": "a.csv")",
             "levels_file: expected it of the task choose, without another level"},
            {R"("choose", "answers": ["a", "b"], "levels_file": "../a.csv")",
             "levels_file: expected a file in the folder or below, of plain characters"}})
        EXPECT_EQ(readProtocol(R"({"physvib_protocol": 1, "name": "own", "conditions": [{"name": "c",
  "stimuli": "grid", "columns": 1, "rows": 1}], "sessions": [{"name": "main", "task": )" +
                                   fields + "}]}",
                               "own")
                      .error,
                  "own: sessions[0]." + expected);
}

TEST(Protocol, CallsRenderAndReadInTheirFolder) {
    const auto fault = [](const std::string& call, std::vector<std::string> values = {"1"}) {
        Protocol p = gridProtocol();
        p.conditions[0].stimuli = CallSet{{{"a", std::move(values)}, {"b", {"x"}}}, call};
        return validate(p);
    };
    EXPECT_EQ(fault("render drop --set pair={a} --sound 80=wood/a.wav --layout phone1"), "");
    EXPECT_EQ(fault("stimulus phantom --at 0.5,0.5 --level-g {a}"), "");
    EXPECT_EQ(fault("frobnicate {a}"), "conditions[0].call: expected render or stimulus, and what they take");
    EXPECT_EQ(fault("render {a}; touch x"),
              "conditions[0].call: expected letters, digits, spaces and _-+.,:=/%");
    EXPECT_EQ(fault("render {a}", {"$(touch x)"}),
              "conditions[0].call: expected letters, digits, spaces and _-+.,:=/%")
        << "what a value brings";
    EXPECT_EQ(fault("render {a} {c}"),
              "conditions[0].call: expected names of factors or variables in braces, or "
              "alternative, object, level_db; found {c}");
    EXPECT_EQ(fault("render /home/x/scene.json"),
              "conditions[0].call: expected files in the folder or below, found /home/x/scene.json");
    EXPECT_EQ(fault("render drop --layout a/../../x.json"),
              "conditions[0].call: expected files in the folder or below, found a/../../x.json");
    EXPECT_EQ(fault("render drop --sound 80=/x.wav"),
              "conditions[0].call: expected files in the folder or below, found 80=/x.wav");
    EXPECT_EQ(fault("render {a}{a}", {std::string(1000, 'a')}),
              "conditions[0].call: expected at most 2000 bytes with its recordings, found 2007")
        << "it stands in every row";
    EXPECT_EQ(fault("render {a}", {"{b}{b}{b}"}),
              "conditions[0].factors: expected names and values without braces")
        << "sixteen of them would fill the memory";
}

TEST(Protocol, NamesFilesInItsFolderOnly) {
    EXPECT_EQ(fault([](Protocol& p) {
                  p.sounds = {{80.0, "synthetic-1"}, {349.0, "my sounds/ball.wav"}};
              }),
              "");
    EXPECT_EQ(fault([](Protocol& p) {
                  p.sounds = {{80.0, "synthetic-1"}, {349.0, "/home/x/ball.wav"}};
              }),
              "sounds[1].file: expected a file in the folder or below, of plain characters; others are given "
              "with --sound");
    EXPECT_EQ(fault([](Protocol& p) { p.conditions[0].layout = "../x.json"; }),
              "conditions[0].layout: expected a name, or a file in the folder or below");
    EXPECT_EQ(fault([](Protocol& p) {
                  p.conditions[0].stimuli = GridSet{16, 16}, p.sessions[0].repetitions = 1000;
              }),
              "conditions[0].stimuli: expected at most 100000 trials in session main");
}

TEST(Protocol, OnlyRatingsHaveScores) {
    SessionPlan session;
    session.objects = {"oak", "pine"};
    EXPECT_TRUE(session.scores().empty()) << "identify";
    session.task = StudyTask::rate;
    EXPECT_EQ(session.scores(), session.objects);
}

TEST(Protocol, StimuliAreCountedAsTheyAreMade) {
    const auto check = [](StimulusSet set, std::size_t count, const char* first) {
        const ConditionPlan condition{"A", "", "phone4", 205.0, 1.0, std::move(set)};
        const auto items = conditionStimuli(condition);
        EXPECT_EQ(items.size(), count);
        EXPECT_EQ(stimulusCount(condition), static_cast<double>(count));
        EXPECT_EQ(items.front().label, first);
    };
    check(PatternSet{2}, 28, "A-100");
    check(PatternSet{3}, 78, "A-100");
    check(PatternSet{4}, 168, "A-100");
    check(PatternSet{2, {0.05, 0.2, 0.4}}, 42, "A-50");
    check(GridSet{7, 5}, 35, "1,1");
    check(CallSet{{{"pair", {"wood", "steel"}}, {"size", {"small", "large", "huge"}}}, "render {pair}"}, 6,
          "pair=wood size=small");
    check(CallSet{{{"method", {"AV-FV-DRV", "AF-FF-DRF"}}}, "render {method}"}, 2, "AV-FV-DRV");
}

TEST(StudyOrder, LatinSquaresBalancePositionsAndNeighbours) {
    for (std::size_t count = 1; count <= 9; ++count) {
        std::map<std::pair<std::size_t, std::size_t>, int> positions, neighbours;
        const std::size_t rows = count % 2 ? 2 * count : count;
        for (std::size_t row = 0; row < rows; ++row) {
            const auto order = latinSquareRow(count, row);
            EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), count);
            for (std::size_t i = 0; i < count; ++i) ++positions[{i, order[i]}];
            for (std::size_t i = 0; i + 1 < count; ++i) ++neighbours[{order[i], order[i + 1]}];
        }
        const int each = static_cast<int>(rows / count);
        EXPECT_EQ(positions.size(), count * count);
        EXPECT_EQ(neighbours.size(), count * (count - 1));
        for (const auto& [place, times] : positions) EXPECT_EQ(times, each) << count;
        for (const auto& [pair, times] : neighbours) EXPECT_EQ(times, each) << count;
    }
}

TEST(StudyOrder, ConditionsOfAGroupStayTogether) {
    Protocol p = gridProtocol();
    p.conditionOrder = Protocol::ConditionOrder::latinSquare;
    p.conditions.clear();
    for (const char* group : {"PHONE", "RING"})
        for (const char* name : {"2", "3", "4"})
            p.conditions.push_back({std::string(group) + name, group, "phone4", 205.0, 1.0, GridSet{2, 2}});
    std::set<std::vector<std::size_t>> orders;
    for (int number = 1; number <= 12; ++number) {
        const auto order = conditionOrder(p, number);
        orders.insert(order);
        EXPECT_EQ(order[0] / 3, order[1] / 3);
        EXPECT_EQ(order[1] / 3, order[2] / 3);
        EXPECT_NE(order[2] / 3, order[3] / 3);
        EXPECT_EQ(order, conditionOrder(p, number));
    }
    EXPECT_EQ(orders.size(), 12u) << "two orders of groups, six orders inside";
}

TEST(StudyOrder, SessionsHoldEveryStimulusAsOftenAsAsked) {
    SessionPlan session;
    session.repetitions = 5;
    for (const auto order :
         {SessionPlan::Order::given, SessionPlan::Order::random, SessionPlan::Order::blocks}) {
        session.order = order;
        SeededRandom random{3};
        const auto trials = sessionOrder(session, 7, random);
        ASSERT_EQ(trials.size(), 35u);
        std::map<std::size_t, int> counts;
        for (const auto& trial : trials) ++counts[trial.stimulus];
        for (const auto& [stimulus, times] : counts) EXPECT_EQ(times, 5);
        std::set<std::size_t> firstBlock;
        for (std::size_t i = 0; i < 7; ++i) firstBlock.insert(trials[i].stimulus);
        if (order != SessionPlan::Order::random) {
            EXPECT_EQ(firstBlock.size(), 7u);
        }
    }
}

TEST(SeededRandom, IsTheSameOnEveryMachineAndFairEnough) {
    SeededRandom random{1, "name"};
    EXPECT_EQ(random.next(), SeededRandom(1, "name").next());
    EXPECT_NE(SeededRandom(1, "name").next(), SeededRandom(2, "name").next());
    SeededRandom one{1};
    one.next();
    EXPECT_NE(one.next(), SeededRandom(2).next()) << "neighbouring seeds are no shifted copies";
    EXPECT_NE(SeededRandom(1, "name").next(), SeededRandom(1, "other").next());
    std::array<int, 6> dice{};
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < 60000; ++i) {
        ++dice[random.below(6)];
        const double x = random.normal();
        sum += x;
        squares += x * x;
    }
    for (const int face : dice) EXPECT_NEAR(face, 10000, 400);
    EXPECT_NEAR(sum / 60000, 0.0, 0.02);
    EXPECT_NEAR(squares / 60000, 1.0, 0.03);
}

// What a protocol will ask for, against counts by hand.

Protocol builtIn(const std::string& name) { return findProtocol(name).value; }

/// Four conditions of one pattern each.
Protocol four(Protocol::ConditionOrder order) {
    Protocol protocol;
    protocol.conditionOrder = order;
    for (const char* name : {"a", "b", "c", "d"}) {
        protocol.conditions.push_back({});
        protocol.conditions.back().name = name;
        protocol.conditions.back().stimuli = PatternSet{2};
    }
    protocol.sessions.push_back({});
    protocol.sessions.back().name = "main";
    return protocol;
}

TEST(StudyPlan, EveryPartOfEveryStimulusIsPlannedAtItsLowestAndHighestLevel) {
    const auto planned = plannedStimuli(builtIn("model-or-sound"));
    ASSERT_EQ(planned.size(), 27u * (2u + 1u));
    for (const PlannedStimulus& s : planned)
        EXPECT_EQ(s.levelDb, s.part == "SV" ? -8.0 : s.isHighest ? -2.0 : -38.0) << s.part;
    const TrialJob job = planned.front().job(builtIn("model-or-sound"));
    EXPECT_TRUE(has(std::get<ResolvedCall>(job).words, "--level-db -38"));
    EXPECT_EQ(plannedStimuli(builtIn("patterns")).size(), 2u * (28u + 78u + 168u));
    EXPECT_EQ(plannedStimuli(builtIn("eight-methods")).size(), 24u);
}

TEST(StudyPlan, LevelsAddUpAsAnExperimentAddsThem) {
    Protocol protocol = builtIn("model-or-sound");
    for (Alternative& alternative : protocol.sessions[1].alternatives) alternative.levelDb = 3.0;
    for (const PlannedStimulus& s : plannedStimuli(protocol)) {
        if (!s.isHighest) continue;
        // 3 dB, and -2 dB that may have been set
        EXPECT_EQ(s.levelDb, s.part == "SV" ? 3.0 : 1.0) << s.part;
        EXPECT_EQ(s.session, 1u);
    }
    const StaircasePlan staircase = *builtIn("level-steps").sessions[0].staircase;
    for (const PlannedStimulus& s : plannedStimuli(builtIn("level-steps")))
        EXPECT_EQ(s.levelDb, s.part == staircase.alternative && s.isHighest ? staircase.maxDb : 0.0);
}

TEST(StudyPlan, TrialsAreThoseOfTheProtocol) {
    const auto second = [](std::size_t, const std::string&, const std::string&) { return 1.0; };
    const PlannedTime time = plannedTime(builtIn("model-or-sound"), second);
    EXPECT_EQ(time.trials, 27 + 108);
    EXPECT_NEAR(time.seconds, 135 * (2.0 + PlannedTime::answerSeconds) + 180.0, 1e-6);
    EXPECT_NEAR(time.maxStretchSeconds, (27 + 54) * (2.0 + PlannedTime::answerSeconds), 1e-6);
    double trials = 0.0;
    for (const PlannedTrials& planned : plannedTrials(builtIn("model-or-sound")))
        trials += planned.part == "SV" ? planned.count : 0;
    EXPECT_EQ(trials, 135.0);
}

/// Whatever makes a trial play more or less than its stimulus once.
TEST(StudyPlan, PlaysAndTimesAreThoseOfTheTrialsThatComeForEveryKindOfSession) {
    const SessionPlan rate{.name = "main",
                           .task = StudyTask::rate,
                           .repetitions = 2,
                           .answerSeconds = 3.0,
                           .scales = {"liking"}};
    std::vector<SessionPlan> sessions(5, rate);
    sessions[0].comparesPairs = true;
    sessions[1].objects = {"a", "b", "c"};
    sessions[2].objects = {"a", "b", "c"}, sessions[2].scales.clear(), sessions[2].reference = "b";
    sessions[3].task = StudyTask::estimate, sessions[3].scales.clear(), sessions[3].modulus = "2";
    sessions[4].task = StudyTask::choose, sessions[4].scales.clear(), sessions[4].bothOrders = true;
    sessions[4].alternatives = {{"a"}, {"b"}};
    for (const SessionPlan& session : sessions) {
        const bool hasParts = !session.objects.empty() || !session.alternatives.empty();
        Protocol p = gridProtocol();
        p.conditions[0].stimuli =
            CallSet{{{"x", {"1", "2", "3"}}}, hasParts ? "render drop {x} {alternative}" : "render drop {x}"};
        p.sessions = {session};
        ASSERT_EQ(validate(p), "");
        double plays = 0.0, planned = 0.0;
        int trials = 0;
        Experiment experiment{p, {}};
        for (; !experiment.isDone(); ++trials) {
            plays += static_cast<double>(experiment.trial().parts.size());
            experiment.acceptAnswer({});
        }
        for (const PlannedTrials& play : plannedTrials(p)) planned += play.count;
        EXPECT_NEAR(planned, plays, 1e-9) << session.reference << session.modulus;
        const PlannedTime time =
            plannedTime(p, [](std::size_t, const std::string&, const std::string&) { return 1.0; });
        EXPECT_NEAR(time.seconds, plays + trials * 3.0, 1e-9) << session.reference << session.modulus;
    }
}

TEST(StudyPlan, TouchesOfATrainingAreSharedByItsPlacesWithoutARest) {
    double touches = 0.0;
    for (const PlannedTrials& planned : plannedTrials(builtIn("phantom-places"))) touches += planned.count;
    EXPECT_NEAR(touches, 4 * (100 + 175), 1e-9); // 35 places: 2.86 touches each, not 2
}

TEST(StudyPlan, AWorldWithHandsLastsAsLongAsTheSessionAsks) {
    const auto nothing = [](std::size_t, const std::string&, const std::string&) { return 0.0; };
    const PlannedTime time = plannedTime(builtIn("eight-methods"), nothing);
    EXPECT_EQ(time.trials, 16 + 80);
    EXPECT_GT(time.seconds, 96 * 30.0);
}

TEST(StudyPlan, ASquareOfFourIsBalancedForFourAndNotForFive) {
    const Protocol square = four(Protocol::ConditionOrder::latinSquare);
    const OrderBalance whole = orderBalance(square, 4);
    EXPECT_TRUE(whole.isBalanced());
    EXPECT_EQ(whole.minAtPosition, 1);
    EXPECT_EQ(whole.possibleSuccessions, 12);
    EXPECT_FALSE(orderBalance(square, 5).isBalanced());
    const OrderBalance given = orderBalance(four(Protocol::ConditionOrder::given), 8);
    EXPECT_EQ(given.minAtPosition, 0);
    EXPECT_EQ(given.maxAtPosition, 8);
    EXPECT_EQ(given.successions, 3);
}

// Stimuli as values: what is wrong with one, and the words that make it again.

std::string faultText(const StimulusJob& job) {
    const JobError fault = jobError(job);
    return fault ? fault.text() : std::string{};
}

TEST(StimulusJob, ItsWordsAreThoseOfTheProgram) {
    EXPECT_EQ(textOf(StimulusJob{PatternJob{"ABA-250", 0.2}, "ring3", std::nullopt, 0.5}),
              "stimulus pattern ABA-250 --layout ring3 --frequency resonance --level-g 0.5 --gap 0.2");
    EXPECT_EQ(textOf(StimulusJob{PhantomJob{FieldPlace{0.25, 1.0}}}),
              "stimulus phantom --at 0.25,1 --layout phone4 --frequency 205 --level-g 1 --law linear "
              "--exponent 1 --seconds 1");
    const GridPlace cell{{7, 5, PhantomGrid::Points::middles}, {2, 6}};
    EXPECT_EQ(textOf(StimulusJob{PhantomJob{cell, PanningLaw::energy, 2.0, 0.5}, "phone4", 60.5}),
              "stimulus phantom --grid 7x5 --cell 2,6 --points middles --layout phone4 --frequency 60.5 "
              "--level-g 1 --law energy --exponent 2 --seconds 0.5");
}

TEST(StimulusJob, FaultsNameTheWord) {
    EXPECT_EQ(faultText({PatternJob{"ABA-250"}}), "");
    EXPECT_EQ(faultText({PhantomJob{GridPlace{{7, 5}, {5, 7}}}}), "");
    EXPECT_EQ(faultText({PatternJob{"250"}}),
              "expected a pattern like ABA-250 (one to three enchanters, then milliseconds)");
    EXPECT_EQ(faultText({PhantomJob{FieldPlace{0.5, 1.1}}}), "--at: expected X,Y from 0 to 1");
    EXPECT_EQ(faultText({PhantomJob{GridPlace{{17, 5}, {1, 1}}}}), "--grid: expected COLUMNSxROWS like 7x5");
    EXPECT_EQ(faultText({PhantomJob{GridPlace{{7, 5}, {0, 1}}}}),
              "--cell: expected r,c of the grid (row 1 is the upper one)");
    EXPECT_EQ(faultText({PhantomJob{FieldPlace{}, PanningLaw::linear, 0.0}}),
              "--exponent: expected 0.01 to 100");
    EXPECT_EQ(faultText({PatternJob{"A-100"}, "phone4", 0.0}),
              "--frequency: expected 5 to 20000 Hz, or resonance");
    EXPECT_EQ(faultText({PatternJob{"A-100"}, "phone4", 205.0, 2000.0}), "--level-g: expected 1e-06 to 1000");
}

// The page that users read names every task of the table.

TEST(StudyTasks, EachHasALineInTheTableOfProtocols) {
    const auto studies = readFile(PHYSVIB_SOURCE_DIR "/Docs/protocols.md", 1'000'000);
    ASSERT_TRUE(studies) << studies.error;
    for (const auto& task : studyTasks)
        EXPECT_TRUE(has(studies.value, "\n| `" + std::string{task.name} + "` | ")) << task.name;
}

} // namespace physvib::protocol_test
