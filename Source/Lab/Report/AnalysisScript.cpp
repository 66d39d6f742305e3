// SPDX-License-Identifier: MIT
// Writes analysis.R (a line of its origin with a hash, the functions, one call), the notebook, BIDS tables.
#include "Lab/Report/AnalysisScript.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <set>
#include <sstream>

namespace physvib {

const std::vector<EmbeddedFile>& embeddedScript(); // Source/Lab/Script

namespace {

constexpr std::string_view originPrefix = "# Written by physvib, hash ", notebookHead = "---\n";

std::string embeddedText(std::string_view name) {
    return std::string{std::ranges::find(embeddedScript(), name, &EmbeddedFile::name)->text};
}

std::string addOrigin(const std::string& study, const std::string& text) {
    return std::string{originPrefix} + contentHash(text) + ": " + cleanLine(study) + "\n" + text;
}

/// A quoted R string, in ASCII: other characters are read as their bytes where the locale is C.
std::string rString(const std::string& words) {
    std::ostringstream out;
    out << '"' << std::hex;
    const std::string line = cleanLine(words);
    for (std::string_view rest = line; !rest.empty();) {
        const auto [code, bytes] = firstCharacter(rest);
        if (code >= 0x80)
            out << "\\U{" << code << '}';
        else
            out << (code == '"' || code == '\\' ? "\\" : "") << rest.front();
        rest.remove_prefix(bytes);
    }
    return out.str() + '"';
}

std::string rVector(const std::vector<std::string>& words) {
    std::string out = "c(";
    for (const std::string& word : words) out.append(out.size() > 2 ? ", " : "").append(rString(word));
    return out + ")";
}

} // namespace

std::string analysisScript(const std::string& study, const std::vector<std::string>& scales,
                           const std::vector<std::string>& ordinalScales, const std::string& midpointName,
                           bool isWithinSubjects) {
    std::string text = embeddedText(analysisScriptName);
    text += "study(" + rString(study) + ", " + rVector(scales) +
            (ordinalScales.empty() ? "" : ", " + rVector(ordinalScales)) +
            (midpointName.empty() ? "" : ", half = " + rString(midpointName)) +
            (isWithinSubjects ? ", within = TRUE)\n" : ")\n");
    return addOrigin(study, text);
}

std::string analysisNotebook(const std::string& study) {
    return std::string{notebookHead} + addOrigin(study, embeddedText(notebookName));
}

std::vector<std::string> testNames(const std::string& table) {
    std::vector<std::string> tests;
    const auto read = readCsvTable(table, testsTable);
    const auto test = read.value.column("test"), kind = read.value.column("kind");
    for (const CsvRow& row : read.value.rows)
        if (test && kind && row.cells[*kind] == "test" &&
            std::ranges::find(tests, row.cells[*test]) == tests.end())
            tests.push_back(row.cells[*test]);
    return tests;
}

std::string scriptOverwriteError(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    if (const auto text = readFile(path.string(), limits::maxTableBytes)) {
        std::string_view all = text.value;
        if (all.starts_with(notebookHead)) all.remove_prefix(notebookHead.size());
        const std::string_view first = takeUntil('\n', all);
        if (first.starts_with(originPrefix) &&
            first.substr(originPrefix.size()).starts_with(contentHash(std::string{all})))
            return {};
    }
    return path.string() +
           ": expected no file, or the script as physvib wrote it; this one is somebody's work: rename it";
}

// Converts trial files to BIDS tables: one row per trial, with times under the column names of BIDS.

namespace {

/// Letters and digits only, as BIDS requires for labels.
std::string toLabel(const std::string& code) {
    std::string label;
    for (const char c : code)
        if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z')) label += c;
    return label.empty() ? "X" : label;
}

/// A TSV cell: without tabs and line ends; n/a if empty.
std::string toCell(const std::string& words) {
    std::string cell = cleanLine(words);
    std::ranges::replace(cell, '\t', ' ');
    return cell.empty() ? "n/a" : cell;
}

/// What the columns of trial files mean, as BIDS has it.
const OrderedJson& meanings() {
    static const OrderedJson all = OrderedJson::parse(embeddedText("columns.json"));
    return all;
}

std::string bidsName(const std::string& column) {
    return column == "response_s" ? "response_time" : toCell(column);
}

std::string sidecar(const CsvTable& trials, std::size_t participant, const BidsDescription& dataset) {
    OrderedJson json = {{"TaskName", dataset.task}, {"TaskDescription", dataset.name}};
    for (std::size_t c = 0; c < trials.columns.size(); ++c) {
        if (c == participant) continue;
        const std::string& column = trials.columns[c];
        OrderedJson& entry = json[bidsName(column)];
        if (const auto scale = dataset.columns.find(column); scale != dataset.columns.end())
            entry["Description"] = toCell(scale->second);
        else
            entry = meanings().value(
                column,
                OrderedJson{{"Description", "Column " + toCell(column) + " of the tables that were read"}});
        if (column == trialColumns::task)
            entry["Description"] = entry["Description"].get<std::string>() + nameList(studyTaskNames, " or ");
    }
    return prettyJson(json);
}

std::string description(const BidsDescription& dataset) {
    OrderedJson json = {
        {"Name", dataset.name + (dataset.isSimulated ? " (SIMULATED: no person answered)" : "")},
        {"BIDSVersion", "1.8.0"},
        {"DatasetType", "raw"}};
    json["GeneratedBy"] =
        OrderedJson::array({OrderedJson{{"Name", "physvib"}, {"Version", dataset.version}}});
    for (const auto& [key, value] : dataset.source) json["PhysVib"][key] = value;
    return prettyJson(json);
}

} // namespace

std::string columnMeaning(std::string_view column) {
    return meanings().at(std::string{column}).at("Description").get<std::string>();
}

std::map<std::string, std::string> bidsDataset(const CsvTable& trials, const BidsDescription& dataset) {
    std::map<std::string, std::string> files;
    const std::size_t participant = *trials.column("participant");
    const auto makeLine = [&](auto cellAt) { // of the other columns
        std::vector<std::string> cells;
        for (std::size_t c = 0; c < trials.columns.size(); ++c)
            if (c != participant) cells.push_back(cellAt(c));
        return joinNames(cells, "\t") + "\n";
    };
    const std::string task = toLabel(dataset.task);
    std::map<std::string, std::string> labels; // by code
    std::set<std::string> usedLabels;
    std::string people = "participant_id\tcode\tobserver\n";
    for (const CsvRow& row : trials.rows) {
        const std::string& code = row.cells[participant];
        const auto [found, isNew] = labels.try_emplace(code, toLabel(code));
        std::string& label = found->second;
        if (isNew) {
            for (int number = 2; !usedLabels.insert(label).second; ++number)
                label = toLabel(code) + "x" + std::to_string(number);
            people += "sub-" + label + "\t" + toCell(code) + "\t" +
                      toCell(trials.cell(row, trialColumns::observer)) + "\n";
        }
        std::string& table = files["sub-" + label + "/beh/sub-" + label + "_task-" + task + "_beh.tsv"];
        if (table.empty()) table = makeLine([&](std::size_t c) { return bidsName(trials.columns[c]); });
        table += makeLine([&](std::size_t c) { return toCell(row.cells[c]); });
    }
    files["participants.tsv"] = people;
    files["participants.json"] = prettyJson(OrderedJson{
        {"code",
         {{"Description", "Code of the participant in the trial files; no other personal datum is kept"}}},
        {"observer", meanings()["observer"]}});
    files["dataset_description.json"] = description(dataset);
    files["task-" + task + "_beh.json"] = sidecar(trials, participant, dataset);
    files["README"] =
        dataset.name +
        "\n\nBehaviour of a study with physvib: a row per trial, in the order in which it was "
        "done. Column meanings: task-" +
        task + "_beh.json.\n" +
        (dataset.isSimulated ? "SIMULATED: a simulated observer answered, not a person.\n" : "");
    return files;
}

} // namespace physvib
