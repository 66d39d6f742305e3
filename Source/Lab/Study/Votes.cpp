// SPDX-License-Identifier: MIT
// Summarises forced choices and ratings: groups by name, means, medians and intervals.
#include "Lab/Study/Votes.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Study/Proportion.h"
#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace physvib {
namespace {

/// The factors in a condition's name: "size=small" of "pair=wood size=small".
std::vector<std::string> factorsOf(const std::string& condition) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < condition.size();) {
        const std::size_t to = std::min(condition.find(' ', from), condition.size());
        if (std::string part = condition.substr(from, to - from); part.find('=') != std::string::npos)
            parts.push_back(std::move(part));
        from = to + 1;
    }
    return parts;
}

ChoiceShare shareOf(const std::string& alternative, std::uint64_t hits, std::uint64_t trials,
                    const std::vector<double>& shares) {
    const Moments moments{shares};
    const Proportion pooled = proportion(hits, trials);
    ChoiceShare share{alternative, hits, moments.mean, pooled.least, pooled.most, median(shares)};
    if (shares.size() < 2) return share;
    share.least = std::max(0.0, moments.mean - moments.halfInterval());
    share.most = std::min(1.0, moments.mean + moments.halfInterval());
    return share;
}

ChoiceSummary summarise(const std::string& condition, const std::vector<const ChoiceTrial*>& trials,
                        const std::set<std::string>& alternatives) {
    std::map<std::string, std::map<std::string, std::uint64_t>> votes; // by participant and alternative
    std::map<std::string, std::uint64_t> totals, trialsOf;
    for (const auto* trial : trials) {
        ++votes[trial->participant][trial->choice];
        ++totals[trial->choice];
        ++trialsOf[trial->participant];
    }
    ChoiceSummary summary{condition, votes.size(), trials.size(), {}};
    for (const auto& alternative : alternatives) {
        std::vector<double> shares;
        for (auto& [participant, own] : votes)
            shares.push_back(static_cast<double>(own[alternative]) /
                             static_cast<double>(trialsOf[participant]));
        summary.shares.push_back(shareOf(alternative, totals[alternative], trials.size(), shares));
    }
    return summary;
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
        summary.halfIntervals.push_back(Moments(means.size() > 1 ? means : scores).halfInterval());
    }
    return summary;
}

// The parts of the thesis' method names, e.g. AV-FF-DRV (5.3).
constexpr std::array<std::array<const char*, 2>, 3> methodParts{{{"AV", "AF"}, {"FV", "FF"}, {"DRV", "DRF"}}};

bool hasPart(const std::string& name, std::string part) {
    return ("-" + name + "-").find("-" + part + "-") != std::string::npos;
}

bool isMethod(const std::string& name) {
    return std::ranges::all_of(
        methodParts, [&](const auto& parts) { return hasPart(name, parts[0]) != hasPart(name, parts[1]); });
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
    for (const auto& [condition, own] : conditions)
        summaries.push_back(summarise(condition, own, alternatives));
    return summaries;
}

std::vector<RatingSummary> summariseRatings(const std::vector<RatingTrial>& trials) {
    std::map<std::string, Chosen> conditions;
    for (const auto& trial : trials) conditions[trial.condition].push_back(&trial);
    std::vector<RatingSummary> summaries;
    for (const auto& [condition, own] : conditions) summaries.push_back(summarise(condition, own));
    if (conditions.size() < 2 ||
        !std::ranges::all_of(conditions, isMethod, [](const auto& c) { return c.first; }))
        return summaries;
    for (const auto& parts : methodParts)
        for (const char* part : parts) {
            Chosen chosen;
            for (const auto& trial : trials)
                if (hasPart(trial.condition, part)) chosen.push_back(&trial);
            if (!chosen.empty()) summaries.push_back(summarise(part, chosen));
        }
    return summaries;
}

} // namespace physvib
