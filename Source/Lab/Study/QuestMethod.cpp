// SPDX-License-Identifier: MIT
// Converts QUEST+ settings to a grid and to text; updates the posterior; pools the runs of participants.
#include "Lab/Study/QuestMethod.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Protocol.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace physvib {
namespace {

constexpr double mostLevels = 201.0; // with as many thresholds: 300,000 functions at most, some ms per trial
constexpr int widths = 7;            // in equal ratios; with fewer, the threshold is biased to the nearest

double levelCount(const QuestMethod& m) { return std::floor((m.mostDb - m.leastDb) / m.stepDb + 1e-6) + 1.0; }

/// Level of a step, rounded so that it prints with few digits.
double levelAt(const QuestMethod& m, int step) {
    return std::round((m.leastDb + step * m.stepDb) * 1e6) * 1e-6;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) words.push_back(takeUntil(' ', text));
    return words;
}

bool take(std::string_view word, double& number) {
    const auto read = parseNumber<double>(word);
    number = read.value_or(0.0);
    return read.has_value();
}

} // namespace

std::string questFault(const QuestMethod& m) {
    if (!(m.leastDb < m.mostDb)) return ": expected least_db < most_db";
    if (!(m.leastWidthDb <= m.mostWidthDb)) return ": expected least_width_db <= most_width_db";
    if (const double levels = levelCount(m); !(levels <= mostLevels))
        return ".step_db: expected at most " + numberText(mostLevels) + " levels, found " +
               numberText(levels);
    return {};
}

QuestPlan questPlan(const QuestMethod& m, double guess) {
    QuestPlan plan{m.shape, guess, {}, {}, {}, {m.lapse}};
    for (int step = 0; step < static_cast<int>(levelCount(m)); ++step)
        plan.levels.push_back(levelAt(m, step));
    plan.thresholds = plan.levels;
    for (int i = 0; i < widths; ++i)
        plan.widths.push_back(m.leastWidthDb * std::pow(m.mostWidthDb / m.leastWidthDb, i / (widths - 1.0)));
    return plan;
}

std::string questWords(const QuestMethod& m, double guess) {
    return std::string(psychometricShapeNames[static_cast<std::size_t>(m.shape)]) + " guess " +
           numberText(guess) + " lapse " + numberText(m.lapse) + " levels_db " + numberText(m.leastDb) + ' ' +
           numberText(m.stepDb) + ' ' + numberText(m.mostDb) + " widths_db " + numberText(m.leastWidthDb) +
           ' ' + numberText(m.mostWidthDb);
}

std::optional<QuestPlan> questPlan(std::string_view text) {
    const auto words = wordsOf(text);
    if (words.size() != 12 || words[1] != "guess" || words[3] != "lapse" || words[5] != "levels_db" ||
        words[9] != "widths_db")
        return std::nullopt;
    const auto shape = std::ranges::find(psychometricShapeNames, words[0]);
    QuestMethod m;
    double guess = 0.0;
    const bool areNumbers = take(words[2], guess) && take(words[4], m.lapse) && take(words[6], m.leastDb) &&
                            take(words[7], m.stepDb) && take(words[8], m.mostDb) &&
                            take(words[10], m.leastWidthDb) && take(words[11], m.mostWidthDb);
    if (!areNumbers || shape == psychometricShapeNames.end() ||
        !(guess > 0.0 && guess < 1.0 && m.lapse > 0.0 && m.lapse <= mostLapse && m.stepDb > 0.0 &&
          m.leastWidthDb > 0.0) ||
        !questFault(m).empty())
        return std::nullopt;
    m.shape = static_cast<PsychometricShape>(shape - psychometricShapeNames.begin());
    return questPlan(m, guess);
}

// Bayesian update on a grid of psychometric functions.
// Steps: 1. Start with a uniform prior. 2. Present the level with the smallest expected posterior entropy. 3.
// Multiply each function's probability by that of the answer, and normalise. 4. Repeat from 2.
// Cost: proportional to levels times functions per trial, since all answer probabilities are precomputed.

namespace {

double answerEntropy(double p) {
    return p > 0.0 && p < 1.0 ? -p * std::log(p) - (1.0 - p) * std::log1p(-p) : 0.0;
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

// A hierarchical posterior on a grid. One run of 40 trials hardly tells the width, but a threshold depends on
// it: most trials lie above the threshold, so a width that is taken as too large gives a threshold that is
// too low. Of several people the widths are taken as log-normal, with a median and a spread that all runs
// tell. Steps: 1. For each run and width: the likelihood over all thresholds, and the mean threshold. 2. For
// each median and spread: the likelihood of all runs. 3. Thresholds are means over 2. of those of 1.

namespace {

constexpr int pooledWidths = 25; // in equal ratios: finer than the prior of a run, since all
                                 // runs together tell it well
constexpr std::array<double, 2> widthSpreads{0.15, 0.3}; // of ln(width) over people

using ByWidth = std::array<double, pooledWidths>;

/// A run's likelihood (relative) and mean threshold for each width.
struct RunByWidth {
    ByWidth likelihood{}, threshold{};
};

ByWidth widthsOf(const QuestPlan& plan) {
    const auto [least, most] = std::ranges::minmax(plan.widths);
    ByWidth all{};
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = least * std::pow(most / least, static_cast<double>(i) / (pooledWidths - 1.0));
    return all;
}

RunByWidth byWidth(const QuestPlan& plan, const ByWidth& all, const std::vector<LevelCount>& run) {
    std::vector<double> logs;
    for (const double width : all)
        for (const double threshold : plan.thresholds)
            for (const double lapse : plan.lapses)
                logs.push_back(logLikelihood(run, {plan.shape, threshold, width, plan.guess, lapse}));
    const double most = std::ranges::max(logs);
    RunByWidth result;
    std::size_t at = 0;
    for (std::size_t w = 0; w < all.size(); ++w) {
        double moment = 0.0;
        for (const double threshold : plan.thresholds)
            for (std::size_t l = 0; l < plan.lapses.size(); ++l) {
                // not to 0, so that every width has a mean threshold
                const double likelihood = std::exp(std::max(logs[at++] - most, -600.0));
                result.likelihood[w] += likelihood;
                moment += likelihood * threshold;
            }
        result.threshold[w] = moment / result.likelihood[w];
    }
    return result;
}

/// Shares of the widths for each median and spread.
std::vector<ByWidth> populationsOf(const ByWidth& all) {
    std::vector<ByWidth> populations;
    for (const double spread : widthSpreads)
        for (const double median : all) {
            ByWidth shares{};
            for (std::size_t w = 0; w < all.size(); ++w)
                shares[w] = std::exp(-0.5 * std::pow(std::log(all[w] / median) / spread, 2));
            const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
            for (double& share : shares) share /= sum;
            populations.push_back(shares);
        }
    return populations;
}

} // namespace

PooledThresholds pooledThresholds(const QuestPlan& plan, std::span<const std::vector<LevelCount>> runs) {
    const ByWidth all = widthsOf(plan);
    std::vector<RunByWidth> known;
    for (const auto& run : runs) known.push_back(byWidth(plan, all, run));
    const std::vector<ByWidth> populations = populationsOf(all);
    std::vector<double> beliefs;
    std::vector<std::vector<double>> thresholds; // by population and run
    for (const ByWidth& shares : populations) {
        double logs = 0.0;
        auto& own = thresholds.emplace_back();
        for (const RunByWidth& run : known) {
            double sum = 0.0, moment = 0.0;
            for (std::size_t w = 0; w < all.size(); ++w) {
                sum += shares[w] * run.likelihood[w];
                moment += shares[w] * run.likelihood[w] * run.threshold[w];
            }
            logs += std::log(sum);
            own.push_back(moment / sum);
        }
        beliefs.push_back(logs);
    }
    const double most = std::ranges::max(beliefs);
    for (double& belief : beliefs) belief = std::exp(belief - most);
    const double sum = std::accumulate(beliefs.begin(), beliefs.end(), 0.0);
    PooledThresholds pooled{std::vector<double>(runs.size()), 0.0};
    std::vector<double> means;
    for (std::size_t i = 0; i < beliefs.size(); ++i) {
        for (std::size_t r = 0; r < runs.size(); ++r)
            pooled.thresholds[r] += beliefs[i] / sum * thresholds[i][r];
        means.push_back(std::accumulate(thresholds[i].begin(), thresholds[i].end(), 0.0) /
                        static_cast<double>(runs.size()));
    }
    const double mean = std::inner_product(means.begin(), means.end(), beliefs.begin(), 0.0) / sum;
    for (std::size_t i = 0; i < beliefs.size(); ++i)
        pooled.deviation += beliefs[i] / sum * (means[i] - mean) * (means[i] - mean);
    pooled.deviation = std::sqrt(pooled.deviation);
    return pooled;
}

} // namespace physvib
