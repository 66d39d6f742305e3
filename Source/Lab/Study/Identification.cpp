// SPDX-License-Identifier: MIT
// Confusion matrices: labels in a fixed order, counts in one array. Information transfer: from the non-empty
// cells, since 0 log 0 is 0.
#include "Lab/Study/Identification.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

namespace physvib {
namespace {

/// Orders grid cells by row and column, before all other labels by their bytes.
struct LabelOrder {
    static auto key(const std::string& label) {
        const auto cell = parseGridCell(label);
        return std::tuple{!cell, cell ? cell->row : 0, cell ? cell->column : 0, std::string_view{label}};
    }
    bool operator()(const std::string& a, const std::string& b) const { return key(a) < key(b); }
};

using Labels = std::set<std::string, LabelOrder>;

} // namespace

std::optional<GridCell> parseGridCell(std::string_view label) noexcept {
    const std::size_t comma = label.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    const auto row = parseNumber<int>(trimmed(label.substr(0, comma))),
               column = parseNumber<int>(trimmed(label.substr(comma + 1)));
    return row > 0 && column > 0 ? std::optional{GridCell{*row, *column}} : std::nullopt;
}

std::string gridLabel(const GridCell& cell) {
    return std::to_string(cell.row) + "," + std::to_string(cell.column);
}

int manhattanDistance(const GridCell& a, const GridCell& b) noexcept {
    return std::abs(a.row - b.row) + std::abs(a.column - b.column);
}

ConfusionMatrix::ConfusionMatrix(const std::vector<IdentificationTrial>& trials)
    : trials_{trials.size()} {
    Labels stimuli, others;
    for (const auto& trial : trials) stimuli.insert(trial.stimulus);
    for (const auto& trial : trials)
        if (!stimuli.contains(trial.response)) others.insert(trial.response);
    stimuli_ = stimuli.size();
    labels_.assign(stimuli.begin(), stimuli.end());
    labels_.insert(labels_.end(), others.begin(), others.end());
    counts_.assign(stimuli_ * labels_.size(), 0);
    for (const auto& trial : trials)
        ++counts_[indexOf(trial.stimulus) * labels_.size() + indexOf(trial.response)];
}

std::size_t ConfusionMatrix::indexOf(const std::string& label) const {
    const auto middle = labels_.begin() + static_cast<std::ptrdiff_t>(stimuli_);
    auto found = std::lower_bound(labels_.begin(), middle, label, LabelOrder{});
    if (found == middle || *found != label)
        found = std::lower_bound(middle, labels_.end(), label, LabelOrder{});
    return static_cast<std::size_t>(found - labels_.begin());
}

std::uint64_t ConfusionMatrix::correct() const noexcept {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < stimuli_; ++i) sum += count(i, i);
    return sum;
}

std::vector<std::uint64_t> ConfusionMatrix::stimulusTotals() const {
    std::vector<std::uint64_t> totals(stimuli_);
    for (std::size_t i = 0; i < stimuli_; ++i)
        for (std::size_t j = 0; j < responses(); ++j) totals[i] += count(i, j);
    return totals;
}

std::vector<std::uint64_t> ConfusionMatrix::responseTotals() const {
    std::vector<std::uint64_t> totals(responses());
    for (std::size_t i = 0; i < stimuli_; ++i)
        for (std::size_t j = 0; j < responses(); ++j) totals[j] += count(i, j);
    return totals;
}

std::vector<IdentificationTrial> withTolerance(std::vector<IdentificationTrial> trials, int tolerance) {
    for (auto& trial : trials) {
        const auto target = parseGridCell(trial.stimulus), answer = parseGridCell(trial.response);
        if (target && answer && manhattanDistance(*target, *answer) <= tolerance)
            trial.response = trial.stimulus;
    }
    return trials;
}

// Information transfer.

namespace {

double plogp(double p) noexcept { return p > 0.0 ? p * std::log2(p) : 0.0; }

double entropyBits(const std::vector<std::uint64_t>& counts, double total) {
    double bits = 0.0;
    for (const auto count : counts) bits -= plogp(static_cast<double>(count) / total);
    return bits;
}

std::size_t occupied(const std::vector<std::uint64_t>& counts) {
    return counts.size() - static_cast<std::size_t>(std::ranges::count(counts, 0u));
}

} // namespace

double fanoBits(double stimulusEntropyBits, double shareCorrect, std::size_t alternatives,
                double shareOutside) noexcept {
    const double wrong = 1.0 - shareCorrect, all = static_cast<double>(alternatives);
    const double binary = -plogp(wrong) - plogp(shareCorrect);
    const double among = alternatives > 1 ? (wrong - shareOutside) * std::log2(all - 1.0) : 0.0;
    return std::max(0.0, stimulusEntropyBits - binary - among - shareOutside * std::log2(all));
}

InformationTransfer informationTransfer(const ConfusionMatrix& matrix) {
    InformationTransfer it;
    if (matrix.trials() == 0) return it;
    const auto n = static_cast<double>(matrix.trials());
    const auto rows = matrix.stimulusTotals(), columns = matrix.responseTotals();
    std::ptrdiff_t cells = 0;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.responses(); ++j) {
            const double count = matrix.count(i, j);
            if (count == 0.0) continue;
            ++cells;
            it.bits +=
                count / n *
                std::log2(count * n / (static_cast<double>(rows[i]) * static_cast<double>(columns[j])));
        }
    it.bits = std::max(0.0, it.bits); // rounding can give values below zero
    const auto parameters = cells - static_cast<std::ptrdiff_t>(occupied(rows) + occupied(columns)) + 1;
    it.biasBits =
        static_cast<double>(std::max<std::ptrdiff_t>(0, parameters)) / (2.0 * n * std::numbers::ln2);
    const auto outside = std::accumulate(columns.begin() + static_cast<std::ptrdiff_t>(matrix.stimuli()),
                                         columns.end(), std::uint64_t{0});
    it.leastBits = fanoBits(entropyBits(rows, n), static_cast<double>(matrix.correct()) / n, matrix.stimuli(),
                            static_cast<double>(outside) / n);
    it.mostBits = std::log2(static_cast<double>(matrix.stimuli()));
    it.trialsPerCell = n / static_cast<double>(matrix.stimuli() * matrix.responses());
    return it;
}

std::vector<ParticipantTransfer> transferByParticipant(const std::vector<IdentificationTrial>& trials) {
    std::vector<ParticipantTransfer> transfers;
    for (const auto& [participant, own] : byParticipant(trials)) {
        const ConfusionMatrix matrix{own};
        transfers.push_back({participant, matrix, informationTransfer(matrix)});
    }
    return transfers;
}

std::vector<ParticipantTransfer> comparable(std::vector<ParticipantTransfer> people, std::size_t stimuli) {
    const auto lacks = [=](const ParticipantTransfer& own) { return own.matrix.stimuli() != stimuli; };
    if (std::ssize(people) - std::ranges::count_if(people, lacks) > 1) std::erase_if(people, lacks);
    return people;
}

} // namespace physvib
