// SPDX-License-Identifier: MIT
// Combines trial files into one table and checks their first lines.
#include "Lab/Report/ReportTrials.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/LeftRows.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/SharedParticipants.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <filesystem>
#include <iterator>

namespace physvib {
namespace {

bool saysSimulated(const TrialFile& file) {
    const auto holds = [](const std::string& text) {
        return text.find(trialColumns::simulated) != std::string::npos;
    };
    if (const auto observer = file.head.find("observer");
        observer != file.head.end() && holds(observer->second))
        return true;
    const auto column = file.table.column(trialColumns::observer);
    return column &&
           std::ranges::any_of(file.table.rows, [&](const CsvRow& row) { return holds(row.cells[*column]); });
}

std::string valueOf(const TrialFile& file, const std::string& key) {
    const auto found = file.head.find(key);
    return found == file.head.end() ? std::string{} : found->second;
}

/// Columns without those that only newer files have.
std::vector<std::string> asked(const CsvTable& table) {
    std::vector<std::string> columns = table.columns;
    std::erase_if(columns, [](const std::string& column) {
        return trialColumns::isMeasured(column) || trialColumns::isReceipt(column);
    });
    return columns;
}

/// All rows with the union of all columns; missing cells are empty.
CsvTable joined(const std::vector<TrialFile>& files) {
    CsvTable all{"the trials", {}, asked(files.front().table), {}};
    for (const TrialFile& file : files)
        for (const std::string& column : file.table.columns)
            if (!all.column(column)) all.columns.push_back(column);
    for (const TrialFile& file : files)
        for (const CsvRow& row : file.table.rows) {
            CsvRow& own = all.rows.emplace_back(CsvRow{row.line, {}});
            for (const std::string& column : all.columns) {
                const auto at = file.table.column(column);
                own.cells.push_back(at ? row.cells[*at] : std::string{});
            }
        }
    return all;
}

void findProtocolOf(ReportTrials& trials, const std::optional<Protocol>& given) {
    const std::string name = trials.common("protocol"), hash = trials.common("hash");
    const auto fits = [&](const Protocol& protocol) {
        return protocol.name == name && protocolHash(protocol) == hash;
    };
    if (given) {
        if (fits(*given))
            trials.protocol = given;
        else
            trials.protocolNote = "the protocol that was given is not the one of these trials (name and hash "
                                  "of their first lines)";
        return;
    }
    const auto& known = knownProtocols();
    if (const auto found = std::ranges::find_if(known, fits); found != known.end())
        trials.protocol = *found;
    else if (name.empty())
        trials.protocolNote = "the tables name no protocol";
    else
        trials.protocolNote = "protocol " + printable(name) + " (hash " + printable(hash) +
                              ") is no built-in one: give it by --protocol, and its own words stand here";
}

/// True if all rows record their apparatus and none had noise.
bool wasWithoutNoise(const CsvTable& all) {
    const Cells cell{all};
    return !all.rows.empty() && std::ranges::all_of(all.rows, [&](const CsvRow& row) {
        return !cell(row, trialColumns::version).empty() &&
               cell(row, trialColumns::noiseDb) == trialColumns::noNoise;
    });
}

/// Returns an error for the first call that would write a file, since the page shows the calls to be
/// repeated; else an empty string.
std::string callsFault(const CsvTable& table, const CallCheck& callFault) {
    const auto column = table.column("render");
    for (const CsvRow& row : table.rows)
        if (column && callFault && !callFault(row.cells[*column]).empty())
            return table.fault(row, *column, "calls that write no file");
    return {};
}

} // namespace

bool ReportTrials::knowTasks() const { return all.column(trialColumns::task).has_value(); }

std::string ReportTrials::common(const std::string& key) const {
    const std::string value = valueOf(files.front(), key);
    return std::ranges::all_of(files, [&](const TrialFile& file) { return valueOf(file, key) == value; })
               ? value
               : std::string{};
}

Result<ReportTrials> readReportTrials(const std::vector<std::pair<std::string, std::string>>& texts,
                                      const std::vector<ColumnName>& columns,
                                      const std::optional<Protocol>& protocol, const CallCheck& callFault) {
    ReportTrials trials;
    SharedParticipants shared;
    for (const auto& [path, text] : texts) {
        auto table = readCsvTable(text, path, columns.empty() ? CsvHeader::named : CsvHeader::loose);
        if (!table) return Failure{table.error};
        if (std::string fault = takeColumns(table.value, columns, trials.rowsLeftOut); !fault.empty())
            return Failure{std::move(fault)};
        if (std::string fault = callsFault(table.value, callFault); !fault.empty())
            return Failure{std::move(fault)};
        if (std::string fault = shared.add(table.value); !fault.empty()) return Failure{std::move(fault)};
        TrialFile file{std::filesystem::path{path}.filename().string(),
                       trialHeadOf(table.value.comments),
                       std::move(table.value),
                       {}};
        if (!trials.files.empty()) {
            const TrialFile& first = trials.files.front();
            if (valueOf(first, "protocol") != valueOf(file, "protocol"))
                return Failure{path + ":1: expected trials of the protocol " +
                               inQuotes(valueOf(first, "protocol")) + ", as in " + first.name + ", found " +
                               inQuotes(valueOf(file, "protocol"))};
            if (asked(first.table) != asked(file.table))
                return Failure{path + ": expected the columns of " + first.name + ", found others"};
        }
        trials.isSimulated |= saysSimulated(file);
        trials.files.push_back(std::move(file));
    }
    trials.all = joined(trials.files);
    const LeftRows left{trials.all};
    const auto notLeft = std::stable_partition(trials.all.rows.begin(), trials.all.rows.end(),
                                               [&](const CsvRow& row) { return !left.didNotLeave(row); });
    trials.notLeft.assign(std::make_move_iterator(notLeft), std::make_move_iterator(trials.all.rows.end()));
    trials.all.rows.erase(notLeft, trials.all.rows.end());
    if (trials.all.rows.empty())
        return Failure{texts.front().first + ": expected a trial that left as planned, found none: " +
                       notLeftWords(trials.notLeft.size())};
    trials.sharedNote = shared.note();
    findProtocolOf(trials, protocol);
    return trials;
}

std::string takeFacts(ReportTrials& trials, StudyFacts facts) {
    trials.facts = std::move(facts);
    const auto participant = trials.all.column("participant");
    if (!trials.facts.noise.empty() && wasWithoutNoise(trials.all))
        return trials.files.front().name + ": --noise: expected trials with pink noise, found none";
    if (trials.facts.people.empty()) return {};
    if (!participant)
        return trials.files.front().name + ": --people: expected a column participant, found none";
    for (auto* const rows : {&trials.all.rows, &trials.notLeft})
        std::erase_if(*rows,
                      [&](const CsvRow& row) { return trials.facts.isExcluded(row.cells[*participant]); });
    return trials.all.rows.empty() ? trials.files.front().name +
                                         ": --people: expected a participant who is not excluded, found none"
                                   : std::string{};
}

std::string trialsCsv(const ReportTrials& trials, const std::string& firstLine) {
    std::string text = firstLine;
    const auto addRow = [&](const std::vector<std::string>& cells) {
        for (std::size_t c = 0; c < cells.size(); ++c) {
            if (c > 0) text += ',';
            appendCell(text, cells[c]);
        }
        text += '\n';
    };
    addRow(trials.all.columns);
    const auto task = trials.all.column(trialColumns::task);
    for (const CsvRow& row : trials.all.rows)
        if (!task || answerOf(row.cells[*task]) != AnswerKind::wish) addRow(row.cells);
    return text;
}

} // namespace physvib
