// SPDX-License-Identifier: MIT
// Friedman 1937, Wilcoxon 1945, Mann and Whitney 1947, and Kruskal and Wallis 1952, computed as in R's stats
// package.
#include "Lab/Statistics/RankTests.h"
#include "Lab/Statistics/Distributions.h"
#include "Lab/Statistics/EffectIntervals.h"
#include "Lab/Statistics/Ranks.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

constexpr std::size_t exactBelow = 50; // sample size below which p is exact, as in R

/// Two-sided normal probability of a sum of ranks, with continuity correction.
double correctedNormal(double distance, double variance) {
    const double half = distance > 0.0 ? 0.5 : distance < 0.0 ? -0.5 : 0.0;
    return std::min(1.0, 2.0 * normalUpper(std::abs(distance - half) / std::sqrt(variance)));
}

/// Runs `test` for each within-factor separately; returns all lines, or the first error.
template <class Test>
TestReport factorByFactor(const Design& design, TestReport report, Test test) {
    if (!design.fault.empty()) return {design.fault};
    if (design.within.empty()) return {"expected a within-factor"};
    if (design.between) return {"expected no between-factor, found " + design.between->name};
    if (design.participants.size() < 2)
        return {"expected two or more participants, found only " + design.participants.front()};
    for (std::size_t i = 0; i < design.within.size(); ++i) {
        TestLine line;
        if (const std::string fault = test(design.alone(i), line); !fault.empty())
            return {"column " + design.within[i].name + ": " + fault};
        line.effect = design.within[i].name;
        report.lines.push_back(std::move(line));
    }
    return report;
}

std::string friedmanLine(const Design& one, TestLine& line) {
    const std::size_t levels = one.cells();
    const auto n = static_cast<double>(one.participants.size()), k = static_cast<double>(levels);
    std::vector<double> sums(levels);
    double tieTerm = 0.0, between = 0.0;
    for (std::size_t p = 0; p < one.participants.size(); ++p) {
        const Ranking own = rankingOf(std::span{one.values}.subspan(p * levels, levels));
        for (std::size_t c = 0; c < levels; ++c) sums[c] += own.ranks[c];
        tieTerm += own.tieTerm;
    }
    for (const double sum : sums) between += (sum - n * (k + 1.0) / 2.0) * (sum - n * (k + 1.0) / 2.0);
    const double scale = n * k * (k + 1.0) - tieTerm / (k - 1.0);
    if (scale <= 0.5) return "expected levels that differ for some participant, found none: all are tied";
    const double chi = 12.0 * between / scale;
    line = {{},
            k - 1.0,
            {},
            chi,
            chiSquaredUpper(chi, k - 1.0),
            {},
            {},
            chi / (n * (k - 1.0)),
            one.participants.size()};
    return {};
}

std::string wilcoxonLine(const Design& one, TestLine& line) {
    if (one.cells() != 2)
        return "expected two levels, found " + std::to_string(one.cells()) +
               " (friedman tests them together, pairs two by two)";
    std::vector<double> differences;
    for (std::size_t p = 0; p < one.participants.size(); ++p)
        differences.push_back(one.value(p, 0) - one.value(p, 1));
    line = signedRank(differences);
    line.n = one.participants.size();
    return line.statistic ? "" : "expected levels that differ for some participant, found none";
}

/// Splits the values by group; returns an error if the design does not consist of groups only.
std::string groupsOf(const Design& design, std::vector<std::vector<double>>& groups) {
    if (!design.fault.empty()) return design.fault;
    if (!design.between) return "expected a between-factor";
    if (!design.within.empty()) return "expected no within-factor, found " + design.within.front().name;
    groups.resize(design.groupCount());
    for (std::size_t p = 0; p < design.participants.size(); ++p)
        groups[design.groups[p]].push_back(design.values[p]);
    return {};
}

std::string allEqual(const Design& design) {
    return "column " + design.measure + ": expected values that differ, found the same for every participant";
}

} // namespace

TestLine signedRank(std::span<const double> differences) {
    std::vector<double> sizes;
    for (const double d : differences)
        if (d != 0.0) sizes.push_back(std::abs(d));
    TestLine line;
    line.n = differences.size();
    if (sizes.empty()) return line;
    const Ranking ranking = rankingOf(sizes);
    double v = 0.0;
    auto rank = ranking.ranks.begin();
    for (const double d : differences) {
        if (d > 0.0) v += *rank;
        if (d != 0.0) ++rank;
    }
    const auto n = static_cast<double>(sizes.size());
    const double all = n * (n + 1.0) / 2.0;
    const bool isExact =
        sizes.size() < exactBelow && !ranking.hasTies() && sizes.size() == differences.size();
    line.statistic = v;
    line.p = isExact ? signedRankTwoSided(v, sizes.size())
                     : correctedNormal(v - 0.5 * all,
                                       n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranking.tieTerm / 48.0);
    line.effectSize = 2.0 * v / all - 1.0;
    line.effectInterval = intervalOfR(*line.effectSize, 2.0 * (2.0 * n + 1.0) / (3.0 * n * (n + 1.0)));
    return line;
}

TestLine rankSum(std::span<const double> first, std::span<const double> second) {
    std::vector<double> values{first.begin(), first.end()};
    values.insert(values.end(), second.begin(), second.end());
    const Ranking ranking = rankingOf(values);
    const auto m = static_cast<double>(first.size()), n = static_cast<double>(second.size()), all = m + n;
    TestLine line;
    line.n = values.size();
    const double variance = m * n / 12.0 * (all + 1.0 - ranking.tieTerm / (all * (all - 1.0)));
    if (variance < 1e-9 * m * n) return line; // all values equal
    const double w = std::accumulate(ranking.ranks.begin(),
                                     ranking.ranks.begin() + static_cast<std::ptrdiff_t>(first.size()), 0.0) -
                     m * (m + 1.0) / 2.0;
    const bool isExact = first.size() < exactBelow && second.size() < exactBelow && !ranking.hasTies();
    line.statistic = w;
    line.p = isExact ? rankSumTwoSided(w, first.size(), second.size())
                     : correctedNormal(w - m * n / 2.0, variance);
    line.effectSize = 2.0 * w / (m * n) - 1.0;
    line.effectInterval = intervalOfR(*line.effectSize, (all + 1.0) / (3.0 * m * n));
    return line;
}

TestReport friedman(const Design& design) {
    return factorByFactor(design, {{}, "chi-squared", "Kendall's W"}, friedmanLine);
}

TestReport wilcoxon(const Design& design) {
    return factorByFactor(design, {{}, "V", "rank-biserial r"}, wilcoxonLine);
}

TestReport mannWhitney(const Design& design) {
    std::vector<std::vector<double>> groups;
    if (auto fault = groupsOf(design, groups); !fault.empty()) return {fault};
    if (groups.size() != 2)
        return {"column " + design.between->name + ": expected two groups, found " +
                std::to_string(groups.size()) + " (kruskal-wallis tests them together, pairs two by two)"};
    TestLine line = rankSum(groups[0], groups[1]);
    if (!line.statistic) return {allEqual(design)};
    line.effect = design.between->name;
    return {{}, "W", "rank-biserial r", {}, {}, {line}};
}

TestReport kruskalWallis(const Design& design) {
    std::vector<std::vector<double>> groups;
    if (auto fault = groupsOf(design, groups); !fault.empty()) return {fault};
    const Ranking ranking = rankingOf(design.values);
    const auto n = static_cast<double>(design.values.size()), k = static_cast<double>(groups.size());
    const double scale = 1.0 - ranking.tieTerm / (n * n * n - n);
    if (scale <= 0.0) return {allEqual(design)};
    std::vector<double> sums(groups.size());
    for (std::size_t p = 0; p < design.values.size(); ++p)
        sums[design.groups[p]] += ranking.ranks[p] - 0.5 * (n + 1.0);
    double h = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g)
        h += sums[g] * sums[g] / static_cast<double>(groups[g].size());
    h *= 12.0 / (n * (n + 1.0)) / scale;
    TestLine line{design.between->name, k - 1.0, {}, h, chiSquaredUpper(h, k - 1.0), {}, {}, {},
                  design.values.size()};
    if (n > k) line.effectSize = (h - k + 1.0) / (n - k);
    return {{}, "H", "eta squared", {}, {}, {line}};
}

} // namespace physvib
