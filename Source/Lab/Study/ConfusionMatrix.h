// SPDX-License-Identifier: MIT
// Confusion matrix of an identification study: how often each response was given to each stimulus (thesis
// 3.2, 4.1).
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// One trial of absolute identification: stimulus, response and participant (which may be empty).
struct IdentificationTrial {
    std::string stimulus, response, participant{};
    bool operator==(const IdentificationTrial&) const = default;
};

/// A cell of a grid. Row and column start at 1; row 1 is the top row.
struct GridCell {
    int row = 0, column = 0;
    bool operator==(const GridCell&) const = default;
};

/// Parses "2,5" as row 2, column 5; nullopt for any other text. Any thread.
std::optional<GridCell> parseGridCell(std::string_view label) noexcept;

/// "row,column". Any thread.
std::string gridLabel(const GridCell& cell);

/// |rows apart| + |columns apart|. Any thread.
int manhattanDistance(const GridCell& a, const GridCell& b) noexcept;

/// Counts of trials. Rows are the presented stimuli. Columns are the same labels in the same order, then the
/// labels that occur only as responses. Grid labels are ordered by row and column, others by their bytes.
class ConfusionMatrix {
public:
    explicit ConfusionMatrix(const std::vector<IdentificationTrial>& trials);

    std::size_t stimuli() const noexcept { return stimuli_; }
    std::size_t responses() const noexcept { return labels_.size(); }
    const std::string& label(std::size_t response) const { return labels_[response]; }
    std::uint32_t count(std::size_t stimulus, std::size_t response) const {
        return counts_[stimulus * labels_.size() + response];
    }
    std::uint64_t trials() const noexcept { return trials_; }
    std::uint64_t correct() const noexcept;
    std::vector<std::uint64_t> stimulusTotals() const;
    std::vector<std::uint64_t> responseTotals() const;

private:
    std::size_t indexOf(const std::string& label) const;

    std::size_t stimuli_ = 0;
    std::vector<std::string> labels_;
    std::vector<std::uint32_t> counts_;
    std::uint64_t trials_ = 0;
};

/// Copies the trials, with each response within `tolerance` of its stimulus (Manhattan distance of the grid
/// cells) replaced by the stimulus. Tolerance-IT is computed from these trials (thesis 4.1). Responses that
/// are no cells stay. Any thread.
std::vector<IdentificationTrial> withTolerance(std::vector<IdentificationTrial> trials, int tolerance);

} // namespace physvib
