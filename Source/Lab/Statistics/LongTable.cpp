// SPDX-License-Identifier: MIT
// Converts rows of trials to a complete design: averages cells and reports missing data.
#include "Lab/Statistics/LongTable.h"
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
    : measure_{std::move(measure)}
    , between_{std::move(between)}
    , within_{std::move(within)} {}

void LongTable::add(std::string_view participant, const std::vector<std::string_view>& levels,
                    std::string_view group, double value) {
    Row row{static_cast<std::uint32_t>(participants_.indexOf(participant)),
            static_cast<std::uint32_t>(groups_.indexOf(group)),
            {},
            value};
    for (std::size_t i = 0; i < within_.size(); ++i)
        row.levels[i] = static_cast<std::uint32_t>(levels_[i].indexOf(levels[i]));
    rows_.push_back(row);
}

namespace {

/// Means of the rows of each cell. A second pass adds the mean of the residuals, because a difference in the
/// last bit decides about ties.
class CellMeans {
public:
    explicit CellMeans(std::size_t cells)
        : sums_(cells)
        , counts_(cells) {}
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
    std::size_t filled() const {
        return counts_.size() - static_cast<std::size_t>(std::ranges::count(counts_, 0u));
    }
    double mean(std::size_t cell) const {
        return static_cast<double>(means_[cell] + sums_[cell] / static_cast<long double>(counts_[cell]));
    }

private:
    std::vector<long double> sums_, means_;
    std::vector<std::size_t> counts_;
};

std::string namedList(const std::vector<std::string>& names) {
    constexpr std::size_t mostTold = 10;
    std::string words;
    for (std::size_t i = 0; i < std::min(names.size(), mostTold); ++i)
        words.append(i ? ", " : "").append(names[i]);
    return names.size() > mostTold ? words + " and " + std::to_string(names.size() - mostTold) + " more"
                                   : words;
}

} // namespace

/// Builds a design step by step; each step either reports an error or prepares the next.
class DesignMaker {
public:
    explicit DesignMaker(const LongTable& table)
        : table_{table} {}

    Design make() {
        if (takeFactors() && takeRows() && hasEveryCell()) takeParticipants();
        return std::move(design_);
    }

private:
    bool refuse(std::string words) {
        design_.fault = std::move(words);
        return false;
    }

    bool takeFactors() {
        design_.measure = table_.measure_;
        if (table_.rows_.empty())
            return refuse("column " + design_.measure + ": expected numbers, found none");
        for (std::size_t i = 0; i < table_.within_.size(); ++i) {
            design_.within.push_back({table_.within_[i], table_.levels_[i].words()});
            const DesignFactor& factor = design_.within.back();
            if (factor.levels.size() < 2)
                return refuse("column " + factor.name + ": expected two or more levels, found only " +
                              factor.levels.front());
            if ((cells_ *= factor.levels.size()) > mostDesignCells)
                return refuse("expected at most " + std::to_string(mostDesignCells) +
                              " combinations of levels, found more");
        }
        if (people() * cells_ <= mostDesignValues) return true;
        return refuse("expected at most " + std::to_string(mostDesignValues) + " values, found " +
                      std::to_string(people()) + " participants with " + std::to_string(cells_) +
                      " combinations of levels");
    }

    bool takeRows() {
        means_ = CellMeans{people() * cells_};
        groups_.assign(people(), nobodys);
        for (const auto& row : table_.rows_) {
            if (!takeGroup(row)) return false;
            means_.add(cellOf(row), row.value);
        }
        means_.divide();
        for (const auto& row : table_.rows_) means_.addAgain(cellOf(row), row.value);
        return true;
    }

    bool takeGroup(const LongTable::Row& row) {
        std::uint32_t& group = groups_[row.participant];
        if (group == nobodys) group = row.group;
        if (group == row.group) return true;
        return refuse("participant " + table_.participants_[row.participant] + ": expected one value of " +
                      table_.between_ + ", found " + table_.groups_[group] + " and " +
                      table_.groups_[row.group]);
    }

    bool hasEveryCell() {
        for (std::size_t c = 0; c < cells_; ++c) {
            bool isThere = false;
            for (std::size_t p = 0; p < people() && !isThere; ++p) isThere = means_.has(p * cells_ + c);
            if (!isThere)
                return refuse("expected every combination of levels, found no value of " +
                              design_.cellName(c));
        }
        return true;
    }

    bool isComplete(std::size_t participant) const {
        for (std::size_t c = 0; c < cells_; ++c)
            if (!means_.has(participant * cells_ + c)) return false;
        return true;
    }

    bool takeParticipants() {
        std::vector<std::string> incomplete;
        WordList groups;
        for (std::size_t p = 0; p < people(); ++p) {
            if (!isComplete(p)) {
                incomplete.push_back(table_.participants_[p]);
                continue;
            }
            design_.participants.push_back(table_.participants_[p]);
            design_.groups.push_back(hasGroups() ? groups.indexOf(table_.groups_[groups_[p]]) : 0);
            for (std::size_t c = 0; c < cells_; ++c) design_.values.push_back(means_.mean(p * cells_ + c));
        }
        if (table_.rows_.size() > means_.filled())
            design_.warnings.push_back("several rows of a participant" +
                                       std::string(design_.within.empty() ? "" : " and condition") +
                                       " are averaged");
        if (!incomplete.empty())
            design_.warnings.push_back("left out, because a combination of levels has no value: " +
                                       namedList(incomplete));
        if (design_.participants.empty())
            return refuse("expected participants with a value in every combination of levels, found none");
        if (hasGroups()) design_.between = DesignFactor{table_.between_, groups.words()};
        return !hasGroups() || groups.size() > 1 ||
               refuse("column " + table_.between_ + ": expected two or more groups, found only " + groups[0]);
    }

    bool hasGroups() const { return !table_.between_.empty(); }
    std::size_t people() const { return table_.participants_.size(); }
    std::size_t cellOf(const LongTable::Row& row) const {
        std::size_t cell = row.participant;
        for (std::size_t i = 0; i < design_.within.size(); ++i)
            cell = cell * design_.within[i].levels.size() + row.levels[i];
        return cell;
    }

    static constexpr std::uint32_t nobodys = ~std::uint32_t{0};
    const LongTable& table_;
    Design design_;
    std::size_t cells_ = 1;
    CellMeans means_{0};
    std::vector<std::uint32_t> groups_; ///< group index of each participant
};

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

Design Design::of(const LongTable& table) { return DesignMaker{table}.make(); }

Design Design::alone(std::size_t factor) const {
    Design one = *this;
    one.within = {within[factor]};
    std::size_t after = 1;
    for (std::size_t i = factor + 1; i < within.size(); ++i) after *= within[i].levels.size();
    const std::size_t levels = within[factor].levels.size();
    CellMeans means{participants.size() * levels};
    const auto each = [&](auto take) {
        for (std::size_t i = 0; i < values.size(); ++i)
            take(i / cells() * levels + i / after % levels, values[i]);
    };
    each([&](std::size_t cell, double value) { means.add(cell, value); });
    means.divide();
    each([&](std::size_t cell, double value) { means.addAgain(cell, value); });
    one.values.clear();
    for (std::size_t i = 0; i < participants.size() * levels; ++i) one.values.push_back(means.mean(i));
    return one;
}

} // namespace physvib
