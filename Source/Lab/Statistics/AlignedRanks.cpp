// SPDX-License-Identifier: MIT
// Aligned rank transform (Wobbrock and others 2011).
// Steps for each effect: 1. Subtract the cell means from the values. 2. Add the effect's estimate, an
// alternating sum of the means over its parts. 3. Rank all values. 4. Analyse the ranks, and keep only the
// line of this effect.
#include "Lab/Statistics/DesignEffects.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Statistics/Ranks.h"
#include "Lab/Statistics/RepeatedMeasures.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace physvib {
namespace {

/// Index of the combination of levels of the effect's factors that a value has.
std::size_t levelsOf(const Design& design, const DesignEffect& effect, std::size_t value) {
    std::size_t cell = value % design.cells(),
                index = effect.isBetween ? design.groups[value / design.cells()] : 0;
    for (std::size_t i = design.within.size(); i-- > 0;) {
        const std::size_t levels = design.within[i].levels.size();
        if (effect.within >> i & 1u) index = index * levels + cell % levels;
        cell /= levels;
    }
    return index;
}

/// For each value, the mean of all values with the same levels of the effect's factors.
std::vector<double> meansBy(const Design& design, const DesignEffect& effect) {
    std::vector<double> sums(design.cells() * design.groupCount()), counts(sums.size()), means;
    for (std::size_t i = 0; i < design.values.size(); ++i) {
        sums[levelsOf(design, effect, i)] += design.values[i];
        counts[levelsOf(design, effect, i)] += 1.0;
    }
    for (std::size_t i = 0; i < design.values.size(); ++i)
        means.push_back(sums[levelsOf(design, effect, i)] / counts[levelsOf(design, effect, i)]);
    return means;
}

int order(const DesignEffect& effect) { return std::popcount(effect.within) + effect.isBetween; }

bool isPartOf(const DesignEffect& part, const DesignEffect& effect) {
    return (part.within & ~effect.within) == 0 && part.isBetween <= effect.isBetween;
}

std::vector<double> aligned(const Design& design, const DesignEffect& effect) {
    const auto effects = effectsOf(design);
    const auto cellMeans = meansBy(design, effects.back());
    std::vector<double> values = design.values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= cellMeans[i];
    for (const DesignEffect& part : effects) {
        if (!isPartOf(part, effect)) continue;
        const double sign = (order(effect) - order(part)) % 2 ? -1.0 : 1.0;
        const auto means = meansBy(design, part);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += sign * means[i];
    }
    return values;
}

/// Rounds to 1e-10 of the largest value, so that sums that differ only by rounding error become ties.
void makeTiesEqual(std::vector<double>& values) {
    const double largest = largestMagnitude(values);
    if (largest == 0.0) return;
    for (double& v : values) v = std::round(v / largest * 1e10);
}

} // namespace

TestReport alignedRanks(const Design& design) {
    TestReport report = repeatedMeasures(design); // for its error message and names
    if (!report.fault.empty()) return report;
    std::vector<TestLine> lines;
    for (const DesignEffect& effect : effectsOf(design)) {
        if (order(effect) == 0) continue;
        Design ranked = design;
        ranked.values = aligned(design, effect);
        makeTiesEqual(ranked.values);
        ranked.values = rankingOf(ranked.values).ranks;
        TestReport own = repeatedMeasures(ranked);
        if (!own.fault.empty()) return own;
        lines.push_back(std::move(own.lines[lines.size()]));
    }
    report.lines = std::move(lines);
    report.notes.push_back(
        "aligned ranks: each effect is of the ranks that are left when all others are taken off");
    return report;
}

} // namespace physvib
