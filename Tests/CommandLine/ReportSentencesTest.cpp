// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences of reports that depend on rows: each with rows of which it is true, and rows of which it must not
// be said. Those of the methods' fields are in ReportFieldsTest and ProtocolWordsTest, of times in
// ProtocolExamplesTest, of plans and unfinished participants in ReportCommandTest.
#include "Io/Text/CsvTable.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ReportTrials.h"
#include "Lab/Report/StudyReport.h"
#include "Lab/Study/SimulatedObserver.h"
#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace physvib {
namespace {

using Row = std::map<std::string, std::string>;
using Edit = std::function<void(Row&)>; ///< a row without a participant is left out

/// A simulated participant's trial file as if of a person, edited.
std::string fileOf(const Protocol& protocol, int number, const Edit& edit) {
    const Participant participant{std::string("P").append(std::to_string(number)), number, "person"};
    Experiment experiment{protocol, participant};
    const SimulatedObserver observer{ObserverSettings{}, protocol, participant};
    std::string text = trialHeader(protocol, participant, "0.2.0");
    const std::string head = text.substr(0, text.find('\n') + 1);
    while (!experiment.isDone())
        text += trialRow(protocol, participant, experiment.take(observer.answer(experiment)));
    const CsvTable table = readCsvTable(text, "rows").value;
    std::string edited = head;
    const auto add = [&](auto cellOf) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (c > 0) edited += ',';
            appendCell(edited, cellOf(c));
        }
        edited += '\n';
    };
    add([&](std::size_t c) { return table.columns[c]; });
    for (const CsvRow& row : table.rows) {
        Row cells;
        for (std::size_t c = 0; c < table.columns.size(); ++c) cells[table.columns[c]] = row.cells[c];
        if (edit) edit(cells);
        if (!cells["participant"].empty()) add([&](std::size_t c) { return cells[table.columns[c]]; });
    }
    return edited;
}

std::string pageOf(const Protocol& protocol, int people, const Edit& edit) {
    std::vector<std::pair<std::string, std::string>> files;
    for (int number = 1; number <= people; ++number)
        files.emplace_back(std::string("P").append(std::to_string(number)) + ".csv",
                           fileOf(protocol, number, edit));
    const auto trials = readReportTrials(files, {}, std::nullopt);
    EXPECT_TRUE(trials) << trials.error;
    return trials ? studyReport(trials.value).files.at("index.html") : std::string{};
}

Edit set(const std::string& column, const std::string& value, const std::string& ofPerson = {}) {
    return [=](Row& row) {
        if (ofPerson.empty() || row["participant"] == ofPerson) row[column] = value;
    };
}

Edit both(const Edit& a, const Edit& b) {
    return [=](Row& row) { a(row), b(row); };
}

/// Two conditions of two points each, after a training.
Protocol points() {
    return readProtocol(
               R"({"physvib_protocol": 1, "name": "points", "condition_order": "latin-square",
    "conditions": [{"name": "a", "stimuli": "grid", "columns": 2, "rows": 1}, {"name": "b", "stimuli": "grid", "columns": 2, "rows": 1}],
    "sessions": [{"name": "practice", "training": true, "task": "identify"}, {"name": "main", "task": "identify", "repetitions": 4}]})",
               "points")
        .value;
}

struct Sentence {
    const char* words;
    Protocol protocol;
    int people = 3;
    Edit isTrue{};
    int otherPeople = 3;
    Edit isNot{};
    Protocol other{}; ///< of the rows of which it is not true, if another
};

std::vector<Sentence> sentences() {
    const auto builtIn = [](const char* name) { return findProtocol(name).value; };
    const Protocol grid = points(), steps = builtIn("level-steps"), numbers = builtIn("magnitudes");
    Protocol unknown = steps;
    unknown.seed = 77; // no built-in one has its hash
    const Edit device =
        both(both(set("device", "JACK:x"), set("version", "0.2.0")),
             both(both(set("master_db", "0"), set("noise_db", "off")), set("limiter_db", "0")));
    const Edit noTraining = [](Row& row) {
        if (row["phase"] == "training") row["participant"].clear();
    };
    return {
        {"3 participants in 3 files.", grid, 3, {}, 2, {}},
        {"one participant: intervals and tests over participants are not possible", grid, 1, {}, 2, {}},
        {"Nobody and no main trial is left out.", grid, 3, {}, 3, set("response", "", "P2")},
        {"participant P2: 20 trials without an answer left out", grid, 3, set("response", "", "P2"), 3, {}},
        {"participant P2 has 8 trials, others have up to 16",
         grid,
         3,
         [](Row& row) {
             if (row["participant"] == "P2" && row["condition"] == "b") row["participant"].clear();
         },
         3,
         {}},
        {"whether everyone finished is not known: levels followed the answers", unknown, 3, {}, 3, {}, grid},
        {"Trainings are left out of all analyses.", grid, 3, {}, 3, noTraining},
        {"trials do not say on which device", grid, 3, {}, 3, device},
        {"trials were felt through the device JACK:x at a master level of 0 dB, without pink noise; the "
         "limiter lowered "
         "none of them.",
         grid, 3, device, 3, both(device, set("noise_db", "-30"))},
        {"the limiter lowered none of them.", grid, 3, device, 3, both(device, set("limiter_db", "0.4"))},
        {"different settings of the apparatus", grid, 3, both(device, set("device", "ALSA:y", "P2")), 3,
         device},
        {"A condition was at one place of the order", grid, 3, {}, 3, {}, numbers},
        {"Every trial had the level of its call; nobody measured what was felt.",
         grid,
         3,
         {},
         3,
         set("level_db", "3")},
        {"Every trial had the level of its call; nobody measured what was felt.",
         grid,
         3,
         {},
         3,
         set("peak_g", "0.4")},
        {"Levels in g are samples as they left (measured)", grid, 3, set("peak_g", "0.4"), 3,
         set("level_db", "3")},
        {"exposure was not measured in these trials", grid, 3, set("peak_g", "0.4"), 3,
         set("a8_m_per_s2", "0.1")},
        {"level_db: in dB of the condition", steps, 3, {}, 3, set("level_db", "0")},
        {"a paired t test at p &lt; 0.05 finds a mean difference", grid, 3, {}, 2, {}},
        {"Of forced choices between two", steps, 3, set("correct", ""), 3, {}},
        {"no functions are drawn, as answers chose the levels", steps, 3, {}, 3, {}, numbers},
        {"no JND (answers chose the levels", steps, 3, {}, 3, {}, numbers},
        {"Dotted: mean threshold, shaded its 95 % interval over participants.", steps, 3, {}, 1, {}},
        {"of one participant without intervals", grid, 1, {}, 3, {}},
        {", 95 % intervals over participants", grid, 3, {}, 1, {}},
        {"intervals over participants: Student", grid, 3, {}, 1, {}},
        {"95 % interval over trials", grid, 1, {}, 3, {}},
        {"intervals of thresholds and exponents over 6 participants or more", steps, 3, {}, 3, {}, grid},
        {"Magnitude estimations: geometric means", numbers, 3, {}, 3, {}, steps},
        {"condition.1 and condition.2 are the parts of the conditions",
         builtIn("phantom-grids"),
         2,
         {},
         2,
         {},
         grid},
        {"one estimate per condition, so it has no interval", grid, 3, {}, 3, {}, numbers},
    };
}

TEST(ReportSentences, EachIsThereOnlyWhereRowsMakeItTrue) {
    for (const Sentence& one : sentences()) {
        EXPECT_NE(pageOf(one.protocol, one.people, one.isTrue).find(one.words), std::string::npos)
            << one.words;
        const Protocol& other = one.other.name.empty() ? one.protocol : one.other;
        EXPECT_EQ(pageOf(other, one.otherPeople, one.isNot).find(one.words), std::string::npos)
            << "untrue: " << one.words;
    }
}

} // namespace
} // namespace physvib
