// SPDX-License-Identifier: MIT
// Absolute identification (thesis 3.2, 4.1): confusion matrix, information transfer, least confused stimuli;
// and grids of phantoms, with their percent counts and perceptual resolution.
#pragma once
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

/// The label "row,column", which parseGridCell() reads. Any thread.
std::string gridLabel(const GridCell& cell);

/// Sum of the distances in rows and in columns. Any thread.
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
    std::uint64_t correct() const noexcept {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < stimuli_; ++i) sum += count(i, i);
        return sum;
    }
    std::vector<std::uint64_t> stimulusTotals() const {
        std::vector<std::uint64_t> totals(stimuli_);
        for (std::size_t i = 0; i < stimuli_; ++i)
            for (std::size_t j = 0; j < responses(); ++j) totals[i] += count(i, j);
        return totals;
    }
    std::vector<std::uint64_t> responseTotals() const {
        std::vector<std::uint64_t> totals(responses());
        for (std::size_t i = 0; i < stimuli_; ++i)
            for (std::size_t j = 0; j < responses(); ++j) totals[j] += count(i, j);
        return totals;
    }

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
std::vector<IdentificationTrial> tolerate(std::vector<IdentificationTrial> trials, int tolerance);

// Information transfer of a confusion matrix in bits, with its bias and bounds (thesis 3.2, 4.1).

/// Trials per matrix cell from which the bias-corrected estimate is reported
/// (Docs/decisions/0017-correction-counts-what-was-seen.md).
constexpr double trialsPerCellForCorrection = 5.0;

struct InformationTransfer {
    double bits = 0.0;          ///< maximum-likelihood estimate; biased upward with few trials
    double biasBits = 0.0;      ///< expected bias of `bits`; 0 if every stimulus has one response only
    double minBits = 0.0;       ///< Fano's lower bound from the percent correct
    double maxBits = 0.0;       ///< log2 of the number of stimuli
    double trialsPerCell = 0.0; ///< trials / (stimuli x responses)

    bool canBeCorrected() const noexcept { return trialsPerCell >= trialsPerCellForCorrection; }
    double correctedBits() const noexcept { return bits > biasBits ? bits - biasBits : 0.0; }
    /// The estimate to report: bias-corrected if there are enough trials, else the raw estimate.
    double bestBits() const noexcept { return canBeCorrected() ? correctedBits() : bits; }
};

/// All zero without a trial. Any thread.
/// bits = sum_ij n_ij/n log2(n_ij n / (n_i. n_.j))
/// biasBits = max(0, cells - rows - columns + 1) / (2 n ln 2), counting only cells that occurred. Cells that
/// cannot occur add no bias, so this is Miller's correction without its overshoot for sparse matrices.
/// minBits = H(stimuli) - h(P_e) - (P_e - P_o) log2(M - 1) - P_o log2 M (Fano); M = number of stimuli, P_o
/// = share of responses that are no stimulus, after which each stimulus is possible
InformationTransfer informationTransfer(const ConfusionMatrix& matrix);

/// Fano's lower bound, clamped to at least 0. Any thread.
double fanoBits(double stimulusEntropyBits, double shareCorrect, std::size_t alternatives,
                double shareOutside = 0.0) noexcept;

/// Information transfer of one participant's trials.
struct ParticipantTransfer {
    std::string participant;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
};

/// In the order of first trials; trials without participants have one with an empty name. Any thread.
std::vector<ParticipantTransfer> transferByParticipant(const std::vector<IdentificationTrial>& trials);

/// Keeps the participants who had all stimuli, so that means can be compared; all if fewer than two had.
std::vector<ParticipantTransfer> keepComplete(std::vector<ParticipantTransfer> people, std::size_t stimuli);

// Selects the stimuli that participants confused least, for use as tactile icons (thesis 3.2.3).

/// Bits needed for that number of meanings: log2. Any thread.
inline double bitsForMeanings(std::size_t meanings) noexcept {
    return meanings > 1 ? std::log2(static_cast<double>(meanings)) : 0.0;
}

/// Share of the stimulus' trials that were answered correctly. Any thread.
inline double shareCorrect(const ConfusionMatrix& matrix, std::size_t stimulus) {
    const std::uint64_t total = matrix.stimulusTotals()[stimulus];
    return total > 0 ? static_cast<double>(matrix.count(stimulus, stimulus)) / static_cast<double>(total)
                     : 0.0;
}

/// Indices (ascending) of `count` stimuli, or of all if there are fewer. The most confused stimulus is
/// removed until `count` remain. Confusion of two stimuli is the sum of the shares of trials in which one was
/// answered with the other. Ties remove the stimulus with fewer correct answers, then the later one. Any
/// thread (allocates).
inline std::vector<std::size_t> leastConfused(const ConfusionMatrix& matrix, std::size_t count) {
    const auto totals = matrix.stimulusTotals();
    const auto confusion = [&](std::size_t a, std::size_t b) {
        return matrix.count(a, b) / static_cast<double>(totals[a]) +
               matrix.count(b, a) / static_cast<double>(totals[b]);
    };
    std::vector<std::size_t> remaining(matrix.stimuli());
    std::iota(remaining.begin(), remaining.end(), 0u);
    std::vector<double> confusions(matrix.stimuli(), 0.0);
    for (const std::size_t a : remaining)
        for (const std::size_t b : remaining)
            if (a != b) confusions[a] += confusion(a, b);
    while (remaining.size() > count) {
        const auto isBetter = [&](std::size_t a, std::size_t b) {
            constexpr double rounding = 1e-9;
            if (std::abs(confusions[a] - confusions[b]) > rounding) return confusions[a] < confusions[b];
            const double shareA = shareCorrect(matrix, a), shareB = shareCorrect(matrix, b);
            return shareA != shareB ? shareA > shareB : a < b;
        };
        const auto worst = std::ranges::max_element(remaining, isBetter);
        const std::size_t dropped = *worst;
        remaining.erase(worst);
        for (const std::size_t a : remaining) confusions[a] -= confusion(a, dropped);
    }
    return remaining;
}

// Grids of phantom sensations between actuators, percent counts of a grid, and the largest grid obtained by
// merging neighbouring rows and columns (thesis 4.1, 4.2, Fig. 4.9).

/// Minimum percentage of a kept cell: half a cell of a uniform 7 x 5 grid, as printed in the thesis (SPEC 3).
constexpr double defaultPercentThreshold = 1.42;

/// Maximum number of rows or columns of a grid; merging tries every division of them.
constexpr std::size_t maxGridLines = 16;

/// Share of the field, in percent, in which each target is the most likely one. Row 0 is the top row.
struct PercentCounts {
    std::string condition;
    std::size_t rows = 0, columns = 0;
    std::vector<double> percent; ///< row by row

    double at(std::size_t row, std::size_t column) const { return percent[row * columns + column]; }
    double sum() const noexcept { return std::accumulate(percent.begin(), percent.end(), 0.0); }
    /// Sample standard deviation; 0 for a single cell.
    double standardDeviation() const noexcept {
        if (percent.size() < 2) return 0.0;
        const double mean = sum() / static_cast<double>(percent.size());
        double squares = 0.0;
        for (const double p : percent) squares += (p - mean) * (p - mean);
        return std::sqrt(squares / static_cast<double>(percent.size() - 1));
    }
    bool operator==(const PercentCounts&) const = default;
};

/// Sizes of groups of neighbouring rows and columns: {1, 2, 1, 1} merges the second and third.
struct GridMerge {
    std::vector<std::size_t> columnGroups, rowGroups;
    bool operator==(const GridMerge&) const = default;
};

/// The largest grids whose cells all reach the threshold.
struct PerceptualResolution {
    std::size_t columns = 0, rows = 0; ///< of the first of `ties`; both 0: all is below the threshold
    std::vector<GridMerge> ties; ///< all with that number of cells, wider grids first; first: the result
};

/// `counts` with 1 to maxGridLines rows and columns, `thresholdPercent` inclusive. Any thread (allocates).
PerceptualResolution perceptualResolution(const PercentCounts& counts,
                                          double thresholdPercent = defaultPercentThreshold);

/// The percent counts of the merged cells. Any thread (allocates).
PercentCounts mergedCounts(const PercentCounts& counts, const GridMerge& merge);

struct PhantomGrid {
    enum class Points {
        corners, ///< the outer points lie on the field's edges, so the corners are the actuators (thesis 4.1)
        middles  ///< the field is divided into cells and the points are their centres (4.2; an assumption)
    };
    int columns = 0, rows = 0; ///< 1 to 16
    Points points = Points::corners;
    bool operator==(const PhantomGrid&) const = default;

    FieldPlace place(const GridCell& cell) const noexcept {
        return {lineAt(cell.column, columns), lineAt(cell.row, rows)};
    }

    /// The cell with the nearest point; the first of equal ones.
    GridCell nearest(const FieldPlace& place) const noexcept {
        return {nearestLine(place.y, rows), nearestLine(place.x, columns)};
    }

    /// All cells, row by row. Message thread only (allocates).
    std::vector<GridCell> cells() const {
        std::vector<GridCell> all;
        for (int row = 1; row <= rows; ++row)
            for (int column = 1; column <= columns; ++column) all.push_back({row, column});
        return all;
    }

private:
    double lineAt(int line, int lines) const noexcept {
        if (points == Points::middles || lines == 1) return (line - 0.5) / lines;
        return static_cast<double>(line - 1) / (lines - 1);
    }
    int nearestLine(double share, int lines) const noexcept {
        int best = 1;
        for (int line = 2; line <= lines; ++line) {
            const double offset = share - lineAt(line, lines), bestOffset = share - lineAt(best, lines);
            if (offset * offset < bestOffset * bestOffset) best = line;
        }
        return best;
    }
};

} // namespace physvib
