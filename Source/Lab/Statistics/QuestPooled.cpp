// SPDX-License-Identifier: MIT
// A hierarchical posterior on a grid. One run of 40 trials hardly tells the width, but a threshold depends on
// it: most trials lie above the threshold, so a width that is taken as too large gives a threshold that is
// too low. Of several people the widths are taken as log-normal, with a median and a spread that all runs
// tell. Steps: 1. For each run and width: the likelihood over all thresholds, and the mean threshold. 2. For
// each median and spread: the likelihood of all runs. 3. Thresholds are means over 2. of those of 1.
#include "Lab/Statistics/QuestPooled.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace physvib {
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
