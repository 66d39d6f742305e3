// SPDX-License-Identifier: MIT
// Rows into cells: averages, and what is missing.
#include "Study/Statistics/LongTable.h"
#include <algorithm>
#include <utility>

namespace physvib {

std::size_t WordList::indexOf(std::string_view word) {
    if (const auto found = indices_.find(word); found != indices_.end()) return found->second;
    words_.emplace_back(word);
    indices_.emplace(words_.back(), words_.size() - 1);
    return words_.size() - 1;
}

LongTable::LongTable(std::string measure, std::vector<std::string> within, std::string between)
    : measure_{std::move(measure)}, between_{std::move(between)}, within_{std::move(within)} {}

void LongTable::add(std::string_view participant, const std::vector<std::string_view>& levels, std::string_view group, double value) {
    Row row{static_cast<std::uint32_t>(participants_.indexOf(participant)), static_cast<std::uint32_t>(groups_.indexOf(group)), {}, value};
    for (std::size_t i = 0; i < within_.size(); ++i) row.levels[i] = static_cast<std::uint32_t>(levels_[i].indexOf(levels[i]));
    rows_.push_back(row);
}

namespace {

/// Means of the rows of each cell. Summed twice, the second time what the first mean has left: the last bit decides about ties.
class CellMeans {
public:
    explicit CellMeans(std::size_t cells)
        : sums_(cells), counts_(cells) {}
    void add(std::size_t cell, double value) {
        sums_[cell] += value;
        ++counts_[cell];
    }
    void divide() {
        means_ = sums_;
        for (std::size_t i = 0; i < sums_.size(); ++i)
            if (counts_[i] > 0) means_[i] /= static_cast<long double>(counts_[i]);
        std::ranges::fill(sums_, 0.0L);
    }
    void addAgain(std::size_t cell, double value) { sums_[cell] += value - means_[cell]; }
    bool has(std::size_t cell) const { return counts_[cell] > 0; }
    bool isAverage(std::size_t cell) const { return counts_[cell] > 1; }
    double mean(std::size_t cell) const { return static_cast<double>(means_[cell] + sums_[cell] / static_cast<long double>(counts_[cell])); }

private:
    std::vector<long double> sums_, means_;
    std::vector<std::size_t> counts_;
};

std::string namedList(const std::vector<std::string>& names) {
    constexpr std::size_t mostTold = 10;
    std::string words;
    for (std::size_t i = 0; i < std::min(names.size(), mostTold); ++i) words.append(i ? ", " : "").append(names[i]);
    return names.size() > mostTold ? words + " and " + std::to_string(names.size() - mostTold) + " more" : words;
}

} // namespace

std::size_t Design::cells() const noexcept {
    std::size_t count = 1;
    for (const DesignFactor& factor : within) count *= factor.levels.size();
    return count;
}

std::string Design::cellName(std::size_t cell) const {
    if (within.empty()) return measure;
    std::string name;
    for (std::size_t i = within.size(); i-- > 0;) {
        const std::size_t levels = within[i].levels.size();
        name = within[i].name + "=" + within[i].levels[cell % levels] + (name.empty() ? "" : ":") + name;
        cell /= levels;
    }
    return name;
}

Design Design::of(const LongTable& table) {
    Design design;
    const auto refuse = [&](std::string words) {
        design.fault = std::move(words);
        return design;
    };
    design.measure = table.measure_;
    for (std::size_t i = 0; i < table.within_.size(); ++i) design.within.push_back({table.within_[i], table.levels_[i].words()});
    const bool hasGroups = !table.between_.empty();
    if (table.rows_.empty()) return refuse("column " + design.measure + ": expected numbers, found none");
    for (const DesignFactor& factor : design.within)
        if (factor.levels.size() < 2) return refuse("column " + factor.name + ": expected two or more levels, found only " + factor.levels.front());
    std::size_t cells = 1;
    for (const DesignFactor& factor : design.within)
        if ((cells *= factor.levels.size()) > mostDesignCells) return refuse("expected at most " + std::to_string(mostDesignCells) + " combinations of levels, found more");

    const std::size_t people = table.participants_.size();
    if (people * cells > mostDesignValues) // participants who are complete have so many rows; most of these are not
        return refuse("expected at most " + std::to_string(mostDesignValues) + " values, found " + std::to_string(people) + " participants with " + std::to_string(cells) + " combinations of levels");
    constexpr std::uint32_t nobodys = ~std::uint32_t{0};
    std::vector<std::uint32_t> groupOf(people, nobodys);
    CellMeans means{people * cells};
    const auto cellOf = [&](const LongTable::Row& row) {
        std::size_t cell = row.participant;
        for (std::size_t i = 0; i < design.within.size(); ++i) cell = cell * design.within[i].levels.size() + row.levels[i];
        return cell;
    };
    for (const auto& row : table.rows_) {
        std::uint32_t& group = groupOf[row.participant];
        if (group != nobodys && group != row.group)
            return refuse("participant " + table.participants_[row.participant] + ": expected one value of " + table.between_ + ", found " + table.groups_[group] + " and " +
                          table.groups_[row.group]);
        group = row.group;
        means.add(cellOf(row), row.value);
    }
    means.divide();
    for (const auto& row : table.rows_) means.addAgain(cellOf(row), row.value);

    for (std::size_t c = 0; c < cells; ++c) {
        bool isThere = false;
        for (std::size_t p = 0; p < people && !isThere; ++p) isThere = means.has(p * cells + c);
        if (!isThere) return refuse("expected every combination of levels, found no value of " + design.cellName(c));
    }
    std::vector<std::string> incomplete;
    WordList groups;
    bool isAveraged = false;
    for (std::size_t p = 0; p < people; ++p) {
        std::size_t there = 0;
        for (std::size_t c = 0; c < cells; ++c) there += means.has(p * cells + c);
        if (there < cells) {
            incomplete.push_back(table.participants_[p]);
            continue;
        }
        design.participants.push_back(table.participants_[p]);
        design.groups.push_back(hasGroups ? groups.indexOf(table.groups_[groupOf[p]]) : 0);
        for (std::size_t c = 0; c < cells; ++c) {
            design.values.push_back(means.mean(p * cells + c));
            isAveraged |= means.isAverage(p * cells + c);
        }
    }
    if (isAveraged) design.warnings.push_back("several rows of a participant" + std::string(design.within.empty() ? "" : " and condition") + " are averaged");
    if (!incomplete.empty()) design.warnings.push_back("left out, because a combination of levels has no value: " + namedList(incomplete));
    if (design.participants.empty()) return refuse("expected participants with a value in every combination of levels, found none");
    if (hasGroups) design.between = DesignFactor{table.between_, groups.words()};
    if (hasGroups && groups.size() < 2) return refuse("column " + table.between_ + ": expected two or more groups, found only " + groups[0]);
    return design;
}

Design Design::alone(std::size_t factor) const {
    Design one = *this;
    one.within = {within[factor]};
    std::size_t after = 1;
    for (std::size_t i = factor + 1; i < within.size(); ++i) after *= within[i].levels.size();
    const std::size_t levels = within[factor].levels.size();
    CellMeans means{participants.size() * levels};
    const auto each = [&](auto take) {
        for (std::size_t i = 0; i < values.size(); ++i) take(i / cells() * levels + i / after % levels, values[i]);
    };
    each([&](std::size_t cell, double value) { means.add(cell, value); });
    means.divide();
    each([&](std::size_t cell, double value) { means.addAgain(cell, value); });
    one.values.clear();
    for (std::size_t i = 0; i < participants.size() * levels; ++i) one.values.push_back(means.mean(i));
    return one;
}

} // namespace physvib
