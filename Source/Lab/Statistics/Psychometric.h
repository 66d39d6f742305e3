// SPDX-License-Identifier: MIT
// Psychometric functions: probability of an answer as a function of level, fitted to trials by maximum
// likelihood.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

enum class PsychometricShape {
    logistic,
    normal, ///< cumulative normal
    weibull ///< for levels in dB or another logarithm (Gumbel's function of the level)
};

inline constexpr std::array<std::string_view, 3> psychometricShapeNames{"logistic", "normal", "weibull"};

constexpr double mostLapse = 0.1; // maximum plausible lapse rate

/// Model choices, made before the fit.
struct PsychometricModel {
    PsychometricShape shape = PsychometricShape::logistic;
    double guess = 0.5;           ///< 1 / alternatives of a forced choice; 0: answers yes and no
    double lapseUpTo = mostLapse; ///< upper bound of the fitted lapse rate
    bool operator==(const PsychometricModel&) const = default;
};

/// guess + (1 - guess - lapse) F(level), where F is 0.5 at the threshold and rises from 0.05 to 0.95 within
/// the width.
struct PsychometricFunction {
    PsychometricShape shape = PsychometricShape::logistic;
    double threshold = 0.0, width = 1.0; ///< in the unit of the levels; width > 0
    double guess = 0.0, lapse = 0.0;     ///< guess: 1 / alternatives of a forced choice

    /// Any thread.
    double probability(double level) const noexcept;
    double levelOf(double probability) const; ///< inverse function, for a probability between guess and 1 -
                                              ///< lapse
    /// Just noticeable difference: half the distance from F = 0.25 to F = 0.75.
    double jnd() const noexcept;
};

/// Trials at one level.
struct LevelCount {
    double level = 0.0;
    std::uint64_t hits = 0, trials = 0;
};

/// Natural logarithm of the probability of the answers. A probability of 0 or 1 counts as 1e-12 away from it.
/// Any thread.
double logLikelihood(std::span<const LevelCount> counts, const PsychometricFunction& function);

struct PsychometricFit {
    std::string fault; ///< error in one line; if set, the rest is invalid
    PsychometricFunction function{};
    double logLikelihood = 0.0;
};

/// Maximum-likelihood fit. Errors: fewer than two levels, or answers that do not change with the level. Any
/// thread (allocates).
PsychometricFit fitPsychometric(std::span<const LevelCount> counts, const PsychometricModel& model);

} // namespace physvib
