// SPDX-License-Identifier: MIT
// Finds the largest merged grid by exhaustive search with pruning.
// Steps: 1. For every division of the rows, add up the columns of each row group (a strip). 2. Compute the
// maximum number of column groups that reach the threshold in every strip. 3. Only if that can equal or
// exceed the best grid, list the column divisions of that size.
// Cost: at most 2^15 divisions of rows times 2^15 of columns.
#include "Lab/Study/PercentCounts.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
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

/// Enumerates the divisions of the columns into groups that all reach `least` in every strip.
class ColumnDivisions {
public:
    ColumnDivisions(const std::vector<std::vector<double>>& strips, double least)
        : strips_{strips}
        , least_{least}
        , columns_{strips.front().size()}
        , most_(columns_ + 1, 0) {
        for (std::size_t from = columns_; from-- > 0;)
            if (const std::size_t size = fewestFrom(from); size > 0)
                most_[from] = from + size == columns_ ? 1 : std::max<std::size_t>(most_[from + size] + 1, 1);
    }
    std::size_t most() const { return most_[0]; }
    std::vector<Sizes> ofSize(std::size_t groups) {
        found_.clear();
        groups_.clear();
        extend(0, groups);
        return found_;
    }

private:
    /// Smallest number of columns from `from` that reach the threshold; 0 if all of them do not.
    std::size_t fewestFrom(std::size_t from) const {
        for (std::size_t size = 1; from + size <= columns_; ++size)
            if (reaches(from, size)) return size;
        return 0;
    }
    bool reaches(std::size_t from, std::size_t size) const {
        return std::ranges::all_of(strips_, [=, this](const auto& strip) {
            const auto first = strip.begin() + static_cast<std::ptrdiff_t>(from);
            return std::accumulate(first, first + static_cast<std::ptrdiff_t>(size), 0.0) >= least_;
        });
    }
    void extend(std::size_t from, std::size_t left) {
        if (from == columns_ && left == 0) found_.push_back(groups_);
        if (left == 0 || most_[from] < left) return;
        for (std::size_t size = 1; from + size <= columns_; ++size) {
            if (!reaches(from, size)) continue;
            groups_.push_back(size);
            extend(from + size, left - 1);
            groups_.pop_back();
        }
    }

    const std::vector<std::vector<double>>& strips_;
    double least_;
    std::size_t columns_;
    std::vector<std::size_t> most_; // maximum number of groups from each column on
    Sizes groups_;
    std::vector<Sizes> found_;
};

void addMerges(const PercentCounts& counts, const Sizes& rowGroups, double least, std::size_t& best,
               std::vector<GridMerge>& ties) {
    const auto strips = mergedRows(counts, rowGroups);
    ColumnDivisions columns{strips, least};
    const std::size_t cells = columns.most() * rowGroups.size();
    if (cells == 0 || cells < best) return;
    if (cells > best) ties.clear();
    best = cells;
    for (Sizes& groups : columns.ofSize(columns.most())) ties.push_back({std::move(groups), rowGroups});
}

} // namespace

double PercentCounts::sum() const noexcept { return std::accumulate(percent.begin(), percent.end(), 0.0); }

double PercentCounts::standardDeviation() const noexcept {
    if (percent.size() < 2) return 0.0;
    const double mean = sum() / static_cast<double>(percent.size());
    double squares = 0.0;
    for (const double p : percent) squares += (p - mean) * (p - mean);
    return std::sqrt(squares / static_cast<double>(percent.size() - 1));
}

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

PercentCounts merged(const PercentCounts& counts, const GridMerge& merge) {
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
