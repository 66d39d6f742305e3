// SPDX-License-Identifier: MIT
// Converts trial files to BIDS tables: one row per trial, with times under the column names of BIDS.
#include "Lab/Files/BidsDataset.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <utility>
#include <vector>

namespace physvib {
namespace {

/// Letters and digits only, as BIDS requires for labels.
std::string labelOf(const std::string& code) {
    std::string label;
    for (const char c : code)
        if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z')) label += c;
    return label.empty() ? "X" : label;
}

/// A TSV cell: without tabs and line ends; n/a if empty.
std::string cellOf(const std::string& words) {
    std::string cell = cleanLine(words);
    std::ranges::replace(cell, '\t', ' ');
    return cell.empty() ? "n/a" : cell;
}

struct ColumnMeaning {
    std::string_view ours, description, units{};
};

constexpr ColumnMeaning meanings[] = {
    {"observer", "Who answered: person, or the name of a simulated observer"},
    {"condition", "Condition of the study"},
    {"session", "Session of the protocol"},
    {"phase", "training (left out of analyses) or main"},
    {"trial", "Number of the trial in its condition and session, from 1"},
    {"task", "What the participant did: "},
    {"stimulus", "Label of what was felt"},
    {"parts", "What was felt one by one, in that order, between vertical bars"},
    {"response", "Label or words that were answered"},
    {"target_column", "Column of the target, from 1 at the left"},
    {"target_row", "Row of the target, from 1 at the top"},
    {"x", "Where the participant pointed, to the right, as a share of the field's width", "1"},
    {"y", "Where the participant pointed, downwards, as a share of the field's height", "1"},
    {"choice", "Alternative that was chosen"},
    {"value", "Level that was set (dB) or number that was given"},
    {"correct", "1 if the answer was right, 0 if not, where there is a right one"},
    {"group", "Group of the participant, who is compared with those of others"},
    {"replays", "How often the stimulus was felt again"},
    {"response_s", "From the first press of play to the answer", "s"},
    {"level_db", "Level of the trial, relative to its condition's", "dB"},
    {"quest", "What QUEST+ thought possible before the session's first trial"},
    {"staircase", "Which of several staircases the trial is of, from 1"},
    {"ran_out", "1: time was over before there was an answer; n/a: there was no limit"},
    {"peak_g", "Peak acceleration that was felt in the trial", "g"},
    {"rms_g", "Root mean square of the acceleration that was felt in the trial", "g"},
    {"a8_m_per_s2", "The participant's exposure up to here, A(8) by ISO 5349-1", "m/s^2"},
    {"limiter_db", "By how much the limiter lowered the trial at most", "dB"},
    {"master_db", "Master level of the mixer", "dB"},
    {"noise_db", "Root mean square of the pink noise over full scale; off: there was none", "dB"},
    {"device", "Audio device"},
    {"version", "Version of physvib"},
    {"left", "1: every part left as planned; n/a: not known. Trials with 0 are left out"},
    {"again", "Plays that did not leave as planned and were felt again"},
    {"render", "Call of physvib that renders the stimulus again"},
};

const ColumnMeaning* meaningOf(const std::string& column) {
    const auto found = std::ranges::find(meanings, column, &ColumnMeaning::ours);
    return found == std::end(meanings) ? nullptr : found;
}

std::string bidsName(const std::string& column) {
    return column == "response_s" ? "response_time" : cellOf(column);
}

std::string sidecar(const CsvTable& trials, std::size_t participant, const BidsWords& words) {
    OrderedJson json = {{"TaskName", words.task}, {"TaskDescription", words.name}};
    for (std::size_t c = 0; c < trials.columns.size(); ++c) {
        if (c == participant) continue;
        const auto* const known = meaningOf(trials.columns[c]);
        OrderedJson& own = json[bidsName(trials.columns[c])];
        const auto scale = words.columns.find(trials.columns[c]);
        own["Description"] =
            scale != words.columns.end() ? cellOf(scale->second)
            : known                      ? std::string{known->description} +
                          (known->ours == trialColumns::task ? listed(studyTaskNames, " or ") : "")
                    : "Column " + cellOf(trials.columns[c]) + " of the tables that were read";
        if (known && !known->units.empty()) own["Units"] = known->units;
    }
    return jsonLines(json);
}

std::string description(const BidsWords& words) {
    OrderedJson json = {{"Name", words.name + (words.isSimulated ? " (SIMULATED: no person answered)" : "")},
                        {"BIDSVersion", "1.8.0"},
                        {"DatasetType", "raw"}};
    json["GeneratedBy"] = OrderedJson::array({OrderedJson{{"Name", "physvib"}, {"Version", words.version}}});
    for (const auto& [key, value] : words.source) json["PhysVib"][key] = value;
    return jsonLines(json);
}

} // namespace

std::map<std::string, std::string> bidsDataset(const CsvTable& trials, const BidsWords& words) {
    std::map<std::string, std::string> files;
    const auto participant = trials.column("participant");
    if (!participant) return files;
    std::string header;
    for (std::size_t c = 0; c < trials.columns.size(); ++c)
        if (c != *participant) header.append(header.empty() ? "" : "\t").append(bidsName(trials.columns[c]));
    const std::string task = labelOf(words.task);
    std::vector<std::pair<std::string, std::string>> labels; // code, label
    const auto observer = trials.column(trialColumns::observer);
    std::string people = "participant_id\tcode\tobserver\n";
    for (const CsvRow& row : trials.rows) {
        const std::string& code = row.cells[*participant];
        auto found = std::ranges::find(labels, code, &std::pair<std::string, std::string>::first);
        if (found == labels.end()) {
            std::string label = labelOf(code);
            for (int number = 2;
                 std::ranges::count(labels, label, &std::pair<std::string, std::string>::second) > 0;
                 ++number)
                label = labelOf(code) + "x" + std::to_string(number);
            found = labels.insert(labels.end(), {code, label});
            people += "sub-" + label + "\t" + cellOf(code) + "\t" +
                      (observer ? cellOf(row.cells[*observer]) : "n/a") + "\n";
        }
        const std::string subject = "sub-" + found->second;
        std::string& own = files[subject + "/beh/" + subject + "_task-" + task + "_beh.tsv"];
        if (own.empty()) own = header + "\n";
        bool isFirst = true;
        for (std::size_t c = 0; c < trials.columns.size(); ++c) {
            if (c == *participant) continue;
            if (!std::exchange(isFirst, false)) own += '\t';
            own += cellOf(row.cells[c]);
        }
        own += '\n';
    }
    files["participants.tsv"] = people;
    files["participants.json"] = jsonLines(OrderedJson{
        {"code",
         {{"Description", "Code of the participant in the trial files; no other personal datum is kept"}}},
        {"observer", {{"Description", "Who answered: person, or the name of a simulated observer"}}}});
    files["dataset_description.json"] = description(words);
    files["task-" + task + "_beh.json"] = sidecar(trials, *participant, words);
    files["README"] = words.name +
                      "\n\nBehaviour of a study with physvib: a row per trial, in the order in which it was "
                      "done. Column meanings: task-" +
                      task + "_beh.json.\n" +
                      (words.isSimulated ? "SIMULATED: a simulated observer answered, not a person.\n" : "");
    return files;
}

} // namespace physvib
