// SPDX-License-Identifier: MIT
// Grouping by name; means, medians and intervals.
#include "Study/Votes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace physvib {
namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// "size=small" of "pair=wood size=small": the factors of a condition's name.
std::vector<std::string> factorsOf(const std::string& condition) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < condition.size();) {
        const std::size_t to = std::min(condition.find(' ', from), condition.size());
        if (std::string part = condition.substr(from, to - from); part.find('=') != std::string::npos) parts.push_back(std::move(part));
        from = to + 1;
    }
    return parts;
}

ChoiceSummary summarise(const std::string& condition, const std::vector<const ChoiceTrial*>& trials, const std::set<std::string>& alternatives) {
    std::map<std::string, std::map<std::string, std::uint64_t>> votes; // by participant and alternative
    std::map<std::string, std::uint64_t> totals;
    for (const auto* trial : trials) {
        ++votes[trial->participant][trial->choice];
        ++totals[trial->choice];
    }
    ChoiceSummary summary{condition, votes.size(), {}, 1.0};
    for (const auto& alternative : alternatives) {
        std::vector<double> shares;
        for (auto& [participant, own] : votes) {
            std::uint64_t all = 0;
            for (const auto& vote : own) all += vote.second;
            shares.push_back(static_cast<double>(own[alternative]) / static_cast<double>(all));
        }
        summary.shares.push_back({alternative, proportion(totals[alternative], trials.size()), median(std::move(shares))});
    }
    if (alternatives.size() == 2) summary.pByChance = signTestP(summary.shares[0].votes.hits, trials.size());
    return summary;
}

struct Moments {
    double mean = 0.0, deviation = 0.0;
    explicit Moments(const std::vector<double>& values) {
        for (const double v : values) mean += v / static_cast<double>(values.size());
        for (const double v : values) deviation += (v - mean) * (v - mean);
        deviation = values.size() > 1 ? std::sqrt(deviation / static_cast<double>(values.size() - 1)) : 0.0;
    }
};

double halfInterval(const std::vector<double>& values) {
    if (values.size() < 2) return 0.0;
    return studentPoint(values.size() - 1) * Moments(values).deviation / std::sqrt(static_cast<double>(values.size()));
}

using Chosen = std::vector<const RatingTrial*>;

std::vector<double> participantMeans(const Chosen& trials, std::size_t scale) {
    std::map<std::string, std::vector<double>> scores;
    for (const auto* trial : trials) scores[trial->participant].push_back(trial->scores[scale]);
    std::vector<double> means;
    for (const auto& [participant, own] : scores) means.push_back(Moments(own).mean);
    return means;
}

RatingSummary summarise(const std::string& condition, const Chosen& trials) {
    RatingSummary summary{condition, trials.size(), 0, {}, {}, {}};
    for (std::size_t scale = 0; scale < trials.front()->scores.size(); ++scale) {
        std::vector<double> scores;
        for (const auto* trial : trials) scores.push_back(trial->scores[scale]);
        const Moments moments{scores};
        const auto means = participantMeans(trials, scale);
        summary.participants = means.size();
        summary.means.push_back(moments.mean);
        summary.deviations.push_back(moments.deviation);
        summary.halfIntervals.push_back(halfInterval(means.size() > 1 ? means : scores));
    }
    return summary;
}

// The parts of the thesis' method names, e.g. AV-FF-DRV (5.3).
constexpr std::array<std::array<const char*, 2>, 3> methodParts{{{"AV", "AF"}, {"FV", "FF"}, {"DRV", "DRF"}}};

bool hasPart(const std::string& name, std::string part) {
    return ("-" + name + "-").find("-" + part + "-") != std::string::npos;
}

bool isMethod(const std::string& name) {
    return std::ranges::all_of(methodParts, [&](const auto& parts) { return hasPart(name, parts[0]) != hasPart(name, parts[1]); });
}

} // namespace

std::vector<ChoiceSummary> summariseChoices(const std::vector<ChoiceTrial>& trials) {
    std::map<std::string, std::vector<const ChoiceTrial*>> conditions;
    std::vector<const ChoiceTrial*> all;
    std::set<std::string> alternatives;
    for (const auto& trial : trials) {
        conditions[trial.condition].push_back(&trial);
        all.push_back(&trial);
        alternatives.insert(trial.choice);
    }
    std::vector<ChoiceSummary> summaries;
    if (all.empty()) return summaries;
    summaries.push_back(summarise("all", all, alternatives));
    if (conditions.size() < 2) return summaries;
    std::map<std::string, std::vector<const ChoiceTrial*>> factors;
    for (const auto* trial : all)
        for (const auto& factor : factorsOf(trial->condition)) factors[factor].push_back(trial);
    for (const auto& [factor, own] : factors)
        if (!conditions.contains(factor)) summaries.push_back(summarise(factor, own, alternatives));
    for (const auto& [condition, own] : conditions) summaries.push_back(summarise(condition, own, alternatives));
    return summaries;
}

std::vector<RatingSummary> summariseRatings(const std::vector<RatingTrial>& trials) {
    std::map<std::string, Chosen> conditions;
    for (const auto& trial : trials) conditions[trial.condition].push_back(&trial);
    std::vector<RatingSummary> summaries;
    for (const auto& [condition, own] : conditions) summaries.push_back(summarise(condition, own));
    if (conditions.size() < 2 || !std::ranges::all_of(conditions, isMethod, [](const auto& c) { return c.first; })) return summaries;
    for (const auto& parts : methodParts)
        for (const char* part : parts) {
            Chosen chosen;
            for (const auto& trial : trials)
                if (hasPart(trial.condition, part)) chosen.push_back(&trial);
            if (!chosen.empty()) summaries.push_back(summarise(part, chosen));
        }
    return summaries;
}

double studentPoint(std::size_t degreesOfFreedom) noexcept {
    constexpr std::array small{12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281};
    if (degreesOfFreedom <= small.size()) return small[degreesOfFreedom - 1];
    // Cornish-Fisher expansion (Hill 1970); at most 1.3e-4 off from eleven degrees of freedom on.
    constexpr double z = 1.959963984540054;
    const auto n = static_cast<double>(degreesOfFreedom);
    const double g1 = (z * z * z + z) / 4.0, g2 = (5.0 * std::pow(z, 5) + 16.0 * z * z * z + 3.0 * z) / 96.0;
    const double g3 = (3.0 * std::pow(z, 7) + 19.0 * std::pow(z, 5) + 17.0 * z * z * z - 15.0 * z) / 384.0;
    return z + g1 / n + g2 / (n * n) + g3 / (n * n * n);
}

} // namespace physvib
