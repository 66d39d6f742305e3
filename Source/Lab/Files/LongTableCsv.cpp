// SPDX-License-Identifier: MIT
// Reads long tables row by row. To keep memory small for a million rows, only numbers and indices of names
// are stored.
#include "Lab/Files/LongTableCsv.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/FactorSource.h"
#include "Lab/Files/LeftRows.h"
#include "Lab/Files/SharedParticipants.h"
#include "Lab/Files/TrialColumns.h"
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace physvib {
namespace {

using detail::FactorSource;

constexpr double largestMeasure = 1e100; // keeps squares and their sums finite

/// Reads the rows of one file into the table.
class LongTableReader {
public:
    LongTableReader(LongTableData& data, const LongTableColumns& wanted)
        : data_{data}
        , wanted_{wanted} {}

    std::string read(const NamedText& file) {
        taken_ = notLeft_ = 0;
        people_.clear();
        std::string fault = eachCsvRow(
            file.text, file.name, [this](const CsvTable& head) { return begin(head); },
            [this](const CsvRow& row) { return take(row); });
        if (notLeft_ > 0) data_.warnings.push_back(std::string(file.name) + ": " + notLeftWords(notLeft_));
        if (fault.empty() && taken_ == 0)
            fault = std::string(file.name) + ": column " + printable(wanted_.measure) +
                    ": expected numbers, found none";
        return fault.empty() ? shared_.add(known_, people_) : fault;
    }
    std::string sharedNote() const { return shared_.note(); }

private:
    std::string begin(const CsvTable& head) {
        head_ = &head;
        left_.emplace(head);
        known_ = {head.name, head.comments, {}, {}};
        for (const std::string& line : head.comments)
            data_.isSimulated |= line.find(" observer=simulated") != std::string::npos;
        observer_ = head.column(trialColumns::observer);
        phase_ = head.column(trialColumns::phase);
        participant_ = head.column(wanted_.participant.empty() ? trialColumns::names.front()
                                                               : std::string_view{wanted_.participant});
        if (!participant_ && (!wanted_.participant.empty() || !wanted_.within.empty()))
            return missing(wanted_.participant.empty() ? std::string(trialColumns::names.front())
                                                       : wanted_.participant);
        if (!participant_)
            data_.warnings.push_back(printable(head.name) +
                                     ": no column participant: every row counts as a participant");
        if (!findMeasure()) return missing(wanted_.measure);
        within_.clear();
        for (const std::string& factor : wanted_.within) {
            const auto source = FactorSource::of(*head_, factor);
            if (!source) return missing(factor);
            within_.push_back(*source);
        }
        if (std::string fault = findWhere(); !fault.empty()) return fault;
        between_ = wanted_.between.empty() ? std::nullopt : FactorSource::of(*head_, wanted_.between);
        return between_ || wanted_.between.empty() ? "" : missing(wanted_.between);
    }

    std::string take(const CsvRow& row) {
        const std::string& cell = row.cells[measure_];
        for (const auto& [source, word] : where_)
            if (source.level(row) != word) return {};
        if (cell.empty() || cell == "NA" || (phase_ && row.cells[*phase_] == trialColumns::training))
            return {};
        if (left_->didNotLeave(row)) return ++notLeft_, std::string{};
        const auto value =
            chosen_.empty() ? parseNumber<double>(cell) : std::optional<double>{cell == chosen_ ? 1.0 : 0.0};
        if (!value || std::abs(*value) > largestMeasure)
            return head_->fault(row, measure_, "a number from -1e100 to 1e100");
        levels_.clear();
        for (const FactorSource& source : within_) {
            levels_.push_back(source.level(row));
            if (levels_.back().empty()) return head_->fault(row, source.column, source.expected());
        }
        const std::string_view group = between_ ? between_->level(row) : std::string_view{};
        if (between_ && group.empty()) return head_->fault(row, between_->column, between_->expected());
        if (participant_ && row.cells[*participant_].empty())
            return head_->fault(row, *participant_, "a participant");
        if (observer_)
            data_.isSimulated |= row.cells[*observer_].find(trialColumns::simulated) != std::string::npos;
        ++taken_;
        if (participant_) people_.insert(row.cells[*participant_]);
        if (participant_)
            data_.table.add(row.cells[*participant_], levels_, group, *value);
        else
            data_.table.add("row " + std::to_string(data_.table.rows() + 1), levels_, group, *value);
        return {};
    }

    std::string findWhere() {
        where_.clear();
        for (const std::string& words : wanted_.where) {
            const auto equals = words.find('=');
            const auto source = FactorSource::of(*head_, words.substr(0, equals));
            if (equals == std::string::npos || !source) return missing(words.substr(0, equals));
            where_.emplace_back(*source, words.substr(equals + 1));
        }
        return {};
    }

    bool findMeasure() {
        chosen_.clear();
        auto found = head_->column(wanted_.measure);
        if (const auto equals = wanted_.measure.find('='); !found && equals != std::string::npos) {
            found = head_->column(std::string_view{wanted_.measure}.substr(0, equals));
            chosen_ = wanted_.measure.substr(equals + 1);
        }
        measure_ = found.value_or(0);
        return found.has_value();
    }

    std::string missing(const std::string& column) const {
        return head_->name + ": expected a column " + printable(column) + ", found none";
    }

    LongTableData& data_;
    const LongTableColumns& wanted_;
    const CsvTable* head_ = nullptr;
    CsvTable known_; // the head, kept after reading
    std::set<std::string> people_;
    SharedParticipants shared_;
    std::size_t measure_ = 0, taken_ = 0, notLeft_ = 0;
    std::optional<LeftRows> left_;
    std::string chosen_;
    std::optional<std::size_t> observer_, phase_, participant_;
    std::vector<FactorSource> within_;
    std::optional<FactorSource> between_;
    std::vector<std::pair<FactorSource, std::string>> where_;
    std::vector<std::string_view> levels_;
};

} // namespace

Result<LongTableData> readLongTable(std::span<const NamedText> files, const LongTableColumns& columns) {
    LongTableData data{LongTable{columns.measure, columns.within, columns.between}, {}, false};
    LongTableReader reader{data, columns};
    for (const NamedText& file : files)
        if (std::string fault = reader.read(file); !fault.empty()) return Failure{std::move(fault)};
    if (std::string note = reader.sharedNote(); !note.empty()) data.warnings.push_back(std::move(note));
    return data;
}

} // namespace physvib
