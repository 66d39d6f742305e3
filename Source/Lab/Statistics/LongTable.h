// SPDX-License-Identifier: MIT
// A table with a row per trial, or per participant and condition, and the complete design that tests over
// participants want.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace physvib {

/// Different words in the order of their first appearance.
class WordList {
public:
    std::size_t indexOf(std::string_view word); ///< appends what is new
    std::size_t size() const noexcept { return words_.size(); }
    const std::string& operator[](std::size_t index) const { return words_[index]; }
    const std::vector<std::string>& words() const noexcept { return words_; }

private:
    struct Hash {
        using is_transparent = void;
        std::size_t operator()(std::string_view word) const noexcept {
            return std::hash<std::string_view>{}(word);
        }
    };
    std::vector<std::string> words_;
    std::unordered_map<std::string, std::size_t, Hash, std::equal_to<>> indices_;
};

constexpr std::size_t mostWithinFactors = 3;
constexpr std::size_t mostDesignCells = 1024;        // an effect's matrix has its square
constexpr std::size_t mostDesignValues = 10'000'000; // of all participants and cells: a million rows leave
                                                     // most of them empty

/// Rows of one measure. Any thread, one at a time (allocates).
class LongTable {
public:
    LongTable() = default;
    /// `within`: at most mostWithinFactors; `between` may be empty: no groups.
    LongTable(std::string measure, std::vector<std::string> within, std::string between);

    /// `levels`: one per within-factor, in their order. A group is given with every row, or never.
    void add(std::string_view participant, const std::vector<std::string_view>& levels,
             std::string_view group, double value);

    std::size_t rows() const noexcept { return rows_.size(); }

private:
    friend class DesignMaker; // in LongTable.cpp
    struct Row {
        std::uint32_t participant = 0, group = 0;
        std::array<std::uint32_t, mostWithinFactors> levels{};
        double value = 0.0;
    };
    std::string measure_, between_;
    std::vector<std::string> within_;
    WordList participants_, groups_;
    std::array<WordList, mostWithinFactors> levels_;
    std::vector<Row> rows_;
};

struct DesignFactor {
    std::string name;
    std::vector<std::string> levels; ///< in the order of the rows
};

/// One value per participant and cell, none missing: what every test here starts from.
struct Design {
    std::string measure;
    std::vector<DesignFactor> within;
    std::optional<DesignFactor> between;
    std::vector<std::string> participants;
    std::vector<std::size_t> groups; ///< of each participant; all 0 without `between`
    std::vector<double> values; ///< participant by participant; in it cell by cell, the last factor's levels
                                ///< next to each other
    std::vector<std::string> warnings;
    std::string fault; ///< one line; then nothing else holds

    std::size_t cells() const noexcept;
    std::size_t groupCount() const noexcept { return between ? between->levels.size() : 1; }
    double value(std::size_t participant, std::size_t cell) const {
        return values[participant * cells() + cell];
    }
    std::string cellName(std::size_t cell) const; ///< "law=linear:device=phone"; the measure's name without a
                                                  ///< factor

    /// Several rows of a participant's cell are averaged, participants with an empty cell are left out: both
    /// are told. Faults: fewer than two levels or groups, a combination that nobody has, a participant in two
    /// groups, nobody with a whole row of cells.
    static Design of(const LongTable& table);

    /// One factor's levels alone: means over the cells of all others.
    Design alone(std::size_t factor) const;
};

} // namespace physvib
