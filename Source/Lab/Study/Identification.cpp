// SPDX-License-Identifier: MIT
// Confusion matrices with labels in a fixed order, information transfer from the non-empty cells, and the
// search for the largest grid whose cells all reach the threshold.
#include "Lab/Study/Identification.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Summaries.h"
#include <cstdlib>
#include <numbers>
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
    Labels stimuli, extraResponses;
    for (const auto& trial : trials) stimuli.insert(trial.stimulus);
    for (const auto& trial : trials)
        if (!stimuli.contains(trial.response)) extraResponses.insert(trial.response);
    stimuli_ = stimuli.size();
    labels_.assign(stimuli.begin(), stimuli.end());
    labels_.insert(labels_.end(), extraResponses.begin(), extraResponses.end());
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

std::vector<IdentificationTrial> tolerate(std::vector<IdentificationTrial> trials, int tolerance) {
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

std::size_t nonZeros(const std::vector<std::uint64_t>& counts) {
    return counts.size() - static_cast<std::size_t>(std::ranges::count(counts, 0u));
}

} // namespace

double fanoBits(double stimulusEntropyBits, double shareCorrect, std::size_t alternatives,
                double shareOutside) noexcept {
    const double shareWrong = 1.0 - shareCorrect, count = static_cast<double>(alternatives);
    const double binaryEntropy = -plogp(shareWrong) - plogp(shareCorrect);
    const double amongBits = alternatives > 1 ? (shareWrong - shareOutside) * std::log2(count - 1.0) : 0.0;
    return std::max(0.0, stimulusEntropyBits - binaryEntropy - amongBits - shareOutside * std::log2(count));
}

InformationTransfer informationTransfer(const ConfusionMatrix& matrix) {
    InformationTransfer transfer;
    if (matrix.trials() == 0) return transfer;
    const auto n = static_cast<double>(matrix.trials());
    const auto rows = matrix.stimulusTotals(), columns = matrix.responseTotals();
    std::ptrdiff_t cells = 0;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.responses(); ++j) {
            const double count = matrix.count(i, j);
            if (count == 0.0) continue;
            ++cells;
            transfer.bits +=
                count / n *
                std::log2(count * n / (static_cast<double>(rows[i]) * static_cast<double>(columns[j])));
        }
    transfer.bits = std::max(0.0, transfer.bits); // rounding can give values below zero
    const auto parameters = cells - static_cast<std::ptrdiff_t>(nonZeros(rows) + nonZeros(columns)) + 1;
    transfer.biasBits =
        static_cast<double>(std::max<std::ptrdiff_t>(0, parameters)) / (2.0 * n * std::numbers::ln2);
    const auto outside = std::accumulate(columns.begin() + static_cast<std::ptrdiff_t>(matrix.stimuli()),
                                         columns.end(), std::uint64_t{0});
    transfer.minBits = fanoBits(entropyBits(rows, n), static_cast<double>(matrix.correct()) / n,
                                matrix.stimuli(), static_cast<double>(outside) / n);
    transfer.maxBits = std::log2(static_cast<double>(matrix.stimuli()));
    transfer.trialsPerCell = n / static_cast<double>(matrix.stimuli() * matrix.responses());
    return transfer;
}

std::vector<ParticipantTransfer> transferByParticipant(const std::vector<IdentificationTrial>& trials) {
    std::vector<ParticipantTransfer> transfers;
    for (const auto& [participant, participantTrials] : groupByParticipant(trials)) {
        const ConfusionMatrix matrix{participantTrials};
        transfers.push_back({participant, matrix, informationTransfer(matrix)});
    }
    return transfers;
}

std::vector<ParticipantTransfer> keepComplete(std::vector<ParticipantTransfer> people, std::size_t stimuli) {
    const auto lacks = [=](const ParticipantTransfer& person) { return person.matrix.stimuli() != stimuli; };
    if (std::ssize(people) - std::ranges::count_if(people, lacks) > 1) std::erase_if(people, lacks);
    return people;
}

// Finds the largest merged grid by exhaustive search with pruning.
// Steps: 1. For every division of the rows, add up the columns of each row group (a strip). 2. Compute the
// maximum number of column groups that reach the threshold in every strip. 3. Only if that can equal or
// exceed the best grid, list the column divisions of that size.
// Cost: at most 2^15 divisions of rows times 2^15 of columns.

namespace {

// Tolerance for the rounding error of binary sums of decimal percentages.
constexpr double roundingSlack = 1e-9;

using Sizes = std::vector<std::size_t>;

/// Group sizes for a division of `count` lines; bit i of `ends` is set if a group ends after line i.
Sizes groupsOf(std::size_t count, std::uint32_t ends) {
    Sizes sizes{1};
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (ends >> i & 1u)
            sizes.push_back(1);
        else
            ++sizes.back();
    }
    return sizes;
}

/// The counts with rows merged: one vector of column sums per group of rows.
std::vector<std::vector<double>> mergedRows(const PercentCounts& counts, const Sizes& rowGroups) {
    std::vector<std::vector<double>> strips;
    std::size_t row = 0;
    for (const std::size_t size : rowGroups) {
        auto& strip = strips.emplace_back(counts.columns, 0.0);
        for (std::size_t end = row + size; row < end; ++row)
            for (std::size_t c = 0; c < counts.columns; ++c) strip[c] += counts.at(row, c);
    }
    return strips;
}

/// Enumerates the divisions of the columns into groups that all reach `threshold` in every strip.
class ColumnDivisions {
public:
    ColumnDivisions(const std::vector<std::vector<double>>& strips, double threshold)
        : strips_{strips}
        , threshold_{threshold}
        , columns_{strips.front().size()}
        , maxGroups_(columns_ + 1, 0) {
        for (std::size_t from = columns_; from-- > 0;)
            if (const std::size_t size = minColumnsFrom(from); size > 0)
                maxGroups_[from] =
                    from + size == columns_ ? 1 : std::max<std::size_t>(maxGroups_[from + size] + 1, 1);
    }
    std::size_t maxGroups() const { return maxGroups_[0]; }
    std::vector<Sizes> divide(std::size_t groups) {
        divisions_.clear();
        groups_.clear();
        extend(0, groups);
        return divisions_;
    }

private:
    /// Smallest number of columns from `from` that reach the threshold; 0 if all of them do not.
    std::size_t minColumnsFrom(std::size_t from) const {
        for (std::size_t size = 1; from + size <= columns_; ++size)
            if (reaches(from, size)) return size;
        return 0;
    }
    bool reaches(std::size_t from, std::size_t size) const {
        return std::ranges::all_of(strips_, [=, this](const auto& strip) {
            const auto first = strip.begin() + static_cast<std::ptrdiff_t>(from);
            return std::accumulate(first, first + static_cast<std::ptrdiff_t>(size), 0.0) >= threshold_;
        });
    }
    void extend(std::size_t from, std::size_t remaining) {
        if (from == columns_ && remaining == 0) divisions_.push_back(groups_);
        if (remaining == 0 || maxGroups_[from] < remaining) return;
        for (std::size_t size = 1; from + size <= columns_; ++size) {
            if (!reaches(from, size)) continue;
            groups_.push_back(size);
            extend(from + size, remaining - 1);
            groups_.pop_back();
        }
    }

    const std::vector<std::vector<double>>& strips_;
    double threshold_;
    std::size_t columns_;
    std::vector<std::size_t> maxGroups_; // maximum number of groups from each column on
    Sizes groups_;
    std::vector<Sizes> divisions_;
};

void addMerges(const PercentCounts& counts, const Sizes& rowGroups, double threshold, std::size_t& best,
               std::vector<GridMerge>& ties) {
    const auto strips = mergedRows(counts, rowGroups);
    ColumnDivisions columns{strips, threshold};
    const std::size_t cells = columns.maxGroups() * rowGroups.size();
    if (cells == 0 || cells < best) return;
    if (cells > best) ties.clear();
    best = cells;
    for (Sizes& groups : columns.divide(columns.maxGroups())) ties.push_back({std::move(groups), rowGroups});
}

} // namespace

PerceptualResolution perceptualResolution(const PercentCounts& counts, double thresholdPercent) {
    PerceptualResolution result;
    std::size_t best = 0;
    if (counts.rows == 0 || counts.columns == 0) return result;
    const auto divisions = std::uint32_t{1} << (counts.rows - 1);
    for (std::uint32_t ends = 0; ends < divisions; ++ends)
        addMerges(counts, groupsOf(counts.rows, ends), thresholdPercent - roundingSlack, best, result.ties);
    std::ranges::stable_sort(result.ties, std::ranges::greater{},
                             [](const GridMerge& m) { return m.columnGroups.size(); });
    if (result.ties.empty()) return result;
    result.columns = result.ties.front().columnGroups.size();
    result.rows = result.ties.front().rowGroups.size();
    return result;
}

PercentCounts mergedCounts(const PercentCounts& counts, const GridMerge& merge) {
    PercentCounts result{counts.condition, merge.rowGroups.size(), merge.columnGroups.size(), {}};
    for (const auto& strip : mergedRows(counts, merge.rowGroups)) {
        auto from = strip.begin();
        for (const std::size_t size : merge.columnGroups) {
            result.percent.push_back(std::accumulate(from, from + static_cast<std::ptrdiff_t>(size), 0.0));
            from += static_cast<std::ptrdiff_t>(size);
        }
    }
    return result;
}

} // namespace physvib
