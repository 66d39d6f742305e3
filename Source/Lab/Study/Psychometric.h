// SPDX-License-Identifier: MIT
// Functions fitted to each participant's trials: psychometric functions (probability of an answer by level,
// by maximum likelihood) and Stevens' power law.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {
enum class PsychometricShape {
    logistic,
    normal, ///< cumulative normal
    weibull ///< for levels in dB or another logarithm (Gumbel's function of the level)
};

inline constexpr std::array<std::string_view, 3> psychometricShapeNames{"logistic", "normal", "weibull"};

/// guess + (1 - guess - lapse) F(level), where F is 0.5 at the threshold, from 0.05 to 0.95 within the width.
struct PsychometricFunction {
    PsychometricShape shape = PsychometricShape::logistic;
    double threshold = 0.0, width = 1.0; ///< in the unit of the levels; width > 0
    double guess = 0.0, lapse = 0.0;     ///< guess: 1 / alternatives of a forced choice, else the lapse rate

    /// Probability of the answer at that level. Any thread.
    double probability(double level) const noexcept;
    double levelAt(double probability) const; ///< inverse, for one between guess and 1 - lapse
    /// Just noticeable difference: half the distance from F = 0.25 to F = 0.75.
    double jnd() const noexcept;
};

constexpr double maxLapseRate = 0.1;           // maximum plausible lapse rate
constexpr double maxSymmetricLapseRate = 0.02; // of equal lapse rates at both ends: a higher bound biases the
                                               // width

/// Model choices, made before the fit.
struct PsychometricModel {
    PsychometricShape shape = PsychometricShape::logistic;
    double guess = 0.5;                   ///< 1 / alternatives of a forced choice; 0: answers yes and no
    double lapseRateBound = maxLapseRate; ///< upper bound of the fitted lapse rate
    bool operator==(const PsychometricModel&) const = default;

    /// Yes/no answers (guess 0) have two equal lapse rates: one alone shifts the threshold. Any thread.
    PsychometricFunction functionWith(double threshold, double width, double lapse) const noexcept {
        return {shape, threshold, width, guess > 0.0 ? guess : lapse, lapse};
    }
    double maxFittedLapseRate() const noexcept {
        return guess > 0.0 ? lapseRateBound : std::fmin(lapseRateBound, maxSymmetricLapseRate);
    }
};

/// Trials at one level.
struct LevelCount {
    double level = 0.0;
    std::uint64_t hits = 0, trials = 0;
};

/// Counts trials and hits by rising level; `levelAndHit(trial)` returns the level and whether it is a hit.
/// Any thread.
template <class Trials, class LevelAndHit>
std::vector<LevelCount> countByLevel(const Trials& trials, LevelAndHit levelAndHit) {
    std::map<double, LevelCount> counts;
    for (const auto& trial : trials) {
        const std::pair<double, bool> answer = levelAndHit(trial);
        LevelCount& count = counts.try_emplace(answer.first, LevelCount{answer.first}).first->second;
        ++count.trials;
        count.hits += answer.second;
    }
    std::vector<LevelCount> all;
    for (const auto& [level, count] : counts) all.push_back(count);
    return all;
}

/// Natural logarithm of the answers' probability; functions are limited to 1e-12 from 0 and 1. Any thread.
double logLikelihood(std::span<const LevelCount> counts, const PsychometricFunction& function);

struct PsychometricFit {
    std::string error; ///< error in one line; if set, the rest is invalid
    PsychometricFunction function{};
    double logLikelihood = 0.0;
    bool hasJnd = false;                        ///< false: the width and the JND are invalid
    std::pair<double, double> stepThresholds{}; ///< without a JND: lowest and highest threshold of equal fit
};

/// Maximum-likelihood fit; `counts` by rising levels. Errors: fewer than two levels, answers that do not rise
/// with the level, a width at the bound of the search (20 times the levels' range), a threshold outside the
/// levels. A step has no width. Any thread (allocates).
PsychometricFit fitPsychometric(std::span<const LevelCount> counts, const PsychometricModel& model);

/// A participant's answer at a level: 1 or 0, or a magnitude.
struct LevelAnswer {
    std::string participant;
    double level = 0.0, answer = 0.0;
    /// Level and answer, as countByLevel() needs them.
    std::pair<double, bool> levelAndHit() const noexcept { return {level, answer > 0.5}; }
};

// Stevens' power law, magnitude = factor * level^exponent, fitted by least squares of logarithms.

struct PowerLaw {
    std::string error; ///< error in one line; if set, the rest is invalid
    double exponent = 0.0, factor = 1.0;
    double rSquared = 0.0; ///< r squared of the regression of logarithms
};

/// Fits one participant's trials, of magnitudes at linear levels (g, not dB). Average exponents over
/// participants, but not factors, since each participant chooses the scale. Any thread.
inline PowerLaw fitPowerLaw(std::span<const LevelAnswer> trials) {
    const auto n = static_cast<double>(trials.size());
    double meanX = 0.0, meanY = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (const auto& trial : trials) {
        if (!(trial.level > 0.0) || !(trial.answer > 0.0)) return {"expected levels and magnitudes > 0"};
        meanX += std::log(trial.level) / n;
        meanY += std::log(trial.answer) / n;
    }
    for (const auto& trial : trials) {
        const double x = std::log(trial.level) - meanX, y = std::log(trial.answer) - meanY;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    if (!(xx > 1e-18)) return {"expected magnitudes of two or more levels"};
    const double exponent = xy / xx;
    return {{}, exponent, std::exp(meanY - exponent * meanX), yy > 0.0 ? xy * xy / (xx * yy) : 1.0};
}

/// A fit to one participant's trials.
template <class Fit>
struct ParticipantFit {
    std::string participant;
    std::size_t trials = 0;
    Fit fit;
};

// One result per participant, in the order of first trials. Any thread (allocates).
std::vector<ParticipantFit<PsychometricFit>> psychometricByParticipant(const std::vector<LevelAnswer>& trials,
                                                                       const PsychometricModel& model);
std::vector<ParticipantFit<PowerLaw>> powerLawByParticipant(const std::vector<LevelAnswer>& trials);

} // namespace physvib
