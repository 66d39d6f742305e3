// SPDX-License-Identifier: MIT
// Long table (a row per trial or per participant and condition), and the complete design for tests over
// participants.
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

/// Distinct words in the order of first appearance, with their indices.
class WordList {
public:
    std::size_t indexOf(std::string_view word); ///< appends unknown words
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
constexpr std::size_t mostDesignCells = 1024;        // limited, because the matrix of an effect has the
                                                     // square of this size
constexpr std::size_t mostDesignValues = 10'000'000; // participants times cells; a table with a million rows
                                                     // leaves most of these empty

/// Rows of one measure. Any thread, but only one at a time (allocates).
class LongTable {
public:
    LongTable() = default;
    /// `within`: at most mostWithinFactors; `between` is empty if there are no groups.
    LongTable(std::string measure, std::vector<std::string> within, std::string between);

    /// `levels`: one per within-factor, in their order. Either all rows or none have a group.
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

/// Complete design: one value per participant and cell. All tests here take it as input.
struct Design {
    std::string measure;
    std::vector<DesignFactor> within;
    std::optional<DesignFactor> between;
    std::vector<std::string> participants;
    std::vector<std::size_t> groups; ///< group index of each participant; all 0 without `between`
    std::vector<double> values;      ///< by participant, then by cell; the last factor varies fastest
    std::vector<std::string> warnings;
    std::string fault; ///< error in one line; if set, the rest is invalid

    std::size_t cells() const noexcept;
    std::size_t groupCount() const noexcept { return between ? between->levels.size() : 1; }
    double value(std::size_t participant, std::size_t cell) const {
        return values[participant * cells() + cell];
    }
    std::string cellName(std::size_t cell) const; ///< "law=linear:device=phone"; the measure's name if there
                                                  ///< is no factor

    /// Averages several rows of a participant's cell and drops participants with an empty cell; both give a
    /// warning. Errors: fewer than two levels or groups, a combination without data, a participant in two
    /// groups, no participant with all cells.
    static Design of(const LongTable& table);

    /// Design with one factor only: means over the cells of all others.
    Design alone(std::size_t factor) const;
};

} // namespace physvib
