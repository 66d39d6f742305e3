// SPDX-License-Identifier: MIT
// Bayesian update on a grid of psychometric functions.
// Steps: 1. Start with a uniform prior. 2. Present the level with the smallest expected posterior entropy. 3.
// Multiply each function's probability by that of the answer, and normalise. 4. Repeat from 2.
// Cost: proportional to levels times functions per trial, since all answer probabilities are precomputed.
#include "Lab/Statistics/QuestPlus.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace physvib {
namespace {

double answerEntropy(double p) {
    return p > 0.0 && p < 1.0 ? -p * std::log(p) - (1.0 - p) * std::log1p(-p) : 0.0;
}

/// Bin edges of the thresholds: midway between neighbours, and symmetric for the first and last.
std::vector<double> edgesOf(const std::vector<double>& places) {
    std::vector<double> edges{places.front()};
    for (std::size_t i = 1; i < places.size(); ++i) edges.push_back(std::midpoint(places[i - 1], places[i]));
    edges.push_back(places.back());
    edges.front() += places.front() - edges[1];
    edges.back() += places.back() - edges[places.size() - 1];
    return edges;
}

double heldBetween(double least, double most, const std::vector<double>& belief,
                   const std::vector<double>& edges) {
    double sum = 0.0;
    for (std::size_t i = 0; i < belief.size(); ++i)
        if (const double part = std::min(edges[i + 1], most) - std::max(edges[i], least); part > 0.0)
            sum += belief[i] * part / (edges[i + 1] - edges[i]);
    return sum;
}

} // namespace

QuestPlus::QuestPlus(QuestPlan plan)
    : plan_{std::move(plan)} {
    const std::size_t functions = plan_.thresholds.size() * plan_.widths.size() * plan_.lapses.size();
    belief_.assign(functions, 1.0 / static_cast<double>(functions));
    for (const double level : plan_.levels)
        for (std::size_t i = 0; i < functions; ++i) {
            correct_.push_back(possible(i).probability(level));
            unsure_.push_back(answerEntropy(correct_.back()));
        }
    chooseNext();
}

PsychometricFunction QuestPlus::possible(std::size_t index) const {
    const std::size_t lapses = plan_.lapses.size(), widths = plan_.widths.size();
    return {plan_.shape, plan_.thresholds[index / lapses / widths], plan_.widths[index / lapses % widths],
            plan_.guess, plan_.lapses[index % lapses]};
}

void QuestPlus::chooseNext() {
    // Minimising the expected posterior entropy means maximising the entropy of the answer minus its mean
    // entropy given each function. The remaining terms do not depend on the level.
    double most = -std::numeric_limits<double>::max();
    for (std::size_t level = 0; level < plan_.levels.size(); ++level) {
        double expected = 0.0, known = 0.0;
        for (std::size_t i = 0; i < belief_.size(); ++i) {
            expected += belief_[i] * correct(level, i);
            known += belief_[i] * unsure_[level * belief_.size() + i];
        }
        if (const double learnt = answerEntropy(expected) - known; learnt > most)
            most = learnt, next_ = level;
    }
}

void QuestPlus::answerAt(double level, bool isCorrect) {
    const auto nearest =
        std::ranges::min_element(plan_.levels, {}, [level](double own) { return std::abs(own - level); });
    const auto at = static_cast<std::size_t>(nearest - plan_.levels.begin());
    double sum = 0.0;
    for (std::size_t i = 0; i < belief_.size(); ++i)
        sum += belief_[i] *= isCorrect ? correct(at, i) : 1.0 - correct(at, i);
    for (double& belief : belief_) belief /= sum;
    ++trials_;
    chooseNext();
}

PsychometricFunction QuestPlus::estimate() const {
    PsychometricFunction mean{plan_.shape, 0.0, 0.0, plan_.guess, 0.0};
    for (std::size_t i = 0; i < belief_.size(); ++i) {
        const PsychometricFunction own = possible(i);
        mean.threshold += belief_[i] * own.threshold;
        mean.width += belief_[i] * own.width;
        mean.lapse += belief_[i] * own.lapse;
    }
    return mean;
}

double QuestPlus::thresholdDeviation() const {
    const double mean = estimate().threshold;
    double variance = 0.0;
    for (std::size_t i = 0; i < belief_.size(); ++i)
        variance += belief_[i] * (possible(i).threshold - mean) * (possible(i).threshold - mean);
    return std::sqrt(variance);
}

std::vector<double> QuestPlus::thresholdBelief() const {
    std::vector<double> sums(plan_.thresholds.size());
    for (std::size_t i = 0; i < belief_.size(); ++i)
        sums[i / plan_.lapses.size() / plan_.widths.size()] += belief_[i];
    return sums;
}

double QuestPlus::thresholdHalfInterval(double share) const {
    const std::vector<double> belief = thresholdBelief(), edges = edgesOf(plan_.thresholds);
    const double mean = estimate().threshold;
    double least = 0.0, most = edges.back() - edges.front();
    for (int halving = 0; halving < 50; ++halving) {
        const double half = 0.5 * (least + most);
        (heldBetween(mean - half, mean + half, belief, edges) < share ? least : most) = half;
    }
    return most;
}

} // namespace physvib
