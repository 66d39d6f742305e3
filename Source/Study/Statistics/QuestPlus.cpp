// SPDX-License-Identifier: MIT
// Bayes' rule on a grid; the next level is the one with the least entropy to be expected.
#include "Study/Statistics/QuestPlus.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace physvib {
namespace {

double answerEntropy(double p) { return p > 0.0 && p < 1.0 ? -p * std::log(p) - (1.0 - p) * std::log1p(-p) : 0.0; }

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
    return {plan_.shape, plan_.thresholds[index / lapses / widths], plan_.widths[index / lapses % widths], plan_.guess, plan_.lapses[index % lapses]};
}

void QuestPlus::chooseNext() {
    // The belief's entropy that is left is, but for what no level changes, that of the answer under each function minus that of the answer.
    double most = -std::numeric_limits<double>::max();
    for (std::size_t level = 0; level < plan_.levels.size(); ++level) {
        double expected = 0.0, known = 0.0;
        for (std::size_t i = 0; i < belief_.size(); ++i) {
            expected += belief_[i] * correct(level, i);
            known += belief_[i] * unsure_[level * belief_.size() + i];
        }
        if (const double learnt = answerEntropy(expected) - known; learnt > most) most = learnt, next_ = level;
    }
}

void QuestPlus::answerAt(double level, bool isCorrect) {
    const auto nearest = std::ranges::min_element(plan_.levels, {}, [level](double own) { return std::abs(own - level); });
    const auto at = static_cast<std::size_t>(nearest - plan_.levels.begin());
    double sum = 0.0;
    for (std::size_t i = 0; i < belief_.size(); ++i) sum += belief_[i] *= isCorrect ? correct(at, i) : 1.0 - correct(at, i);
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
    for (std::size_t i = 0; i < belief_.size(); ++i) variance += belief_[i] * (possible(i).threshold - mean) * (possible(i).threshold - mean);
    return std::sqrt(variance);
}

} // namespace physvib
