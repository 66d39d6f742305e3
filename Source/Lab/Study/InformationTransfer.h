// SPDX-License-Identifier: MIT
// Information transfer of a confusion matrix, in bits, with what is known of its error (thesis 3.2, 4.1).
#pragma once
#include "Lab/Study/ConfusionMatrix.h"

namespace physvib {

/// Trials per cell of the matrix from which the corrected estimate is reported (Docs/studies.md has the
/// measurements).
constexpr double trialsPerCellForCorrection = 5.0;

struct InformationTransfer {
    double bits = 0.0;          ///< maximum-likelihood estimate; biased upward with few trials
    double biasBits = 0.0;      ///< its expected excess; 0 where every stimulus has one response only
    double leastBits = 0.0;     ///< Fano's lower bound from the percent correct
    double mostBits = 0.0;      ///< log2 of the number of stimuli
    double trialsPerCell = 0.0; ///< trials / (stimuli x responses)

    bool canBeCorrected() const noexcept { return trialsPerCell >= trialsPerCellForCorrection; }
    double correctedBits() const noexcept { return bits > biasBits ? bits - biasBits : 0.0; }
    /// The estimate to go by: corrected where that can be trusted, else as it is.
    double bestBits() const noexcept { return canBeCorrected() ? correctedBits() : bits; }
};

/// All zero without a trial. Any thread.
///   bits = sum_ij n_ij/n log2(n_ij n / (n_i. n_.j))
///   biasBits = max(0, cells - rows - columns + 1) / (2 n ln 2), counted over what was seen: a cell that can
///   never
///     occur adds no bias, so this is Miller's correction without its overshoot for sparse matrices
///   leastBits = H(stimuli) - h(P_e) - P_e log2(M - 1), M = number of stimuli (Fano)
InformationTransfer informationTransfer(const ConfusionMatrix& matrix);

/// Fano's bound for equally likely stimuli; 0 where it says nothing. Any thread.
double fanoBits(double stimulusEntropyBits, double shareCorrect, std::size_t alternatives) noexcept;

/// What one participant's own trials say.
struct ParticipantTransfer {
    std::string participant;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
};

/// In the order of their first trial; one without a name if participants are unknown. Any thread (allocates).
std::vector<ParticipantTransfer> transferByParticipant(const std::vector<IdentificationTrial>& trials);

} // namespace physvib
