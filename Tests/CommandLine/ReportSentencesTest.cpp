// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences of reports: each with rows of which it is true, and rows of which it must not be said. The pages
// are the list: a sentence of theirs that is not among these fails. Those of the methods' fields are in
// ReportFieldsTest and ProtocolWordsTest, of times in ProtocolExamplesTest, of plans and unfinished
// participants in ReportCommandTest.
#include "EditedReports.h"
#include "Lab/Report/ReportBuilder.h"
#include "Support/Has.h"
#include <set>

namespace physvib::report_sentences_test {

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
                   interleaved = example("level-mixed"), twice = sessions();
    Protocol matched = example("equal-sensation");
    Protocol told = grid;
    Protocol timed = grid;
    timed.name = "timed", timed.sessions.back().answerSeconds = 1.5;
    told.name = "told", told.sessions.back().task = StudyTask::describe;
    matched.conditions.push_back(matched.conditions.front()); // the chart compares means
    matched.conditions.back().name = "two";
    Protocol twoReferences = matched;
    twoReferences.name = "two-references";
    twoReferences.sessions.back().alternatives.front().levelDb = -3.0;
    Protocol cut = interleaved;
    cut.name = "cut", cut.sessions.back().staircase->maxTrials = 6;
    Protocol unknown = steps;
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
    const Edit unscored = [](Row& row) {
        if (row["participant"] == "P2" && row["trial"] == "1") row["rough"].clear();
    };
    const auto without = [](auto is) { // rows
        return Edit{[=](Row& row) {
            if (is(row)) row["participant"].clear();
        }};
    };
    const auto withoutOfP2 = [&](auto is) {
        return without([=](Row& row) { return row["participant"] == "P2" && is(row); });
    };
    const Edit noTraining = without([](Row&row) { return row["phase"] == "training"; }),
               lacks = withoutOfP2([](Row&row) { return row["trial"] == "5" || row["trial"] == "6"; }),
               oneCondition = withoutOfP2([](Row&row) { return row["condition"] == "b"; }),
               twoPoints = without([](Row&row) { // each has one
                   return row["stimulus"] == (row["participant"] == "P1" ? "1,1" : "1,2");
               }),
               onePoint = withoutOfP2([](Row&row) { return row["stimulus"] == "1,1"; }),
               holes = withoutOfP2([](Row&row) {
                   return row["session"] == "main" && row["condition"] == "a" &&
                          (row["trial"] == "2" || row["trial"] > "6");
               }),
               stopsEarly = withoutOfP2([](Row&row) { return std::stoi(row["trial"]) > 20; });
    return {
        {"<td>participants</td><td></td><td class=\"number\">3</td>", of(grid, 3), of(grid, 2)},
        {"no answer</td><td>these trials", of(grid, 3, set("response", "", "P2")), of(grid, 3)},
        {"</td><td>tests of what is lacking, if any", of(grid, 3, oneCondition), of(grid, 3)},
        {"no protocol: unfinished staircases and thresholds at an end of the levels are not known",
         of(unknown, 3), of(grid, 3)},
        {"training</td><td>these trials", of(grid, 3), of(grid, 3, noTraining)},
        {"levels were set in a training, and no others: it counts", of(fits, 2), of(grid, 3)},
        {"trials without a record of device and levels", of(grid, 3), of(grid, 3, device)},
        {"<td>JACK:x</td><td class=\"number\">0</td><td>off</td><td>0.2.0</td>", of(grid, 3, device),
         of(grid, 3, both(device, set("noise_db", "-30")))},
        {"did not leave as planned (column left, or a peak of 0 g)</td><td>these trials",
         of(grid, 3, both(device, set("left", "0", "P2"))), of(grid, 3, device)},
        {"<th>place 2</th>", of(grid, 3), of(numbers, 3)},
        {"peak_g: the peak of the signal", of(grid, 3, set("peak_g", "0.4")), of(grid, 3)},
        {"rms_g: its root mean square", of(grid, 3, set("rms_g", "0.4")), of(grid, 3)},
        {"a8_m_per_s2: the participant's exposure up to there", of(grid, 3, set("a8_m_per_s2", "0.1")),
         of(grid, 3)},
        {"level_db: Level of the trial", of(steps, 3), of(steps, 3, set("level_db", "0"))},
        {"Share of correct answers by level, of all trials that are analysed, also of who has no threshold. "
         "Circles: larger of more "
         "trials. Dotted: mean threshold of the n participants who have one. Threshold of a staircase: mean "
         "of "
         "the later half of the reversals that a trial follows (of 7 the last 4); converges to 70.7 % "
         "correct.",
         of(steps, 3), of(numbers, 3)},
        {" Threshold by QUEST+: mean of its posterior, widths of all participants together.", of(quest, 3),
         of(steps, 3)},
        {"Circles: trials of who has a function, larger of more. Thin lines: participants' functions, "
         "logistic, "
         "guess rate 50 %, lapse rate up to 10 %; threshold: 75 %, apart from lapses. Thick: mean threshold, "
         "and mean width of who has one (a step has none). Dotted: mean threshold. "
         "Column jnd: half of what lies between 0.25 and 0.75 of the shape, without lapses: a slope; no "
         "difference "
         "threshold of "
         "forced choices.",
         of(constant, 3, rising, true), of(constant, 3, alike, true)},
        {"Circles: all trials, larger of more.", of(constant, 3, alike, true), of(constant, 3, rising, true)},
        {"not analysed: nobody can be fitted", of(constant, 3, alike, true), of(constant, 3, rising, true)},
        {"fit as well, of functions as steep as one likes: no half interquartile range; threshold: the "
         "middle",
         of(constant, 3, step, true), of(constant, 3, rising, true)},
        {"participant P2 left out: expected answers that change with the level",
         of(constant, 3, both(rising, alikeOfP2), true), of(constant, 3, rising, true)},
        {"lies outside the levels that were played", of(constant, 3, certainAbove("210", 9), true),
         of(steps, 3)},
        {"over trials, Wilson's", of(fits, 1), of(fits, 3)},
        {"Mean score of each scale in late, n = 3.", of(twice, 3, {}, true), of(methods, 3)},
        {"Mean score of each scale, n = 3.", of(methods, 3), of(grid, 3)},
        {". Lines: 95 % intervals (t) of the table.", of(fits, 3), of(grid, 3)},
        {"Threshold of a staircase: mean of the later half of the reversals that a trial follows (of 7 the "
         "last 4).",
         of(unknown, 3), of(steps, 3)},
        {"Mean share of each alternative in which, n = 3.", of(twice, 3, {}, true), of(fits, 3)},
        {"without a score of", of(twice, 3, unscored, true), of(twice, 3, {}, true)},
        {"Mean level that was set, n = 3", of(matched, 3, {}, true), of(steps, 3)},
        {". Dashed: level of 200.", of(matched, 3, {}, true), of(twoReferences, 3, {}, true)},
        {"were set to an end of their range", of(matched, 3, set("value", "-12"), true),
         of(matched, 3, {}, true)},
        {"Geometric mean magnitudes, each divided by its participant's geometric mean in the condition, and "
         "mean "
         "power law, n = 3. Both axes are logarithmic.",
         of(numbers, 3), of(steps, 3)},
        {"not analysed: participant P2, condition PHONE, session main, stimulus wood: column stimulus",
         of(numbers, 3, firstOfP2("stimulus", "wood")), of(numbers, 3)},
        {"not analysed: participant P2, condition a, session early, stimulus ",
         of(twice, 3, firstOfP2("rough", "120"), true), of(twice, 3, {}, true)},
        {"1 magnitude of 0, which has no logarithm, left out: of P2 in ",
         of(numbers, 3, firstOfP2("value", "0")), of(numbers, 3)},
        {"Information transfer of all trials together, not corrected, n = 3. Dotted: log2 of the number of "
         "stimuli.",
         of(grid, 3), of(numbers, 3)},
        {"Mean percent correct, n = 3.", of(grid, 3), of(numbers, 3)},
        {"Information transfer of all trials together, not corrected, 1 step of tolerance", of(grid, 3),
         of(names, 3)},
        {"Mean percent correct, 1 step of tolerance", of(grid, 3), of(names, 3)},
        {"Mean percent correct by place", of(grid, 3), of(names, 3)},
        {"Share of each response, of the trials of a stimulus, n = 3.", of(names, 3), of(grid, 3)},
        {"stimuli are lacking of P2, left out of means of participants", of(grid, 3, onePoint), of(grid, 3)},
        {"stimuli are lacking of P1, P2", of(grid, 2, twoPoints), of(grid, 3)},
        {"stimuli have unequal numbers of answers", of(timed, 3, {}, true), of(grid, 3)},
        {"trials per cell, fewer than 5: IT is not corrected", of(names, 3), of(numbers, 3)},
        {"All responses, by colour and shape of the target, and one standard deviation of each target's "
         "normal "
         "distribution, n = 3.",
         of(field, 3), of(grid, 3)},
        {"Mean perceived column and row by the intended one, n = 3.", of(field, 3), of(grid, 3)},
        {"Likeliest target of each place. Numbers: row,column at the mean of its responses.", of(field, 3),
         of(grid, 3)},
        {"Percent counts: share of the field of which each target is the likeliest. Framed: below 1.42 %.",
         of(field, 3), of(grid, 3)},
        {"Percent counts of the merged grid of the table, columns x rows.", of(field, 3), of(grid, 3)},
        {"Share of answers \u201ccorrect\u201d by stimulus.", of(constant, 3, {}, true), of(steps, 3)},
        {"Not run: `Rscript analysis.R` (Debian: r-base-core).", of(grid, 3), of(grid, 1)},
        {"is no built-in one (--protocol)", of(grid, 3), of(steps, 3)},
        {"<h3>Calls of the stimuli", of(grid, 3), of(grid, 3, set("render", ""))},
        {"a staircase has fewer than two reversals</td><td>threshold", of(steps, 3, set("level_db", "0")),
         of(steps, 3)},
        {"16 trials without a response left out", of(grid, 3, set("response", "", "P2")), of(grid, 3)},
        {" of 8 reversals</td>", of(cut, 3, {}, true), of(interleaved, 3, {}, true)},
        {"not finished</td><td>threshold", of(interleaved, 3, stopsEarly, true),
         of(interleaved, 3, {}, true)},
        {"lacks trials 2, 7 to 8</td><td>tests that need what is lacking", of(grid, 3, holes, true),
         of(grid, 3)},
        {"lacks trials 5 to 6</td>", of(interleaved, 3, lacks, true), of(interleaved, 3, {}, true)},
        {"<h2>Trials", of(grid, 2, set("phase", "training")), of(grid, 3)},
        {"<h2>Magnitudes", of(numbers, 3), of(steps, 3)},
        {"<h2>Thresholds", of(steps, 3), of(numbers, 3)},
        {"<h2>Answers in words", of(told, 2), of(grid, 3)},
        {"ran out of time</td><td>these trials", of(timed, 3, {}, true), of(grid, 3)},
    };
}

/// Sentences that other tests have with their counter-examples, and words of the rows and of the protocol.
const char* const toldElsewhere[] = {"without a file of times",
                                     "report: physvib",
                                     "trials: physvib",
                                     "protocol: ",
                                     "seed of all orders: ",
                                     "left out: a step ",
                                     "left out: the share ",
                                     "left out: the f",
                                     "Dashed: level of ",
                                     " of # rows: ",
                                     "Mean score of each scale in ",
                                     "Mean share of each alternative"};

bool isKnown(const std::string& said, const std::vector<Sentence>& all, const std::set<std::string>& plan) {
    const std::string sentence = replaced(said, "n = # to #", "n = #");
    if (sentence == "none") return true;
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
    std::set<std::string> words{withoutNumbers(protocolText(protocol)), withoutNumbers(fullScales(protocol))};
    for (const auto& one : protocol.conditions) words.insert(withoutNumbers(conditionText(one)));
    for (const auto& one : protocol.sessions) words.insert(withoutNumbers(sessionText(one)));
    return words;
}

TEST(ReportSentences, APlanStandsBesideWhatWasDone) {
    const std::string plan = "# physvib 1 plan=study hash=7 participants=4\n- test: a\n- test by group: b\n";
    const auto facts = readPlan(plan, "plan").value;
    EXPECT_EQ(facts.tests, std::vector<std::string>{"a"});
    EXPECT_EQ(facts.groupTests, std::vector<std::string>{"b"});
    EXPECT_TRUE(facts.isListed);
    auto trials = readReportTrials({{"P1.csv", fileOf(points(), 1, {})}}, {}, {}).value;
    trials.facts.plan = plan;
    const std::string page = studyReport(trials).files.at("index.html");
    EXPECT_TRUE(hasAll(
        page, {"<td>hash of the protocol</td><td class=\"number\">7</td><td>" + trials.commonValue("hash"),
               std::string{"<td>participants</td><td class=\"number\">4</td><td class=\"number\">1</td>"},
               std::string{"<td>a</td><td>yes</td><td>no</td>"}}))
        << page.substr(page.find("Planned and done"));
}

TEST(ReportSentences, BarsOfPointsBeginAtTheFirst) {
    const auto ticks = [](const Protocol& protocol) {
        const std::string page = pageOf(of(protocol, 8, {}, true));
        const auto at = page.find("<title>Mean score of each scale");
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
    EXPECT_TRUE(has(pageOf(of(steps, 3, early)), ">70</text>"));
    EXPECT_FALSE(has(pageOf(of(steps, 3)), ">70</text>"));
}

TEST(ReportSentences, WhoDidNotFinishOneOfTwoSessionsHasNoThresholdInThatOne) {
    for (const char* method : {"level-steps", "level-quest"}) {
        Protocol twice = findProtocol(method).value;
        twice.name = "twice", twice.sessions.push_back(twice.sessions.back());
        twice.sessions.back().name = "once/more";
        for (const std::string cut : {"", "main", "once/more"}) {
            Files files;
            for (int number : {1, 2})
                files.emplace_back("rows.csv", fileOf(twice, number, [&](Row& row) {
                                       if (number == 2 && row["session"] == cut &&
                                           std::stoi(row["trial"]) > 25)
                                           row["participant"].clear();
                                   }));
            const StudyReport report = studyReport(readReportTrials(files, {}, twice).value);
            const std::string& thresholds = report.files.at("thresholds.csv");
            for (const std::string session : {"main", "once/more"}) {
                EXPECT_TRUE(has(thresholds, ",PHONE in " + session + ",P1,")) << thresholds;
                EXPECT_EQ(has(thresholds, ",PHONE in " + session + ",P2,"), session != cut) << thresholds;
            }
        }
    }
}

TEST(ReportSentences, StaircasesThatRanOutOfTimeAreNoChoices) {
    Protocol timed = findProtocol("level-steps").value;
    timed.name = "timed-steps", timed.sessions.back().answerSeconds = 60.0; // ample
    const std::string page = pageOf(of(
        timed, 2,
        [](Row& row) {
            if (row["correct"] == "0") row["ran_out"] = "1", row["correct"].clear();
        },
        true));
    EXPECT_TRUE(has(page, "ran out of time</td><td>these trials"));
    EXPECT_TRUE(has(page, "not finished</td><td>threshold")) << "no wrong answer, no reversal";
    EXPECT_TRUE(hasNone(page, {"<h2>Choices", "expected trials of this kind"}));
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
        EXPECT_TRUE(has(pageAndItsSentences(isTrue), words));
        EXPECT_FALSE(has(pageAndItsSentences(isNot), words)) << "untrue";
    }
    for (const std::string& sentence : unknown) ADD_FAILURE() << "without a counter-example: " << sentence;
}

} // namespace physvib::report_sentences_test
