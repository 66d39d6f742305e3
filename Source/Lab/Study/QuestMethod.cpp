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

constexpr double maxLevels = 201.0; // with as many thresholds: 300,000 functions at most, some ms per trial
constexpr int widths = 7;           // in equal ratios; with fewer, the threshold is biased to the nearest

double levelCount(const QuestMethod& m) { return std::floor((m.maxDb - m.minDb) / m.stepDb + 1e-6) + 1.0; }

/// Level of a step, rounded so that it prints with few digits.
double levelAt(const QuestMethod& m, int step) {
    return std::round((m.minDb + step * m.stepDb) * 1e6) * 1e-6;
}

std::vector<std::string_view> splitWords(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) words.push_back(takeUntil(' ', text));
    return words;
}

bool parseWord(std::string_view word, double& number) {
    const auto read = parseNumber<double>(word);
    number = read.value_or(0.0);
    return read.has_value();
}

} // namespace

std::string questError(const QuestMethod& m) {
    if (!(m.minDb < m.maxDb)) return ": expected least_db < most_db";
    if (!(m.minWidthDb <= m.maxWidthDb)) return ": expected least_width_db <= most_width_db";
    if (const double levels = levelCount(m); !(levels <= maxLevels))
        return ".step_db: expected at most " + numberText(maxLevels) + " levels, found " + numberText(levels);
    return {};
}

QuestPlan questPlan(const QuestMethod& m, double guess) {
    QuestPlan plan{m.shape, guess, {}, {}, {}, {m.lapse}};
    for (int step = 0; step < static_cast<int>(levelCount(m)); ++step)
        plan.levels.push_back(levelAt(m, step));
    plan.thresholds = plan.levels;
    for (int i = 0; i < widths; ++i)
        plan.widths.push_back(m.minWidthDb * std::pow(m.maxWidthDb / m.minWidthDb, i / (widths - 1.0)));
    return plan;
}

std::string questText(const QuestMethod& m, double guess) {
    return std::string(psychometricShapeNames[static_cast<std::size_t>(m.shape)]) + " guess " +
           numberText(guess) + " lapse " + numberText(m.lapse) + " levels_db " + numberText(m.minDb) + ' ' +
           numberText(m.stepDb) + ' ' + numberText(m.maxDb) + " widths_db " + numberText(m.minWidthDb) + ' ' +
           numberText(m.maxWidthDb);
}

std::optional<QuestPlan> questPlan(std::string_view text) {
    const auto words = splitWords(text);
    if (words.size() != 12 || words[1] != "guess" || words[3] != "lapse" || words[5] != "levels_db" ||
        words[9] != "widths_db")
        return std::nullopt;
    const auto shape = std::ranges::find(psychometricShapeNames, words[0]);
    QuestMethod m;
    double guess = 0.0;
    const bool areNumbers = parseWord(words[2], guess) && parseWord(words[4], m.lapse) &&
                            parseWord(words[6], m.minDb) && parseWord(words[7], m.stepDb) &&
                            parseWord(words[8], m.maxDb) && parseWord(words[10], m.minWidthDb) &&
                            parseWord(words[11], m.maxWidthDb);
    if (!areNumbers || shape == psychometricShapeNames.end() ||
        !(guess > 0.0 && guess < 1.0 && m.lapse > 0.0 && m.lapse <= maxLapseRate && m.stepDb > 0.0 &&
          m.minWidthDb > 0.0) ||
        !questError(m).empty())
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
    posterior_.assign(functions, 1.0 / static_cast<double>(functions));
    for (const double level : plan_.levels)
        for (std::size_t i = 0; i < functions; ++i) {
            correct_.push_back(gridFunction(i).probability(level));
            answerEntropies_.push_back(answerEntropy(correct_.back()));
        }
    chooseNext();
}

PsychometricFunction QuestPlus::gridFunction(std::size_t index) const {
    const std::size_t lapses = plan_.lapses.size(), widths = plan_.widths.size();
    return {plan_.shape, plan_.thresholds[index / lapses / widths], plan_.widths[index / lapses % widths],
            plan_.guess, plan_.lapses[index % lapses]};
}

void QuestPlus::chooseNext() {
    // Minimising the expected posterior entropy means maximising the entropy of the answer minus its mean
    // entropy given each function. The remaining terms do not depend on the level.
    double maxInformation = -std::numeric_limits<double>::max();
    for (std::size_t level = 0; level < plan_.levels.size(); ++level) {
        double expected = 0.0, meanEntropy = 0.0;
        for (std::size_t i = 0; i < posterior_.size(); ++i) {
            expected += posterior_[i] * correct(level, i);
            meanEntropy += posterior_[i] * answerEntropies_[level * posterior_.size() + i];
        }
        if (const double information = answerEntropy(expected) - meanEntropy; information > maxInformation)
            maxInformation = information, next_ = level;
    }
}

void QuestPlus::answerAt(double level, bool isCorrect) {
    const auto nearest = std::ranges::min_element(
        plan_.levels, {}, [level](double planned) { return std::abs(planned - level); });
    const auto index = static_cast<std::size_t>(nearest - plan_.levels.begin());
    double sum = 0.0;
    for (std::size_t i = 0; i < posterior_.size(); ++i)
        sum += posterior_[i] *= isCorrect ? correct(index, i) : 1.0 - correct(index, i);
    for (double& probability : posterior_) probability /= sum;
    ++trials_;
    chooseNext();
}

PsychometricFunction QuestPlus::estimate() const {
    PsychometricFunction mean{plan_.shape, 0.0, 0.0, plan_.guess, 0.0};
    for (std::size_t i = 0; i < posterior_.size(); ++i) {
        const PsychometricFunction function = gridFunction(i);
        mean.threshold += posterior_[i] * function.threshold;
        mean.width += posterior_[i] * function.width;
        mean.lapse += posterior_[i] * function.lapse;
    }
    return mean;
}

double QuestPlus::thresholdDeviation() const {
    const double mean = estimate().threshold;
    double variance = 0.0;
    for (std::size_t i = 0; i < posterior_.size(); ++i)
        variance += posterior_[i] * (gridFunction(i).threshold - mean) * (gridFunction(i).threshold - mean);
    return std::sqrt(variance);
}

// A hierarchical posterior on a grid. One run of 40 trials hardly determines the width, but the threshold
// depends on it: most trials lie above the threshold, so too large a width gives too low a threshold. Widths
// of several people are assumed to be log-normal, with a median and a spread estimated from all runs. Steps:
// 1. For each run and width: the likelihood over all thresholds, and the mean threshold. 2. For each median
// and spread: the likelihood of all runs. 3. Average the thresholds of step 1, weighted by step 2.

namespace {

constexpr int pooledWidths = 25; // in equal ratios: finer than the prior of a run, since all
                                 // runs together tell it well
constexpr std::array<double, 2> widthSpreads{0.15, 0.3}; // standard deviations of ln(width) over people

using ByWidth = std::array<double, pooledWidths>;

/// A run's likelihood (relative) and mean threshold for each width.
struct RunByWidth {
    ByWidth likelihood{}, threshold{};
};

ByWidth makeWidthGrid(const QuestPlan& plan) {
    const auto [minWidth, maxWidth] = std::ranges::minmax(plan.widths);
    ByWidth widthGrid{};
    for (std::size_t i = 0; i < widthGrid.size(); ++i)
        widthGrid[i] =
            minWidth * std::pow(maxWidth / minWidth, static_cast<double>(i) / (pooledWidths - 1.0));
    return widthGrid;
}

RunByWidth sumByWidth(const QuestPlan& plan, const ByWidth& widthGrid, const std::vector<LevelCount>& run) {
    std::vector<double> logs;
    for (const double width : widthGrid)
        for (const double threshold : plan.thresholds)
            for (const double lapse : plan.lapses)
                logs.push_back(logLikelihood(run, {plan.shape, threshold, width, plan.guess, lapse}));
    const double maxLog = std::ranges::max(logs);
    RunByWidth result;
    std::size_t index = 0;
    for (std::size_t w = 0; w < widthGrid.size(); ++w) {
        double moment = 0.0;
        for (const double threshold : plan.thresholds)
            for (std::size_t l = 0; l < plan.lapses.size(); ++l) {
                // not to 0, so that every width has a mean threshold
                const double likelihood = std::exp(std::max(logs[index++] - maxLog, -600.0));
                result.likelihood[w] += likelihood;
                moment += likelihood * threshold;
            }
        result.threshold[w] = moment / result.likelihood[w];
    }
    return result;
}

/// Shares of the widths for each median and spread.
std::vector<ByWidth> widthPopulations(const ByWidth& widthGrid) {
    std::vector<ByWidth> populations;
    for (const double spread : widthSpreads)
        for (const double median : widthGrid) {
            ByWidth shares{};
            for (std::size_t w = 0; w < widthGrid.size(); ++w)
                shares[w] = std::exp(-0.5 * std::pow(std::log(widthGrid[w] / median) / spread, 2));
            const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
            for (double& share : shares) share /= sum;
            populations.push_back(shares);
        }
    return populations;
}

} // namespace

PooledThresholds pooledThresholds(const QuestPlan& plan, std::span<const std::vector<LevelCount>> runs) {
    const ByWidth widthGrid = makeWidthGrid(plan);
    std::vector<RunByWidth> runsByWidth;
    for (const auto& run : runs) runsByWidth.push_back(sumByWidth(plan, widthGrid, run));
    const std::vector<ByWidth> populations = widthPopulations(widthGrid);
    std::vector<double> populationWeights;
    std::vector<std::vector<double>> thresholds; // [population][run]
    for (const ByWidth& shares : populations) {
        double logs = 0.0;
        auto& runThresholds = thresholds.emplace_back();
        for (const RunByWidth& run : runsByWidth) {
            double sum = 0.0, moment = 0.0;
            for (std::size_t w = 0; w < widthGrid.size(); ++w) {
                sum += shares[w] * run.likelihood[w];
                moment += shares[w] * run.likelihood[w] * run.threshold[w];
            }
            logs += std::log(sum);
            runThresholds.push_back(moment / sum);
        }
        populationWeights.push_back(logs);
    }
    const double maxLog = std::ranges::max(populationWeights);
    for (double& probability : populationWeights) probability = std::exp(probability - maxLog);
    const double sum = std::accumulate(populationWeights.begin(), populationWeights.end(), 0.0);
    PooledThresholds pooled{std::vector<double>(runs.size()), 0.0};
    std::vector<double> means;
    for (std::size_t i = 0; i < populationWeights.size(); ++i) {
        for (std::size_t r = 0; r < runs.size(); ++r)
            pooled.thresholds[r] += populationWeights[i] / sum * thresholds[i][r];
        means.push_back(std::accumulate(thresholds[i].begin(), thresholds[i].end(), 0.0) /
                        static_cast<double>(runs.size()));
    }
    const double mean = std::inner_product(means.begin(), means.end(), populationWeights.begin(), 0.0) / sum;
    for (std::size_t i = 0; i < populationWeights.size(); ++i)
        pooled.deviation += populationWeights[i] / sum * (means[i] - mean) * (means[i] - mean);
    pooled.deviation = std::sqrt(pooled.deviation);
    return pooled;
}

} // namespace physvib
