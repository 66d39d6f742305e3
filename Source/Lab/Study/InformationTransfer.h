// SPDX-License-Identifier: MIT
// Information transfer of a confusion matrix in bits, with its bias and bounds (thesis 3.2, 4.1).
#pragma once
#include "Lab/Study/ConfusionMatrix.h"

namespace physvib {

/// Trials per matrix cell from which the bias-corrected estimate is reported
/// (Docs/decisions/0017-correction-counts-what-was-seen.md).
constexpr double trialsPerCellForCorrection = 5.0;

struct InformationTransfer {
    double bits = 0.0;          ///< maximum-likelihood estimate; biased upward with few trials
    double biasBits = 0.0;      ///< expected bias of `bits`; 0 if every stimulus has one response only
    double leastBits = 0.0;     ///< Fano's lower bound from the percent correct
    double mostBits = 0.0;      ///< log2 of the number of stimuli
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
/// leastBits = H(stimuli) - h(P_e) - P_e log2(M - 1), M = number of stimuli (Fano)
InformationTransfer informationTransfer(const ConfusionMatrix& matrix);

/// Fano's lower bound, clamped to at least 0. Any thread.
double fanoBits(double stimulusEntropyBits, double shareCorrect, std::size_t alternatives) noexcept;

/// Information transfer of one participant's trials.
struct ParticipantTransfer {
    std::string participant;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
};

/// In the order of first trials. If participants are unknown, one entry with an empty name. Any thread
/// (allocates).
std::vector<ParticipantTransfer> transferByParticipant(const std::vector<IdentificationTrial>& trials);

} // namespace physvib
