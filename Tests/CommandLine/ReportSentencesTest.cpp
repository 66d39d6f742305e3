// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences of reports: each with rows of which it is true, and rows of which it must not be said. The pages
// are the list: a sentence of theirs that is not among these fails. Those of the methods' fields are in
// ReportFieldsTest and ProtocolWordsTest, of times in ProtocolExamplesTest, of plans and unfinished
// participants in ReportCommandTest.
#include "EditedReports.h"
#include "Lab/Report/ProtocolWords.h"
#include <set>

namespace physvib {
namespace {

using namespace test;

/// Two conditions of two points each, after a training.
Protocol points() {
    return readProtocol(
               R"({"physvib_protocol": 1, "name": "points", "condition_order": "latin-square",
    "conditions": [{"name": "a", "stimuli": "grid", "columns": 2, "rows": 1}, {"name": "b", "stimuli": "grid", "columns": 2, "rows": 1}],
    "sessions": [{"name": "practice", "training": true, "task": "identify"}, {"name": "main", "task": "identify", "repetitions": 4}]})",
               "points")
        .value;
}

/// The field of nine points, pointed at.
Protocol places() {
    return readProtocol(
               R"({"physvib_protocol": 1, "name": "places", "conditions": [{"name": "a", "stimuli": "grid", "columns": 3, "rows": 2}],
    "sessions": [{"name": "main", "task": "locate", "repetitions": 5}]})",
               "places")
        .value;
}

/// Two sessions each of ratings and of choices.
Protocol sessions() {
    return readProtocol(
               R"({"physvib_protocol": 1, "name": "twice", "conditions": [{"name": "a", "layout": "phone1", "stimuli": "calls",
     "factors": [{"name": "hz", "values": ["80", "120"]}], "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --frequency {hz}"}],
    "sessions": [{"name": "early", "task": "rate", "scales": ["rough"]}, {"name": "late", "task": "rate", "scales": ["rough", "old"]},
     {"name": "what", "task": "choose", "answers": ["wood", "steel", "glass"]}, {"name": "which", "task": "choose", "answers": ["one", "two"]}]})",
               "sessions")
        .value;
}

/// Staircases on the level of `low` and on what `high` has as {hz}, or as {level_db} itself.
Protocol variables(const std::string& hz, const std::string& name) {
    return readProtocol(R"({"physvib_protocol": 1, "name": ")" + name + R"(", "conditions": [
    {"name": "low", "layout": "phone1", "stimuli": "calls", "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --level-db {level_db}"},
    {"name": "high", "layout": "phone1", "stimuli": "calls", "call": "stimulus phantom --at 0.5,0.5 --layout phone1 --frequency )" +
                            hz +
                            R"( --level-g 0.3 --seconds 0.5", "variables": [{"name": "hz", "at_0_db": 200}]}],
    "sessions": [{"name": "main", "task": "choose", "alternatives": [{"name": "standard"}, {"name": "other"}],
     "staircase": {"alternative": "other", "start_db": 5, "step_db": 1, "least_step_db": 0.25, "reversals": 4, "most_db": 6}}]})",
                        name)
        .value;
}

Protocol example(const std::string& name) {
    return loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/" + name + ".json").value;
}

struct Sentence {
    const char* words;
    Rows isTrue, isNot;
};

std::vector<Sentence> sentences() {
    const auto builtIn = [](const char* name) { return findProtocol(name).value; };
    const Protocol grid = points(), steps = builtIn("level-steps"), numbers = builtIn("magnitudes"),
                   quest = builtIn("level-quest"), methods = builtIn("eight-methods"),
                   fits = builtIn("model-or-sound"), field = places(),
                   constant = example("frequency-constant"), names = example("rhythm-names"),
                   interleaved = example("level-mixed"), twice = sessions(),
                   moved = variables("{hz}", "moved"),
                   itself = variables("2{level_db}0 --duty {hz}", "itself");
    Protocol often = grid; // five trials of each cell
    often.name = "often", often.sessions.back().repetitions = 10;
    Protocol matched = example("equal-sensation");
    Protocol told = grid;
    Protocol timed = grid;
    timed.name = "timed", timed.sessions.back().answerSeconds = 1.5;
    told.name = "told", told.sessions.back().task = StudyTask::describe;
    matched.conditions.push_back(matched.conditions.front()); // the chart compares means
    matched.conditions.back().name = "two";
    Protocol twoReferences = matched, twoNumbers = numbers;
    twoNumbers.name = "two-numbers", twoNumbers.conditions.push_back(twoNumbers.conditions.front());
    twoNumbers.conditions.back().name = "two";
    twoReferences.name = "two-references";
    twoReferences.sessions.back().alternatives.front().levelDb = -3.0;
    Protocol cut = interleaved;
    cut.name = "cut", cut.sessions.back().staircase->mostTrials = 6;
    const Edit halfATraining = [](Row& row) {
        if (row["participant"] == "P2" && row["phase"] == "training" && row["trial"] == "2")
            row["participant"].clear();
    };
    Protocol unknown = steps, mixed = steps;
    mixed.sessions.push_back(quest.sessions.front());
    mixed.sessions.back().name = "by quest", mixed.name = "mixed";
    unknown.seed = 77; // no built-in one has its hash
    const Edit device = both(both(set("device", "JACK:x"), set("version", "0.2.0")),
                             both(both(set("master_db", "0"), set("noise_db", "off")),
                                  both(set("limiter_db", "0"), set("left", "1"))));
    const Edit alike = set("correct", "1"), alikeOfP2 = set("correct", "1", "P2");
    const Edit rising = [](Row& row) { // by frequency, from guessing to certainty
        const int trial = std::stoi(row["trial"]), hz = std::stoi("0" + row["stimulus"]);
        row["correct"] = trial * 7 % 10 < (hz - 150) / 12 ? "1" : "0";
    };
    const auto certainAbove = [](const std::string& hz, int wrong) {
        return [=](Row& row) {
            row["correct"] = row["stimulus"] > hz || std::stoi(row["trial"]) % wrong ? "1" : "0";
        };
    };
    const Edit step = certainAbove("230", 2);
    const auto firstOfP2 = [](const char* column, const char* value) {
        return [=](Row& row) {
            if (row["participant"] == "P2" && row["trial"] == "1" && row["phase"] != "training")
                row[column] = value;
        };
    };
    const Edit right = [](Row& row) { row["response"] = row["stimulus"]; };
    const Edit wrongOnce = [=](Row& row) {
        right(row);
        if (row["participant"] == "P2" && row["trial"] == "1")
            row["response"] = row["stimulus"] == "1,1" ? "1,2" : "1,1";
    };
    const Edit aloneIn300 = [=](Row& row) {
        if (row["session"] == "early") firstOfP2("stimulus", "300")(row);
    };
    const Edit equal = [](Row& row) {
        if (row["task"] == "choose") row["choice"] = std::stoi(row["trial"]) % 2 ? "model" : "SV";
    };
    const Edit unscored = [](Row& row) {
        if (row["participant"] == "P2" && row["trial"] == "1") row["rough"].clear();
    };
    const Edit noTraining = [](Row& row) {
        if (row["phase"] == "training") row["participant"].clear();
    };
    const Edit noStaircase = [](Row& row) {
        if (row["participant"] == "P2" && row["quest"].empty()) row["participant"].clear();
    };
    const Edit lacks = [](Row& row) {
        if (row["participant"] == "P2" && (row["trial"] == "5" || row["trial"] == "6"))
            row["participant"].clear();
    };
    const Edit twoPoints = [](Row& row) { // each has one
        if (row["stimulus"] == (row["participant"] == "P1" ? "1,1" : "1,2")) row["participant"].clear();
    };
    const Edit onePoint = [](Row& row) {
        if (row["participant"] == "P2" && row["stimulus"] == "1,1") row["participant"].clear();
    };
    const Edit holes = [](Row& row) {
        if (row["participant"] == "P2" && row["session"] == "main" && row["condition"] == "a" &&
            (row["trial"] == "2" || row["trial"] > "6"))
            row["participant"].clear();
    };
    const Edit stopsEarly = [](Row& row) {
        if (row["participant"] == "P2" && std::stoi(row["trial"]) > 20) row["participant"].clear();
    };
    return {
        {"3 participants in 3 files.", of(grid, 3), of(grid, 2)},
        {"one participant: intervals and tests over participants are not possible", of(grid, 1), of(grid, 2)},
        {"Nobody and no main trial is left out before", of(grid, 3), of(grid, 3, set("response", "", "P2"))},
        {"participant P2: 16 trials without an answer left out", of(grid, 3, set("response", "", "P2")),
         of(grid, 3)},
        {"participant P2 has 8 trials, others have up to 16",
         of(grid, 3,
            [](Row& row) {
                if (row["participant"] == "P2" && row["condition"] == "b") row["participant"].clear();
            }),
         of(grid, 3)},
        {"whether everyone finished, and who was at an end of the levels, is not known: levels followed",
         of(unknown, 3), of(grid, 3)},
        {"Trainings are left out of all analyses.", of(grid, 3), of(grid, 3, noTraining)},
        {"levels were set in a training, and no others: it counts", of(fits, 2), of(grid, 3)},
        {"trials do not say on which device", of(grid, 3), of(grid, 3, device)},
        {"trials left through the device JACK:x, every part within 1 dB of its plan, at a master level of 0 "
         "dB, "
         "without pink noise; the limiter lowered none of them.",
         of(grid, 3, device), of(grid, 3, both(device, set("noise_db", "-30")))},
        {"trials named the device JACK:x, but whether all parts left is known of 0 alone;",
         of(grid, 3, both(device, set("left", ""))), of(grid, 3, device)},
        {"trials had no device: nobody felt anything.",
         of(grid, 3, both(device, set("device", "None:no device"))), of(grid, 3, device)},
        {"20 trials did not leave as planned (column left, or a peak of 0 g) and are left out: of P2",
         of(grid, 3, both(device, set("left", "0", "P2"))), of(grid, 3, device)},
        {"the limiter lowered none of them.", of(grid, 3, device),
         of(grid, 3, both(device, set("limiter_db", "0.4")))},
        {"A condition was at one place of the order", of(grid, 3), of(numbers, 3)},
        {"Every trial had the level of its call; nobody measured what was felt.", of(grid, 3),
         of(grid, 3, set("level_db", "3"))},
        {"Every trial had the level of its call; nobody measured what was felt.", of(grid, 3),
         of(grid, 3, set("peak_g", "0.4"))},
        {"Every trial had the level of its call; nobody measured what was felt.", of(grid, 3),
         of(matched, 3, set("level_db", "0"), true)},
        {"Every trial had the level of its call; nobody measured what was felt.", of(grid, 3),
         of(grid, 3, set("render", ""))},
        {"Levels in g are samples as the program counted them when they left",
         of(grid, 3, set("peak_g", "0.4")), of(grid, 3, set("level_db", "3"))},
        {"exposure was not measured in these trials", of(grid, 3, set("peak_g", "0.4")),
         of(grid, 3, set("a8_m_per_s2", "0.1"))},
        {"level_db: in dB of the condition", of(steps, 3), of(steps, 3, set("level_db", "0"))},
        {"Dotted: mean threshold, shaded its 95 % interval over participants (levels.csv).", of(steps, 3),
         of(steps, 1)},
        {"Dotted: mean threshold, shaded its 95 % interval over participants where there are several.",
         of(constant, 3, rising, true), of(constant, 1, rising, true)},
        {"Circles: all participants' trials, larger where there were more. Dotted", of(steps, 3),
         of(numbers, 3)},
        {"Circles: all participants' trials, larger where there were more.", of(constant, 3, alike, true),
         of(constant, 3, rising, true)},
        {"thin lines: the function of each participant who has one; thick: that of the mean threshold and",
         of(constant, 3, rising, true), of(constant, 3, alike, true)},
        {"not analysed: nobody can be fitted", of(constant, 3, alike, true), of(constant, 3, rising, true)},
        {"a step fits as well, so the answers tell no JND; the mean JND lacks it, which may be the smallest; "
         "the "
         "threshold that counts is the middle of those that fit as well, between ",
         of(constant, 3, step, true), of(constant, 3, rising, true)},
        {"functions are logistic, with a guess rate of", of(constant, 3, rising, true), of(quest, 3)},
        {"The JND is half of what lies between a quarter and three quarters.", of(constant, 3, rising, true),
         of(quest, 3)},
        {"thresholds by QUEST+: of each participant with the widths that all answers in the condition tell "
         "together; "
         "intervals are Student's t and the error of these widths",
         of(quest, 3), of(quest, 1)},
        {", 95 % intervals over participants, Wilson's of as many people where all chose one or none did. ",
         of(fits, 3, set("choice", "model")), of(fits, 3)},
        {"95 % intervals over trials, Wilson's", of(fits, 1), of(fits, 3)},
        {"Chance: 1 of the 2 alternatives offered or given.", of(fits, 3), of(methods, 3)},
        {"Mean scores in late, 95 % intervals over participants.", of(twice, 3, {}, true), of(methods, 3)},
        {"Mean of the participants' shares in which, 95", of(twice, 3, {}, true), of(fits, 3)},
        {"without a score of", of(twice, 3, unscored, true), of(twice, 3, {}, true)},
        {"level_db: of low in dB of the condition's own level, of what its variable is at 0 dB, or of a "
         "call's full scale; of high in dB of "
         "hz at 0 dB",
         of(moved, 3, {}, true), of(steps, 3)},
        {"what {level_db} is in the call", of(itself, 3, {}, true), of(moved, 3, {}, true)},
        {"of one participant without intervals", of(grid, 1), of(grid, 3)},
        {", 95 % intervals over participants", of(grid, 3), of(grid, 1)},
        {"intervals over participants: Student", of(grid, 3), of(grid, 1)},
        {"95 % interval over trials", of(grid, 1), of(grid, 3)},
        {"Magnitude estimations: geometric means", of(numbers, 3), of(steps, 3)},
        {"one estimate per condition, so it has no interval", of(grid, 3), of(numbers, 3)},
        {"The unit is the participant. Training, and trials that did not leave, are left out. Corrections "
         "are "
         "named with their p; sphericity and normality are shown, and decide nothing.",
         of(grid, 3), of(grid, 1)},
        {"analysis.R, beside this page, chooses each test by its measure and by", of(grid, 3), of(grid, 1)},
        {"It has not run: type `Rscript analysis.R` in this folder.", of(grid, 3), of(grid, 1)},
        {"1 participant in 1 file.", of(grid, 1), of(grid, 2)},
        {"is no built-in one: give it by --protocol", of(grid, 3), of(steps, 3)},
        {"Each of these calls of physvib renders a stimulus again", of(grid, 3),
         of(grid, 3, set("render", ""))},
        {"with pink noise of -30 dB of full scale", of(grid, 3, both(device, set("noise_db", "-30"))),
         of(grid, 3, device)},
        {"of them, by at most 0.4 dB.", of(grid, 3, both(device, set("limiter_db", "0.4"))),
         of(grid, 3, device)},
        {"peak_g: the peak of the signal", of(grid, 3, set("peak_g", "0.4")), of(grid, 3)},
        {"rms_g: its root mean square", of(grid, 3, set("rms_g", "0.4")), of(grid, 3)},
        {"a8_m_per_s2: the participant's exposure up to there", of(grid, 3, set("a8_m_per_s2", "0.1")),
         of(grid, 3)},
        {"Dotted: log2 of the number of stimuli.", of(grid, 3), of(numbers, 3)},
        {"Mean of the participants' own information transfer", of(grid, 3), of(grid, 1)},
        {"Few trials make those that are not corrected too high", of(grid, 3), of(often, 3)},
        {"3 participants, not corrected\n", of(grid, 3), of(often, 3)},
        {"3 participants, corrected\n", of(often, 3), of(grid, 3)},
        {"people have 5 to 8 trials, by whose number they count in IT", of(grid, 3, holes), of(grid, 3)},
        {"Mean percent correct, 95 % intervals over participants, cut at 0 and 100 %", of(grid, 3, wrongOnce),
         of(grid, 3, right)},
        {"; no interval: Student's would reach below 0)", of(constant, 3, rising, true),
         of(constant, 1, rising, true)},
        {", in the unit of stimulus, 3 participants", of(constant, 3, rising, true), of(steps, 3)},
        {", none where all have the same share", of(fits, 3, equal), of(fits, 3, set("choice", "model"))},
        {"intervals over participants, cut at 0 and 100 %", of(fits, 3), of(fits, 3, set("choice", "model"))},
        {"no power law is fitted: participant P2, condition PHONE, session main, stimulus wood: column "
         "stimulus",
         of(numbers, 3, firstOfP2("stimulus", "wood")), of(numbers, 3)},
        {"not analysed: participant P2, condition a, session early, stimulus ",
         of(twice, 3, firstOfP2("rough", "120"), true), of(twice, 3, {}, true)},
        {"1 magnitude of 0, which has no logarithm, left out: of P2 in ",
         of(numbers, 3, firstOfP2("value", "0")), of(numbers, 3)},
        {", 95 % intervals over trials, of one participant", of(methods, 1), of(methods, 3)},
        {"intervals over participants, none of one alone.", of(twice, 3, aloneIn300, true),
         of(twice, 3, {}, true)},
        {"Mean percent correct (as thesis Fig. 3.12, 4.3)", of(builtIn("patterns"), 2), of(grid, 3)},
        {"Percent correct by place", of(grid, 3), of(names, 3)},
        {"intervals over participants where there is room, cut at 0 and 100 %, and none where all have the "
         "same share.",
         of(grid, 3), of(grid, 1)},
        {"Confusions: rows are stimuli, columns responses", of(names, 3), of(grid, 3)},
        {"Where labels have no room every second, third ... is shown.", of(names, 3), of(grid, 3)},
        {", without those who lack a stimulus.", of(grid, 3), of(grid, 2, twoPoints)},
        {", each of the stimuli that there are.", of(grid, 2, twoPoints), of(grid, 3)},
        {"stimuli are lacking of P2: left out of means of participants", of(grid, 3, onePoint), of(grid, 3)},
        {"stimuli are lacking of P1, P2: each counts with those that there are", of(grid, 2, twoPoints),
         of(grid, 3)},
        {"shares over several conditions are of all trials that each participant had in them", of(fits, 3),
         of(grid, 3)},
        {"Mean percent correct, 1 step of tolerance", of(grid, 3), of(names, 3)},
        {"Every response (coloured by target, shaped by its row)", of(field, 3), of(grid, 3)},
        {"Mean perceived column and row against the intended one", of(field, 3), of(grid, 3)},
        {"The likeliest target of every place", of(field, 3), of(grid, 3)},
        {"Numbers, row,column of the target, stand at the mean", of(field, 3), of(grid, 3)},
        {"Percent counts: the share of the field", of(field, 3), of(grid, 3)},
        {"Framed: below 1.42 %.", of(field, 3), of(grid, 3)},
        {"Share of answers \u201ccorrect\u201d by stimulus.", of(constant, 3, {}, true), of(steps, 3)},
        {"Mean of the participants' shares", of(fits, 3), of(steps, 3)},
        {"Mean scores (as thesis Fig. 5.14)", of(methods, 3), of(grid, 3)},
        {"Mean scores by factor (as thesis Fig. 5.13)", of(methods, 3), of(grid, 3)},
        {"Shares by two factors (as thesis Fig. 5.9)", of(fits, 3), of(steps, 3)},
        {"Share of answers \u201ccorrect\u201d by level (dB).", of(steps, 3), of(numbers, 3)},
        {"Circles: trials, larger where there were more; line: the function. Dotted",
         of(constant, 1, rising, true), of(constant, 3, rising, true)},
        {"Shares of the alternatives in which, of one participant: 95", of(twice, 1, {}, true),
         of(twice, 3, {}, true)},
        {"Dotted: threshold (levels.csv).", of(quest, 1), of(quest, 3)},
        {"Dotted: threshold. ", of(constant, 1, rising, true), of(constant, 3, rising, true)},
        {"Each participant's numbers are divided by their own geometric mean in that condition first.",
         of(numbers, 3), of(twoNumbers, 3, {}, true)},
        {"own geometric mean in that condition first: conditions cannot be compared here.",
         of(twoNumbers, 3, {}, true), of(numbers, 3)},
        {"participant P2 left out: expected answers that change with the level",
         of(constant, 3, both(rising, alikeOfP2), true), of(constant, 3, rising, true)},
        {"<h2>Magnitudes", of(numbers, 3), of(steps, 3)},
        {": geometric mean magnitude ", of(numbers, 3), of(steps, 3)},
        {": 100, beside 200 at 0 dB, set to ", of(matched, 3, {}, true), of(steps, 3)},
        {"; dashed: the level of 200.", of(matched, 3, {}, true), of(twoReferences, 3, {}, true)},
        {" of those who have a function, so not of P2 in ", of(constant, 3, both(rising, alikeOfP2), true),
         of(constant, 3, rising, true)},
        {"interval over participants, without P2 in ", of(steps, 3, set("level_db", "0", "P2")),
         of(steps, 3)},
        {"Levels that were set by adjustment: means", of(matched, 3, {}, true), of(steps, 3)},
        {"were set to an end of their range, -12 to 18 dB: the match may lie beyond it",
         of(matched, 3, set("value", "-12"), true), of(matched, 3, {}, true)},
        {"Neighbouring rows and columns merged until every cell reaches 1.42 %", of(field, 3), of(grid, 3)},
        {"trials per cell, expected at least", of(names, 3), of(numbers, 3)},
        {"left out: a staircase has fewer than two reversals", of(steps, 3, set("level_db", "0")),
         of(steps, 3)},
        {"lies outside the levels that were played", of(constant, 3, certainAbove("210", 9), true),
         of(steps, 3)},
        {"one participant, or no column participant: intervals are over trials", of(fits, 1), of(fits, 3)},
        {"16 trials without a response left out", of(grid, 3, set("response", "", "P2")), of(grid, 3)},
        {": 1 of 2 trials, a training", of(grid, 3, halfATraining, true), of(grid, 3)},
        {"reversals, for which nothing is left out", of(cut, 3, {}, true), of(interleaved, 3, {}, true)},
        {"thresholds of staircases: means of the later half of the reversals of the level that a trial "
         "followed, so "
         "without "
         "one that ended the staircase or whose level a bound held (of an odd number also the middle one); "
         "of "
         "several staircases their "
         "mean, and none where one of them has none",
         of(steps, 3), of(quest, 3)},
        {"participant P2 did not finish main in ", of(interleaved, 3, stopsEarly, true),
         of(interleaved, 3, {}, true)},
        {"no means are known of these columns", of(grid, 2, set("phase", "training")), of(grid, 3)},
        {"of a factor's level a participant has the mean", of(methods, 2), of(twice, 2)},
        {"P2: the file lacks trials 2, 7 to 8 of main in a: 5 of 8 trials", of(grid, 3, holes, true),
         of(grid, 3)},
        {"P2: the file lacks trials 5 to 6 of main in ", of(interleaved, 3, lacks, true),
         of(interleaved, 3, {}, true)},
        {"in participants' own words", of(told, 2), of(grid, 3)},
        {" of them empty: counted by stimulus", of(told, 2, set("response", "", "P2")), of(told, 2)},
        {"trials ran out of time, without an answer: analyses leave them out", of(timed, 3, {}, true),
         of(grid, 3)},
        {"trials ran out of time, without an answer", of(timed, 3, {}, true), of(grid, 3)},
        {"stimuli were not answered equally often", of(timed, 3, {}, true), of(grid, 3)},
        {"(... to ...): 95 % interval over participants", of(fits, 3), of(fits, 1)},
        {"16 answers in participants' own words: counted by stimulus, not analysed.", of(told, 1),
         of(told, 1, set("phase", "training"))},
    };
}

/// Sentences that other tests have with their counter-examples, and words of the rows and of the protocol.
const char* const toldElsewhere[] = {"to be filled in: ",
                                     "without a file of times",
                                     "Every table below is CSV",
                                     "report: physvib",
                                     "trials: physvib",
                                     "protocol: ",
                                     "seed of all orders: ",
                                     "left out: a step ",
                                     "left out: the share ",
                                     "left out: the f",
                                     "of main has fewer than two reversals"};

bool isKnown(const std::string& sentence, const std::vector<Sentence>& all,
             const std::set<std::string>& plan) {
    const auto shares = [&](const std::string& words) {
        return sentence.find(words) != std::string::npos || words.find(sentence) != std::string::npos;
    };
    for (const char* const words : toldElsewhere)
        if (sentence.find(words) != std::string::npos) return true;
    if (sentence.ends_with(".csv") && sentence.find(' ') == std::string::npos) return true;
    return std::ranges::any_of(plan, shares) ||
           std::ranges::any_of(all, [&](const Sentence& one) { return shares(withoutNumbers(one.words)); });
}

/// What a protocol says of itself (ProtocolWordsTest).
std::set<std::string> wordsOf(const Protocol& protocol) {
    std::set<std::string> words;
    for (const std::string& one : protocolSentences(protocol)) words.insert(withoutNumbers(one));
    for (const auto& one : protocol.conditions) words.insert(withoutNumbers(conditionWords(one)));
    for (const auto& one : protocol.sessions) words.insert(withoutNumbers(sessionWords(one, protocol)));
    for (const std::string& one : soundLines(protocol)) words.insert(withoutNumbers(one));
    for (const ThesisDeviation& one : deviationsOf(protocol))
        words.insert(withoutNumbers(std::string{one.here}));
    return words;
}

TEST(ReportSentences, AGroupChangesTheNameOfAPlannedTest) {
    const auto trials = readReportTrials({{"P1.csv", fileOf(points(), 1, {})}}, {}, {}).value;
    const auto withGroup =
        comparedWithPlan(
            "# physvib 1 plan=study hash=" + trials.common("hash") +
                " participants=1\n- test: Friedman's test of x by a, b\n",
            "plan", trials,
            std::vector<std::string>{"Friedman's and Kruskal and Wallis' test of x by a, b, group"})
            .value;
    EXPECT_EQ(withGroup.back(), "Planned as Friedman's test of x by a, b, done as Friedman's and Kruskal and "
                                "Wallis' test of x by a, b, group");
}

TEST(ReportSentences, APlanWithoutTestsIsKeptByAReportWithoutTests) {
    const auto trials = readReportTrials({{"P1.csv", fileOf(points(), 1, {})}}, {}, {}).value;
    const auto last = [&](const std::string& participants,
                          const std::optional<std::vector<std::string>>& done) {
        return comparedWithPlan("# physvib 1 plan=study hash=" + trials.common("hash") +
                                    " participants=" + participants + "\nnone\n",
                                "plan", trials, done)
            .value.back();
    };
    const std::vector<std::string> none;
    EXPECT_EQ(last("1", none), "The number of participants is as planned; plan and report make no test.");
    EXPECT_EQ(last("2", none), "Plan and report make no test.");
    EXPECT_EQ(last("1", std::vector<std::string>{"a"}), "Not planned: a");
    EXPECT_EQ(last("1", {}),
              "The tests are not compared: R did not run, now or when it was planned; the scripts can be.");
}

TEST(ReportSentences, APlanIsOfTheProtocolOrOfAnother) {
    const auto trials = readReportTrials({{"P1.csv", fileOf(points(), 1, {})}}, {}, {}).value;
    const std::string own = trials.common("hash");
    const auto first = [&](const std::string& hash) {
        return comparedWithPlan("# physvib 1 plan=study hash=" + hash + " participants=1\nnone\n", "plan",
                                trials, {})
            .value.front();
    };
    EXPECT_NE(first(own).find(", is of the protocol of these trials (hash " + own + ")."), std::string::npos);
    EXPECT_NE(first("0").find(", is of another protocol than these trials: hash 0, theirs " + own + "."),
              std::string::npos)
        << first("0");
}

TEST(ReportSentences, WhatCouldNotBeTestedIsToldByItsKind) {
    EXPECT_EQ(
        notMadeIn("# R\ntest,effect,statistic,p,note\na,left out,note,,of P1\nb,factors,,,nobody varies\n"
                  "c,d,t,0.5,\n"),
        std::vector<std::string>{"Not made: b, factors: nobody varies"});
}

TEST(ReportSentences, BarsOfPointsBeginAtTheFirst) {
    const auto ticks = [](const Protocol& protocol) {
        const std::string page = pageOf(of(protocol, 8, {}, true));
        const auto at = page.find("<title>Mean scores");
        const std::string chart = page.substr(at, page.find("</svg>", at) - at);
        return std::pair{chart.find(">0</text>") != chart.npos, chart.find(">7</text>") != chart.npos};
    };
    EXPECT_EQ(ticks(example("likert-seven")), std::pair(false, true));
    EXPECT_EQ(ticks(example("taps-ratings")), std::pair(true, false));
}

TEST(ReportSentences, UnfinishedStaircasesAreDrawn) {
    const Edit early = [](Row& row) {
        if (row["participant"] == "P2" && std::stoi(row["trial"]) > 5) row["participant"].clear();
        if (row["participant"] == "P2") row["level_db"] = "70";
    };
    const Protocol steps = findProtocol("level-steps").value;
    EXPECT_NE(pageOf(of(steps, 3, early)).find(">70</text>"), std::string::npos);
    EXPECT_EQ(pageOf(of(steps, 3)).find(">70</text>"), std::string::npos);
}

TEST(ReportSentences, StaircasesThatRanOutOfTimeAreNoChoices) {
    Protocol timed = findProtocol("level-steps").value;
    timed.name = "timed-steps", timed.sessions.back().answerSeconds = 1.5;
    const std::string page = pageOf(of(
        timed, 2,
        [](Row& row) {
            if (row["trial"] == "2") row["ran_out"] = "1", row["correct"].clear();
        },
        true));
    EXPECT_NE(page.find("ran out of time, without an answer"), std::string::npos);
    for (const char* untrue : {"<h2>Choices", "expected trials of this kind"})
        EXPECT_EQ(page.find(untrue), std::string::npos) << untrue;
}

TEST(ReportSentences, EachIsThereOnlyWhereRowsMakeItTrue) {
    const auto all = sentences();
    std::set<std::string> unknown;
    const auto pageAndItsSentences = [&](const Rows& rows) {
        std::string page = pageOf(rows);
        for (const std::string& sentence : sentencesIn(page))
            if (!isKnown(sentence, all, wordsOf(rows.protocol))) unknown.insert(sentence);
        return page;
    };
    for (const auto& [words, isTrue, isNot] : all) {
        EXPECT_NE(pageAndItsSentences(isTrue).find(words), std::string::npos) << words;
        EXPECT_EQ(pageAndItsSentences(isNot).find(words), std::string::npos) << "untrue: " << words;
    }
    for (const std::string& sentence : unknown) ADD_FAILURE() << "without a counter-example: " << sentence;
}

} // namespace
} // namespace physvib
