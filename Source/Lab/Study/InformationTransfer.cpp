// SPDX-License-Identifier: MIT
// Computes information transfer from the non-empty cells of a confusion matrix, since 0 log 0 is 0.
#include "Lab/Study/InformationTransfer.h"
#include "Lab/Statistics/ByParticipant.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

double plogp(double p) noexcept { return p > 0.0 ? p * std::log2(p) : 0.0; }

double entropyBits(const std::vector<std::uint64_t>& counts, double total) {
    double bits = 0.0;
    for (const auto count : counts) bits -= plogp(static_cast<double>(count) / total);
    return bits;
}

std::size_t occupied(const std::vector<std::uint64_t>& counts) {
    return counts.size() - static_cast<std::size_t>(std::ranges::count(counts, 0u));
}

} // namespace

double fanoBits(double stimulusEntropyBits, double shareCorrect, std::size_t alternatives) noexcept {
    const double wrong = 1.0 - shareCorrect;
    const double binary = -plogp(wrong) - plogp(shareCorrect);
    const double among = alternatives > 1 ? std::log2(static_cast<double>(alternatives - 1)) : 0.0;
    return std::max(0.0, stimulusEntropyBits - binary - wrong * among);
}

InformationTransfer informationTransfer(const ConfusionMatrix& matrix) {
    InformationTransfer it;
    if (matrix.trials() == 0) return it;
    const auto n = static_cast<double>(matrix.trials());
    const auto rows = matrix.stimulusTotals(), columns = matrix.responseTotals();
    std::ptrdiff_t cells = 0;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.responses(); ++j) {
            const double count = matrix.count(i, j);
            if (count == 0.0) continue;
            ++cells;
            it.bits +=
                count / n *
                std::log2(count * n / (static_cast<double>(rows[i]) * static_cast<double>(columns[j])));
        }
    it.bits = std::max(0.0, it.bits); // rounding can give values below zero
    const auto parameters = cells - static_cast<std::ptrdiff_t>(occupied(rows) + occupied(columns)) + 1;
    it.biasBits =
        static_cast<double>(std::max<std::ptrdiff_t>(0, parameters)) / (2.0 * n * std::numbers::ln2);
    it.leastBits =
        fanoBits(entropyBits(rows, n), static_cast<double>(matrix.correct()) / n, matrix.stimuli());
    it.mostBits = std::log2(static_cast<double>(matrix.stimuli()));
    it.trialsPerCell = n / static_cast<double>(matrix.stimuli() * matrix.responses());
    return it;
}

std::vector<ParticipantTransfer> transferByParticipant(const std::vector<IdentificationTrial>& trials) {
    std::vector<ParticipantTransfer> transfers;
    for (const auto& [participant, own] : byParticipant(trials)) {
        const ConfusionMatrix matrix{own};
        transfers.push_back({participant, matrix, informationTransfer(matrix)});
    }
    return transfers;
}

} // namespace physvib
