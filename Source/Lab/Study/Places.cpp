// SPDX-License-Identifier: MIT
// Fits a normal distribution per target, then evaluates one quadratic form per target and pixel.
#include "Lab/Study/Places.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace physvib {
namespace {

// A determinant below this share of the product of the variances is rounding error. A variance below this
// limit (a thousandth of the field's width, squared) is finer than a pixel and cannot be resolved.
constexpr double minDeterminantShare = 1e-9, minVariance = 1e-6;

bool canBeInverted(const PlaceNormal& n) noexcept {
    return n.varianceX >= minVariance && n.varianceY >= minVariance &&
           n.determinant() > minDeterminantShare * n.varianceX * n.varianceY;
}

struct Sums {
    double xx = 0.0, yy = 0.0, xy = 0.0;
    void add(double dx, double dy) noexcept {
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    void setVariances(PlaceNormal& n, double degreesOfFreedom) const noexcept {
        n.varianceX = xx / degreesOfFreedom;
        n.varianceY = yy / degreesOfFreedom;
        n.covariance = xy / degreesOfFreedom;
    }
};

std::string targetName(std::size_t index, std::size_t columns) {
    return "column " + std::to_string(index % columns + 1) + ", row " + std::to_string(index / columns + 1);
}

std::size_t indexOf(const LocationTrial& trial, std::size_t columns) noexcept {
    return static_cast<std::size_t>(trial.targetRow - 1) * columns +
           static_cast<std::size_t>(trial.targetColumn - 1);
}

void addMeans(const std::vector<LocationTrial>& trials, ResponseNormals& result) {
    for (const auto& trial : trials) {
        auto& normal = result.normals[indexOf(trial, result.columns)];
        ++normal.responses;
        normal.meanX += trial.x;
        normal.meanY += trial.y;
    }
    for (auto& normal : result.normals) {
        if (normal.responses == 0) continue;
        normal.meanX /= static_cast<double>(normal.responses);
        normal.meanY /= static_cast<double>(normal.responses);
    }
}

/// Computes each target's covariance, and returns the covariance pooled over all targets.
PlaceNormal findCovariances(const std::vector<LocationTrial>& trials, ResponseNormals& result) {
    std::vector<Sums> sums(result.normals.size());
    Sums all;
    for (const auto& trial : trials) {
        const std::size_t index = indexOf(trial, result.columns);
        const double dx = trial.x - result.normals[index].meanX, dy = trial.y - result.normals[index].meanY;
        sums[index].add(dx, dy);
        all.add(dx, dy);
    }
    std::size_t targets = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        auto& normal = result.normals[i];
        if (normal.responses > 0) ++targets;
        if (normal.responses > 1) sums[i].setVariances(normal, static_cast<double>(normal.responses - 1));
    }
    PlaceNormal pooled;
    if (trials.size() > targets) all.setVariances(pooled, static_cast<double>(trials.size() - targets));
    return pooled;
}

void usePooledCovariances(ResponseNormals& result, const PlaceNormal& pooled) {
    const bool canPool = canBeInverted(pooled);
    for (std::size_t i = 0; i < result.normals.size() && result.error.empty(); ++i) {
        auto& normal = result.normals[i];
        const std::string name = targetName(i, result.columns);
        if (normal.responses == 0) {
            result.warnings.push_back(name + ": no responses, so it can never be the likeliest");
        } else if (normal.responses >= 3 && canBeInverted(normal)) {
            continue;
        } else if (canPool) {
            result.warnings.push_back(name + ": " + std::to_string(normal.responses) + " responses" +
                                      (normal.responses < 3 ? "" : " on one line") +
                                      ", the condition's pooled covariance is taken");
            normal = {normal.responses, normal.meanX,      normal.meanY, pooled.varianceX,
                      pooled.varianceY, pooled.covariance, true};
        } else {
            result.error = name + ": expected three or more responses that are not on one line, and the "
                                  "condition has no pooled covariance to take instead";
        }
    }
}

/// Eq. 4.4 without its constant; everything that does not depend on the place is precomputed.
struct LogLikelihood {
    explicit LogLikelihood(const PlaceNormal& n) noexcept
        : meanX{n.meanX}
        , meanY{n.meanY} {
        if (n.responses == 0) return;
        const double d = n.determinant();
        constant = -0.5 * std::log(d);
        xx = -0.5 * n.varianceY / d;
        yy = -0.5 * n.varianceX / d;
        xy = n.covariance / d;
    }
    double at(double x, double y) const noexcept {
        const double dx = x - meanX, dy = y - meanY;
        return constant + xx * dx * dx + yy * dy * dy + xy * dx * dy;
    }
    double meanX, meanY;
    double constant = -std::numeric_limits<double>::infinity(), xx = 0.0, yy = 0.0, xy = 0.0;
};

} // namespace

ResponseNormals responseNormals(const std::vector<LocationTrial>& trials) {
    ResponseNormals result;
    if (trials.empty()) {
        result.error = "expected responses, found none";
        return result;
    }
    for (const auto& trial : trials) {
        result.rows = std::max(result.rows, static_cast<std::size_t>(trial.targetRow));
        result.columns = std::max(result.columns, static_cast<std::size_t>(trial.targetColumn));
    }
    result.normals.resize(result.rows * result.columns);
    addMeans(trials, result);
    const PlaceNormal pooled = findCovariances(trials, result);
    usePooledCovariances(result, pooled);
    return result;
}

std::vector<std::uint16_t> likelihoodMap(const ResponseNormals& normals, std::size_t width,
                                         std::size_t height) {
    const std::vector<LogLikelihood> targets(normals.normals.begin(), normals.normals.end());
    std::vector<std::uint16_t> map;
    map.reserve(width * height);
    for (std::size_t row = 0; row < height; ++row)
        for (std::size_t column = 0; column < width; ++column) {
            const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(width);
            const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(height);
            const auto likeliest =
                std::ranges::max_element(targets, {}, [=](const LogLikelihood& t) { return t.at(x, y); });
            map.push_back(static_cast<std::uint16_t>(likeliest - targets.begin()));
        }
    return map;
}

PercentCounts percentCounts(const ResponseNormals& normals, const std::vector<std::uint16_t>& map,
                            std::string condition) {
    std::vector<std::size_t> pixels(normals.normals.size());
    for (const auto target : map) ++pixels[target];
    PercentCounts counts{std::move(condition), normals.rows, normals.columns, {}};
    for (const std::size_t count : pixels)
        counts.percent.push_back(100.0 * static_cast<double>(count) / static_cast<double>(map.size()));
    return counts;
}

ConditionResolution resolveCondition(std::string condition, const std::vector<LocationTrial>& trials,
                                     double thresholdPercent) {
    ConditionResolution result{std::move(condition), responseNormals(trials), {}, {}};
    if (!result.normals.error.empty()) return result;
    result.counts = percentCounts(result.normals, likelihoodMap(result.normals), result.condition);
    result.resolution = perceptualResolution(result.counts, thresholdPercent);
    return result;
}

// Pointing errors in two passes (sums, then deviations), as pixel coordinates can be far from 0.

namespace {

/// Groups trials by key, in the order of first occurrence.
template <class KeyOf>
std::vector<std::vector<const PlaceTrial*>> groupTrials(const std::vector<PlaceTrial>& trials, KeyOf keyOf) {
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
Moments toMoments(const std::vector<const PlaceTrial*>& trials, Value value) {
    std::vector<double> values;
    for (const PlaceTrial* trial : trials) values.push_back(std::invoke(value, *trial));
    return Moments{values};
}

TargetError computeError(const std::vector<const PlaceTrial*>& trials) {
    const Moments dx = toMoments(trials, [](const PlaceTrial&t) { return t.x - t.trueX; }),
                  dy = toMoments(trials, [](const PlaceTrial&t) { return t.y - t.trueY; });
    return {
        trials.front()->participant,
        trials.front()->target,
        trials.size(),
        toMoments(trials, &PlaceTrial::trueX).mean,
        toMoments(trials, &PlaceTrial::trueY).mean,
        dx.mean,
        dy.mean,
        std::hypot(dx.deviation, dy.deviation),
        toMoments(trials, [](const PlaceTrial& t) { return std::hypot(t.x - t.trueX, t.y - t.trueY); }).mean};
}

/// Least-squares slope; nullopt if all true places are equal, but for rounding.
std::optional<double> slope(const std::vector<const PlaceTrial*>& trials, double PlaceTrial::*truth,
                            double PlaceTrial::*answer) {
    const double meanTrue = toMoments(trials, truth).mean, meanAnswer = toMoments(trials, answer).mean;
    double squares = 0.0, products = 0.0, trueSquares = 0.0;
    for (const PlaceTrial* t : trials)
        trueSquares += t->*truth * t->*truth, squares += (t->*truth - meanTrue) * (t->*truth - meanTrue),
            products += (t->*truth - meanTrue) * (t->*answer - meanAnswer);
    return squares > 1e-24 * trueSquares ? std::optional{products / squares} : std::nullopt;
}

} // namespace

std::vector<TargetError> targetErrors(const std::vector<PlaceTrial>& trials) {
    std::vector<TargetError> errors;
    if (trials.empty()) return errors;
    for (const auto& group : groupTrials(trials, [](const PlaceTrial& t) {
             return std::pair{t.participant, t.target};
         }))
        errors.push_back(computeError(group));
    return errors;
}

std::vector<ParticipantError> participantErrors(const std::vector<PlaceTrial>& trials) {
    std::vector<ParticipantError> people;
    if (trials.empty()) return people;
    const std::vector<TargetError> targets = targetErrors(trials);
    for (const auto& group : groupTrials(trials, [](const PlaceTrial& t) { return t.participant; })) {
        ParticipantError error{.participant = group.front()->participant, .trials = group.size()};
        std::size_t repeatedTargets = 0;
        for (const TargetError& target : targets) {
            if (target.participant != error.participant) continue;
            ++error.targets;
            error.constantX += target.constantX, error.constantY += target.constantY,
                error.distance += target.distance;
            if (target.trials > 1) ++repeatedTargets, error.variable += target.variable;
        }
        const auto count = static_cast<double>(error.targets);
        error.constantX /= count, error.constantY /= count, error.distance /= count;
        if (repeatedTargets > 0)
            error.variable /= static_cast<double>(repeatedTargets), error.hasVariable = true;
        if (const auto gain = slope(group, &PlaceTrial::trueX, &PlaceTrial::x))
            error.gainX = *gain, error.hasGainX = true;
        if (const auto gain = slope(group, &PlaceTrial::trueY, &PlaceTrial::y))
            error.gainY = *gain, error.hasGainY = true;
        people.push_back(std::move(error));
    }
    return people;
}

} // namespace physvib
