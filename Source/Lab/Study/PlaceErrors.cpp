// SPDX-License-Identifier: MIT
// Computes pointing errors in two passes (sums, then deviations), because pixel coordinates can be far from
// 0.
#include "Lab/Study/PlaceErrors.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace physvib {
namespace {

/// Groups trials by key, in the order of first occurrence.
template <class KeyOf>
std::vector<std::vector<const PlaceTrial*>> groupedBy(const std::vector<PlaceTrial>& trials, KeyOf keyOf) {
    std::map<decltype(keyOf(trials.front())), std::size_t> indices;
    std::vector<std::vector<const PlaceTrial*>> groups;
    for (const PlaceTrial& trial : trials) {
        const auto [found, isNew] = indices.emplace(keyOf(trial), groups.size());
        if (isNew) groups.emplace_back();
        groups[found->second].push_back(&trial);
    }
    return groups;
}

template <class Value>
Moments momentsOf(const std::vector<const PlaceTrial*>& trials, Value value) {
    std::vector<double> values;
    for (const PlaceTrial* trial : trials) values.push_back(value(*trial));
    return Moments{values};
}

TargetError errorOf(const std::vector<const PlaceTrial*>& trials) {
    const Moments dx = momentsOf(trials, [](const PlaceTrial&t) { return t.x - t.trueX; }),
                  dy = momentsOf(trials, [](const PlaceTrial&t) { return t.y - t.trueY; });
    return {
        trials.front()->participant,
        trials.front()->target,
        trials.size(),
        momentsOf(trials, [](const PlaceTrial& t) { return t.trueX; }).mean,
        momentsOf(trials, [](const PlaceTrial& t) { return t.trueY; }).mean,
        dx.mean,
        dy.mean,
        std::hypot(dx.deviation, dy.deviation),
        momentsOf(trials, [](const PlaceTrial& t) { return std::hypot(t.x - t.trueX, t.y - t.trueY); }).mean};
}

/// Least-squares slope; nullopt if all true places are equal.
std::optional<double> slope(const std::vector<const PlaceTrial*>& trials, double PlaceTrial::*truth,
                            double PlaceTrial::*answer) {
    const double meanTrue = momentsOf(trials, [=](const PlaceTrial&t) { return t.*truth; }).mean,
                 meanAnswer = momentsOf(trials, [=](const PlaceTrial&t) { return t.*answer; }).mean;
    double squares = 0.0, products = 0.0;
    for (const PlaceTrial* t : trials)
        squares += (t->*truth - meanTrue) * (t->*truth - meanTrue),
            products += (t->*truth - meanTrue) * (t->*answer - meanAnswer);
    return squares > 0.0 ? std::optional{products / squares} : std::nullopt;
}

} // namespace

std::vector<TargetError> targetErrors(const std::vector<PlaceTrial>& trials) {
    std::vector<TargetError> errors;
    if (trials.empty()) return errors;
    for (const auto& group : groupedBy(trials, [](const PlaceTrial& t) {
             return std::pair{t.participant, t.target};
         }))
        errors.push_back(errorOf(group));
    return errors;
}

std::vector<ParticipantError> participantErrors(const std::vector<PlaceTrial>& trials) {
    std::vector<ParticipantError> people;
    if (trials.empty()) return people;
    const std::vector<TargetError> targets = targetErrors(trials);
    for (const auto& group : groupedBy(trials, [](const PlaceTrial& t) { return t.participant; })) {
        ParticipantError one{.participant = group.front()->participant, .trials = group.size()};
        std::size_t repeated = 0;
        for (const TargetError& target : targets) {
            if (target.participant != one.participant) continue;
            ++one.targets;
            one.constantX += target.constantX, one.constantY += target.constantY,
                one.distance += target.distance;
            if (target.trials > 1) ++repeated, one.variable += target.variable;
        }
        const auto count = static_cast<double>(one.targets);
        one.constantX /= count, one.constantY /= count, one.distance /= count;
        if (repeated > 0) one.variable /= static_cast<double>(repeated), one.hasVariable = true;
        if (const auto gain = slope(group, &PlaceTrial::trueX, &PlaceTrial::x))
            one.gainX = *gain, one.hasGainX = true;
        if (const auto gain = slope(group, &PlaceTrial::trueY, &PlaceTrial::y))
            one.gainY = *gain, one.hasGainY = true;
        people.push_back(std::move(one));
    }
    return people;
}

} // namespace physvib
