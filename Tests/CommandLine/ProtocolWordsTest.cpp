// SPDX-License-Identifier: GPL-3.0-or-later
// Every field of a protocol has its words in the report's section on methods, or a reason why not; without
// the field there are no such words.
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Files/ProtocolFields.h"
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace physvib {
namespace {

/// Names of fields, "session.repetitions".
struct FieldLister {
    std::string of;
    std::set<std::string>& names;
    void field(std::string_view name, auto, Bounds, Need) { names.insert(of + "." + std::string(name)); }
    void choice(std::string_view name, auto, const auto&) { names.insert(of + "." + std::string(name)); }
    void variant(std::string_view name, auto, const auto&) { names.insert(of + "." + std::string(name)); }
};

template <class T>
void listFields(const char* of, std::set<std::string>& names) {
    FieldLister lister{of, names};
    visitFields(lister, FieldsOf<T>{});
}

std::set<std::string> allFields() {
    std::set<std::string> names;
    listFields<Protocol>("protocol", names);
    listFields<ConditionPlan>("condition", names);
    listFields<PatternSet>("patterns", names);
    listFields<GridSet>("grid", names);
    listFields<CallSet>("calls", names);
    listFields<WorldSet>("world", names);
    listFields<StudyFactor>("factor", names);
    listFields<StudyVariable>("variable", names);
    listFields<StudySoundFile>("sound", names);
    listFields<MaterialPictureFile>("picture", names);
    listFields<SessionPlan>("session", names);
    listFields<Alternative>("alternative", names);
    listFields<Adjustment>("adjustment", names);
    listFields<StaircasePlan>("staircase", names);
    listFields<QuestMethod>("quest", names);
    return names;
}

/// Fields that have no words of their own, and why.
const std::map<std::string, std::string> wordless{
    {"protocol.seed", "Files, versions, seeds has it from the trial files"},
    {"protocol.sounds", "a line each"},
    {"protocol.pictures", "a sentence each"},
    {"protocol.conditions", "a line each"},
    {"protocol.sessions", "a line each"},
    {"condition.observer_blur", "of simulated observers"},
    {"condition.stimuli", "the sets have words of their own"},
    {"world.factors", "as those of calls"},
    {"world.variables", "as those of calls"},
};

using Edit = std::function<void(Protocol&)>;

Edit condition(std::function<void(ConditionPlan&)> edit) {
    return [edit](Protocol& p) { edit(p.conditions.front()); };
}
Edit session(std::function<void(SessionPlan&)> edit) {
    return [edit](Protocol& p) { edit(p.sessions.front()); };
}
/// The condition's stimuli as that set, edited.
template <class Set>
Edit stimuli(std::function<void(Set&)> edit) {
    return condition([edit](ConditionPlan& c) {
        if (!std::holds_alternative<Set>(c.stimuli)) c.stimuli = Set{};
        edit(std::get<Set>(c.stimuli));
    });
}
/// A part of the session that may be missing, edited.
template <class Part>
Edit part(std::optional<Part> SessionPlan::*member, std::function<void(Part&)> edit) {
    return session([member, edit](SessionPlan& s) {
        if (!(s.*member)) (s.*member).emplace();
        edit(*(s.*member));
    });
}

struct PlantedField {
    const char* name;
    Edit edit;
    const char* words;
    Edit before = [](Protocol&) {}; ///< done to the protocol without the field as well
};

std::vector<PlantedField> plantedFields() {
    const Edit manyPoints = stimuli<GridSet>([](GridSet& s) { s.columns = s.rows = 6; });
    const Edit two = session([](SessionPlan& s) { s.alternatives = {{"one"}, {"other"}}; });
    const Edit adjusts = part<Adjustment>(&SessionPlan::adjustment, [](Adjustment&) {});
    const Edit stairs = part<StaircasePlan>(&SessionPlan::staircase, [](StaircasePlan&) {});
    const Edit quests = part<QuestMethod>(&SessionPlan::quest, [](QuestMethod&) {});
    const Edit scaled = session([](SessionPlan& s) { s.task = StudyTask::rate, s.scales = {"realism"}; });
    const auto adjustment = [&](std::function<void(Adjustment&)> edit) {
        return part<Adjustment>(&SessionPlan::adjustment, std::move(edit));
    };
    const auto staircase = [&](std::function<void(StaircasePlan&)> edit) {
        return part<StaircasePlan>(&SessionPlan::staircase, std::move(edit));
    };
    const auto variables = [](std::vector<StudyVariable> all) {
        return stimuli<CallSet>([all](CallSet& c) { c.variables = all; });
    };
    const auto quest = [&](std::function<void(QuestMethod&)> edit) {
        return part<QuestMethod>(&SessionPlan::quest, std::move(edit));
    };
    return {
        {"protocol.name", [](Protocol& p) { p.name = "planted"; }, "Protocol planted"},
        {"protocol.title", [](Protocol& p) { p.title = "what is planted"; }, ": what is planted."},
        {"protocol.condition_order",
         [](Protocol& p) { p.conditionOrder = Protocol::ConditionOrder::latinSquare; },
         "in each condition; the order of conditions is latin-square.",
         [](Protocol& p) { p.conditions.push_back(p.conditions.front()); }},
        {"protocol.condition_break_s", [](Protocol& p) { p.conditionBreakSeconds = 77; },
         "A break of 77 s lies before each condition but the first."},
        {"protocol.exposure_limit_m_per_s2", [](Protocol& p) { p.exposureLimit = 1.25; },
         "A(8) of 1.25 m/s^2"},
        {"protocol.pink_noise", [](Protocol& p) { p.hasPinkNoise = true; }, "is to mask what can be heard."},
        {"protocol.pink_noise_db", [](Protocol& p) { p.hasPinkNoise = true, p.pinkNoiseDb = -41; },
         "Pink noise of -41 dB of full scale (root mean square)"},
        {"protocol.closing_question", [](Protocol& p) { p.closingQuestion = "Why so?"; },
         "in one's own words: \u201cWhy so?\u201d"},
        {"protocol.words", [](Protocol& p) { p.words = "ko"; }, "unless others were chosen: ko."},
        {"condition.name", condition([](ConditionPlan& c) { c.name = "GLOVE"; }), "GLOVE: "},
        {"condition.group", condition([](ConditionPlan& c) { c.group = "first day"; }), "(group first day)"},
        {"condition.layout", condition([](ConditionPlan& c) { c.layout = "ring3"; }), "layout ring3"},
        {"condition.frequency_hz", condition([](ConditionPlan& c) { c.frequencyHz = 61; }), "61 Hz"},
        {"condition.at_resonance", condition([](ConditionPlan& c) { c.isAtResonance = true; }),
         "the actuators' resonance"},
        {"condition.level_g", condition([](ConditionPlan& c) { c.levelG = 0.37; }), "0.37 g"},
        {"patterns.enchanters", stimuli<PatternSet>([](PatternSet& s) { s.enchanters = 3; }),
         "pulse patterns on 3 actuators"},
        {"patterns.pulse_s", stimuli<PatternSet>([](PatternSet& s) {
             s.pulseSeconds = {0.033, 0.4};
         }),
         "pulses of 0.033, 0.4 s"},
        {"patterns.gap_s", stimuli<PatternSet>([](PatternSet& s) { s.gapSeconds = 0.07; }), "0.07 s apart"},
        {"grid.columns", stimuli<GridSet>([](GridSet& s) { s.columns = 7; }), "7 x 0 (columns x rows)"},
        {"grid.rows", stimuli<GridSet>([](GridSet& s) { s.rows = 6; }), "0 x 6 (columns x rows)"},
        {"grid.points", stimuli<GridSet>([](GridSet& s) { s.points = PhantomGrid::Points::middles; }),
         "points in the middles of cells"},
        {"grid.law", stimuli<GridSet>([](GridSet& s) { s.law = PanningLaw::energy; }), "law energy"},
        {"grid.exponent", stimuli<GridSet>([](GridSet& s) { s.exponent = 1.7; }), "with exponent 1.7"},
        {"grid.seconds", stimuli<GridSet>([](GridSet& s) { s.seconds = 0.45; }), ", 0.45 s"},
        {"calls.call", stimuli<CallSet>([](CallSet& s) { s.call = "stimulus phantom"; }),
         "calls of physvib \u201cstimulus phantom\u201d; layout"},
        {"world.call", stimuli<WorldSet>([](WorldSet& s) { s.call = "render drop"; }),
         "a world that is seen and felt \u201crender drop\u201d"},
        {"calls.factors", stimuli<CallSet>([](CallSet& s) {
             s.factors = {{"pair", {"a"}}, {"size", {"b"}}};
         }),
         "by pair (a), size (b)"},
        {"factor.name", stimuli<CallSet>([](CallSet& s) {
             s.factors = {{"weight", {"a"}}};
         }),
         "by weight ("},
        {"factor.values", stimuli<CallSet>([](CallSet& s) {
             s.factors = {{"method", {"AF-FV-DRF", "SV"}}};
         }),
         "(AF-FV-DRF: amplitude fixed, frequency varied, decay fixed; SV: the recorded contact)"},
        {"factor.labels", stimuli<CallSet>([](CallSet& s) {
             s.factors = {{"db", {"-80", "0"}, {"no", "yes"}}};
         }),
         "(-80; 0, called no; yes)"},
        {"factor.alternative", stimuli<CallSet>([](CallSet& s) {
             s.factors = {{"hz", {"220"}, {}, "higher", "200"}};
         }),
         "hz (220) of higher"},
        {"factor.otherwise", stimuli<CallSet>([](CallSet& s) {
             s.factors = {{"hz", {"220"}, {}, "higher", "200"}};
         }),
         "of higher, otherwise 200"},
        {"world.hands", stimuli<WorldSet>([](WorldSet& s) { s.hasHands = true; }),
         "the participant drags and tilts it", stimuli<WorldSet>([](WorldSet&) {})},
        {"world.display_scale", stimuli<WorldSet>([](WorldSet& s) { s.displayScale = 50; }),
         "shown at a scale of 1:50", stimuli<WorldSet>([](WorldSet&) {})},
        {"sound.frequency_hz",
         [](Protocol& p) {
             p.sounds = {{83, "ball.wav"}};
         },
         "83 Hz: "},
        {"sound.file",
         [](Protocol& p) {
             p.sounds = {{83, "synthetic-4"}};
         },
         "synthetic-4 (nobody recorded it)"},
        {"picture.material",
         [](Protocol& p) {
             p.pictures = {{"rubber", "a.png"}};
         },
         "Bodies of rubber are shown by a picture of the participant's own"},
        {"picture.file",
         [](Protocol& p) {
             p.pictures = {{"rubber", "{participant}/a.png"}};
         },
         "own: {participant}/a.png."},
        {"session.name", session([](SessionPlan& s) { s.name = "afterwards"; }), "afterwards: task"},
        {"session.training", session([](SessionPlan& s) { s.isTraining = true; }),
         "(training, left out of analyses)", session([](SessionPlan& s) { s.task = StudyTask::estimate; })},
        {"session.task", session([](SessionPlan& s) { s.task = StudyTask::estimate; }), "task estimate"},
        {"session.question", session([](SessionPlan& s) { s.question = "How much?"; }),
         "\u201cHow much?\u201d"},
        {"session.order", session([](SessionPlan& s) { s.order = SessionPlan::Order::blocks; }),
         "order blocks"},
        {"session.repetitions", session([](SessionPlan& s) { s.repetitions = 17; }), "17 repetitions"},
        {"session.fewest_touches", session([](SessionPlan& s) { s.fewestTouches = 90; }), "90 touches"},
        {"session.answer_within_s", session([](SessionPlan& s) { s.answerSeconds = 3; }),
         "answers up to 3 s"},
        {"session.most_plays", session([](SessionPlan& s) { s.mostPlays = 3; }), "felt at most 3 times"},
        {"session.least_s", session([](SessionPlan& s) { s.leastSeconds = 11; }),
         "at least 11 s with each part before the answer"},
        {"session.break_before_s", session([](SessionPlan& s) { s.breakBeforeSeconds = 121; }),
         "a break of 121 s before"},
        {"session.break_every", session([](SessionPlan& s) { s.breakEvery = 23, s.breakSeconds = 60; }),
         " every 23 trials", manyPoints},
        {"session.break_s", session([](SessionPlan& s) { s.breakEvery = 23, s.breakSeconds = 61; }),
         "a break of 61 s every", manyPoints},
        {"session.alternatives", session([](SessionPlan& s) {
             s.task = StudyTask::choose, s.alternatives = {{"one"}, {"other"}};
         }),
         "; alternatives one, other, in random order in each trial"},
        {"session.both_orders", session([](SessionPlan& s) { s.bothOrders = true; }),
         "both orders of the alternatives", two},
        {"session.objects", session([](SessionPlan& s) {
             s.objects = {"ball", "can"};
         }),
         "objects ball, can, in random order in each trial"},
        {"session.scales", session([](SessionPlan& s) {
             s.task = StudyTask::rate, s.scales = {"realism", "liking"};
         }),
         "scales from 0 to 100: realism, liking, between \u201cStrongly disagree\u201d and \u201cStrongly "
         "agree\u201d"},
        {"session.definitions", session([](SessionPlan& s) { s.definitions = {"It was real."}; }),
         "realism (\u201cIt was real.\u201d)", scaled},
        {"session.anchors", session([](SessionPlan& s) {
             s.anchors = {"no", "yes"};
         }),
         "between \u201cno\u201d and \u201cyes\u201d", scaled},
        {"session.show_numbers", session([](SessionPlan& s) { s.showsNumbers = true; }), "with their numbers",
         scaled},
        {"session.points", session([](SessionPlan& s) { s.points = 7; }), "scales of 7 points: ", scaled},
        {"session.reference", session([](SessionPlan& s) { s.reference = "can"; }),
         "after can as the reference, which is among them unnamed", session([](SessionPlan& s) {
             s.task = StudyTask::rate, s.objects = {"ball", "can"};
         })},
        {"session.once", session([](SessionPlan& s) { s.isOnce = true; }),
         "on the condition as a whole, with nothing felt"},
        {"session.pairs", session([](SessionPlan& s) { s.comparesPairs = true; }),
         "each trial has two of the stimuli, every two of them, in random order in each trial"},
        {"session.answers", session([](SessionPlan& s) {
             s.answers = {"left", "right"};
         }),
         "; answers left, right"},
        {"session.adjustment", adjusts, " is set from -40 to 40 dB in steps of 1 dB, starting at 0 dB"},
        {"session.staircase", stairs, "; staircase on "},
        {"session.instruction", session([](SessionPlan& s) { s.instruction = "Feel both."; }),
         "after the page \u201cFeel both.\u201d"},
        {"session.feedback", session([](SessionPlan& s) { s.givesFeedback = true; }),
         "each answer is followed by whether it was right"},
        {"session.correct", session([](SessionPlan& s) { s.correct = "other"; }), "; other is right", two},
        {"session.until_correct", session([](SessionPlan& s) { s.untilCorrect = 6; }),
         "until 6 right answers in a row"},
        {"session.rove_db", session([](SessionPlan& s) { s.roveDb = 3.5; }), "by up to 3.5 dB, at random"},
        {"session.modulus", session([](SessionPlan& s) { s.modulus = "0.4"; }),
         "begins with 0.4, which counts as 10"},
        {"session.modulus_number", session([](SessionPlan& s) { s.modulusNumber = 7; }), "which counts as 7",
         session([](SessionPlan& s) { s.modulus = "0.4"; })},
        {"session.may_be_empty", session([](SessionPlan& s) { s.mayBeEmpty = true; }),
         "an answer may be left empty"},
        {"session.interval_s", session([](SessionPlan& s) { s.intervalSeconds = 0.7; }),
         "one after the other, 0.7 s apart", two},
        {"calls.variables", variables({{"hz", 200.0}}), "; hz is 200 at a level of 0 dB", variables({})},
        {"variable.name", variables({{"decay", 200.0}}), "; decay is", variables({{"hz", 200.0}})},
        {"variable.at_0_db", variables({{"hz", 123.0}}), "is 123 at", variables({{"hz", 200.0}})},
        {"variable.roves", variables({{"hz", 200.0, true}}), "where rove_db is 0, and follows it alone",
         variables({{"hz", 200.0}})},
        {"session.quest", quests, "; QUEST+ on "},
        {"session.levels_from", session([](SessionPlan& s) { s.levelsFrom = "matching"; }),
         "levels from the session matching"},
        {"session.levels_file", session([](SessionPlan& s) { s.levelsFile = "experts.csv"; }),
         "levels from the file experts.csv"},
        {"alternative.name", session([](SessionPlan& s) { s.alternatives = {{"SV"}}; }),
         "SV: the recorded contact"},
        {"alternative.level_db", session([](SessionPlan& s) {
             s.alternatives = {{"one", -9}};
         }),
         "one at -9 dB", two},
        {"adjustment.alternative", adjustment([](Adjustment& a) { a.alternative = "model"; }),
         "; model is set", adjusts},
        {"adjustment.start_db", adjustment([](Adjustment& a) { a.startDb = -7; }), "starting at -7 dB",
         adjusts},
        {"adjustment.random_start", adjustment([](Adjustment& a) { a.startsAnywhere = true; }),
         "starting anywhere in this range", adjusts},
        {"adjustment.step_db", adjustment([](Adjustment& a) { a.stepDb = 0.3; }), "in steps of 0.3 dB",
         adjusts},
        {"adjustment.least_db", adjustment([](Adjustment& a) { a.leastDb = -33; }), "from -33 to", adjusts},
        {"adjustment.most_db", adjustment([](Adjustment& a) { a.mostDb = 3; }), " to 3 dB", adjusts},
        {"staircase.alternative", staircase([](StaircasePlan& s) { s.alternative = "stronger"; }),
         "staircase on stronger", stairs},
        {"staircase.start_db", staircase([](StaircasePlan& s) { s.startDb = 9; }), "starting at 9 dB",
         stairs},
        {"staircase.starts_db", staircase([](StaircasePlan& s) {
             s.startsDb = {9, 2};
         }),
         "2 staircases, each trial of one that is not over, at random, starting at 9, 2 dB", stairs},
        {"staircase.step_db", staircase([](StaircasePlan& s) { s.stepDb = 3; }), "in steps of 3 dB", stairs},
        {"staircase.least_step_db", staircase([](StaircasePlan& s) { s.leastStepDb = 0.7; }),
         "down to 0.7 dB", stairs},
        {"staircase.least_db", staircase([](StaircasePlan& s) { s.leastDb = 1; }), "from 1 to", stairs},
        {"staircase.most_db", staircase([](StaircasePlan& s) { s.mostDb = 12; }), "to 12 dB", stairs},
        {"staircase.up_ratio", staircase([](StaircasePlan& s) { s.upRatio = 3; }),
         "steps up 3 times as large", stairs},
        {"staircase.down", staircase([](StaircasePlan& s) { s.down = 3; }), "3 down, 1 up", stairs},
        {"staircase.reversals", staircase([](StaircasePlan& s) { s.reversals = 13; }), "until 13 reversals",
         stairs},
        {"staircase.most_trials", staircase([](StaircasePlan& s) { s.mostTrials = 99; }), "or 99 trials",
         stairs},
        {"quest.alternative", quest([](QuestMethod& q) { q.alternative = "stronger"; }), "QUEST+ on stronger",
         quests},
        {"quest.shape", quest([](QuestMethod& q) { q.shape = PsychometricShape::logistic; }),
         "function logistic", quests},
        {"quest.least_db", quest([](QuestMethod& q) { q.leastDb = 1; }), "levels from 1 to", quests},
        {"quest.most_db", quest([](QuestMethod& q) { q.mostDb = 12; }), "to 12 dB in", quests},
        {"quest.step_db", quest([](QuestMethod& q) { q.stepDb = 0.25; }), "in steps of 0.25 dB", quests},
        {"quest.least_width_db", quest([](QuestMethod& q) { q.leastWidthDb = 3; }), "widths from 3 to",
         quests},
        {"quest.most_width_db", quest([](QuestMethod& q) { q.mostWidthDb = 9; }), "to 9 dB", quests},
        {"quest.lapse", quest([](QuestMethod& q) { q.lapse = 0.03; }), "lapse rate 0.03", quests},
        {"quest.trials", quest([](QuestMethod& q) { q.trials = 31; }), "until 31 trials", quests},
        {"quest.deviation_db", quest([](QuestMethod& q) { q.deviationDb = 0.9; }),
         "or a standard deviation of the threshold of 0.9 dB", quests},
    };
}

std::string methodsOf(const Protocol& p) {
    std::string text;
    for (const std::string& sentence : protocolSentences(p)) text += sentence + "\n";
    for (const ConditionPlan& c : p.conditions) text += conditionWords(c) + "\n";
    for (const SessionPlan& s : p.sessions) text += sessionWords(s, p) + "\n";
    for (const std::string& line : soundLines(p)) text += line + "\n";
    return text;
}

Protocol plain() {
    Protocol p;
    p.name = "p";
    p.conditions.emplace_back().name = "A";
    p.conditions.front().stimuli = GridSet{};
    p.sessions.emplace_back().name = "main";
    return p;
}

TEST(ProtocolWords, EveryFieldHasItsWordsAndNoneWithoutIt) {
    for (const PlantedField& field : plantedFields()) {
        Protocol with = plain();
        field.before(with);
        EXPECT_EQ(methodsOf(with).find(field.words), std::string::npos)
            << field.name << " is said without it: " << methodsOf(with);
        field.edit(with);
        EXPECT_NE(methodsOf(with).find(field.words), std::string::npos)
            << field.name << ": expected \"" << field.words << "\", found " << methodsOf(with);
    }
}

TEST(ProtocolWords, NoBreakIsToldThatNobodyHas) {
    Protocol p = plain();
    std::get<GridSet>(p.conditions.front().stimuli) = {3, 1, PhantomGrid::Points::middles};
    SessionPlan& s = p.sessions.front();
    s.breakSeconds = 61;
    for (const auto& [every, isTold] : {std::pair{2, true}, {3, false}}) { // none after the last trial
        s.breakEvery = every;
        EXPECT_EQ(methodsOf(p).find("a break of 61 s") != std::string::npos, isTold) << methodsOf(p);
    }
    p.conditions.push_back(p.conditions.front());
    p.conditions.back().name = "longer";
    std::get<GridSet>(p.conditions.back().stimuli).columns = 4;
    EXPECT_NE(methodsOf(p).find("a break of 61 s every 3 trials, none in " + p.conditions.front().name),
              std::string::npos)
        << methodsOf(p);
}

TEST(ProtocolWords, NoFieldIsForgotten) {
    std::set<std::string> known;
    for (const PlantedField& field : plantedFields()) known.insert(field.name);
    for (const auto& [name, reason] : wordless)
        EXPECT_TRUE(known.insert(name).second) << name << " has words, and a reason to have none";
    EXPECT_EQ(known, allFields()) << "a new field: say it in Source/Lab/Report/ProtocolWords.cpp and plant "
                                     "it here, or say why it has no words";
}

} // namespace
} // namespace physvib
