// SPDX-License-Identifier: MIT
// Pairwise comparisons: paired and Welch's t as in R's t.test; rank tests as in RankTests.
#include "Lab/Statistics/Pairs.h"
#include "Lab/Statistics/Distributions.h"
#include "Lab/Statistics/EffectIntervals.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Statistics/RankTests.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

struct Sample {
    double n = 0.0, mean = 0.0, variance = 0.0;

    explicit Sample(const std::vector<double>& values)
        : n{static_cast<double>(values.size())}
        , mean{std::accumulate(values.begin(), values.end(), 0.0) / n} {
        for (const double v : values) variance += (v - mean) * (v - mean) / (n - 1.0);
    }
    /// True if the variance exceeds rounding error.
    bool varies(double size) const { return variance > std::max(1e-200, 1e-28 * size * size); }
};

std::vector<double> differencesOf(const std::vector<double>& first, const std::vector<double>& second) {
    std::vector<double> differences(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) differences[i] = first[i] - second[i];
    return differences;
}

/// Of the difference by Student's t, of d by the noncentrality, which is as much larger as t is than d.
void addIntervals(TestLine& line, double difference, double standardError) {
    const double half = studentQuantile(0.975, *line.df1) * standardError;
    line.difference = difference;
    line.differenceInterval = {difference - half, difference + half};
    const double ratio = difference != 0.0 ? *line.effectSize / *line.statistic : 0.0;
    if (ratio > 0.0)
        if (const auto bounds = noncentralityOfT(*line.statistic, *line.df1))
            line.effectInterval = {bounds->least * ratio, bounds->most * ratio};
}

TestLine pairedT(const std::vector<double>& first, const std::vector<double>& second) {
    TestLine line;
    line.n = first.size();
    const Sample sample{differencesOf(first, second)};
    if (!sample.varies(std::max(largestMagnitude(first), largestMagnitude(second)))) return line;
    line.df1 = sample.n - 1.0;
    line.statistic = sample.mean / std::sqrt(sample.variance / sample.n);
    line.p = studentTwoSided(*line.statistic, *line.df1);
    line.effectSize = sample.mean / std::sqrt(sample.variance);
    addIntervals(line, sample.mean, std::sqrt(sample.variance / sample.n));
    return line;
}

TestLine welchT(const std::vector<double>& first, const std::vector<double>& second) {
    TestLine line;
    line.n = first.size() + second.size();
    if (first.size() < 2 || second.size() < 2) return line;
    const Sample a{first}, b{second};
    const double error = a.variance / a.n + b.variance / b.n, share = a.variance / a.n / error;
    if (!a.varies(largestMagnitude(first)) && !b.varies(largestMagnitude(second))) return line;
    line.df1 = 1.0 / (share * share / (a.n - 1.0) + (1.0 - share) * (1.0 - share) / (b.n - 1.0));
    line.statistic = (a.mean - b.mean) / std::sqrt(error);
    line.p = studentTwoSided(*line.statistic, *line.df1);
    line.effectSize = (a.mean - b.mean) / std::sqrt(0.5 * (a.variance + b.variance));
    addIntervals(line, a.mean - b.mean, std::sqrt(error));
    return line;
}

TestLine pairedRanks(const std::vector<double>& first, const std::vector<double>& second) {
    return signedRank(differencesOf(first, second));
}

using Test = TestLine (*)(const std::vector<double>&, const std::vector<double>&);

/// Adds a line for each pair of `factor`'s levels. Returns an error if a pair cannot be compared.
std::string addPairs(TestReport& report, const DesignFactor& factor,
                     const std::vector<std::vector<double>>& values, Test test) {
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t j = i + 1; j < values.size(); ++j) {
            TestLine line = test(values[i], values[j]);
            line.effect = factor.name + ": " + factor.levels[i] + " - " + factor.levels[j];
            if (!line.statistic)
                return line.effect + ": expected two or more participants whose differences vary, found none";
            report.lines.push_back(std::move(line));
        }
    return {};
}

} // namespace

TestReport pairs(const Design& design, PairTest test, Correction correction) {
    if (!design.fault.empty()) return {design.fault};
    if (design.within.empty() && !design.between) return {"expected a within-factor or a between-factor"};
    if (design.participants.size() < 2)
        return {"expected two or more participants, found only " + design.participants.front()};
    const bool isStudent = test == PairTest::student;
    TestReport report{{}, isStudent ? "t" : "rank sum", isStudent ? "d" : "rank-biserial r"};
    for (std::size_t f = 0; f < design.within.size(); ++f) {
        const Design one = design.alone(f);
        std::vector<std::vector<double>> levels(one.cells());
        for (std::size_t i = 0; i < one.values.size(); ++i)
            levels[i % levels.size()].push_back(one.values[i]);
        if (auto fault = addPairs(report, one.within.front(), levels, isStudent ? pairedT : pairedRanks);
            !fault.empty())
            return {fault};
    }
    if (design.between) {
        std::vector<std::vector<double>> groups(design.groupCount());
        for (std::size_t p = 0; p < design.participants.size(); ++p) {
            double sum = 0.0;
            for (std::size_t c = 0; c < design.cells(); ++c) sum += design.value(p, c);
            groups[design.groups[p]].push_back(sum / static_cast<double>(design.cells()));
        }
        const Test ranks = [](const auto& a, const auto& b) { return rankSum(a, b); };
        if (auto fault = addPairs(report, *design.between, groups, isStudent ? welchT : ranks);
            !fault.empty())
            return {fault};
    }
    correctForNumber(report, correction);
    return report;
}

} // namespace physvib
