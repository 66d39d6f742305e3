// SPDX-License-Identifier: MIT
// How often a study of so many participants finds a difference that is there, by simulated studies.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace physvib {

/// Two conditions, each participant in both, normal differences. Seed 1: the same numbers on every machine.
class PairedPower {
public:
    static constexpr int studies = 2000;

    /// `participants` >= 2. Any thread (allocates).
    explicit PairedPower(std::size_t participants);

    /// Share of studies in which a paired t test at `alpha` finds a mean difference of `effect` standard
    /// deviations of the differences. Any thread.
    double at(double effect, double alpha) const;

    /// The smallest such effect, in steps of 0.01 up to 5; none if even that is found less often than
    /// `power`. Any thread.
    std::optional<double> smallestEffect(double power, double alpha) const;

private:
    struct Sample {
        double mean, error; ///< of the differences around 0; standard error of the mean
    };
    std::size_t participants_;
    std::vector<Sample> samples_;
};

/// Forced choices between two: every participant has the same true share of one alternative.
class SharePower {
public:
    static constexpr int studies = 500;

    SharePower(std::size_t participants, std::size_t trials) noexcept
        : participants_{participants}
        , trials_{trials} {}

    /// Share of studies in which signed ranks of the participants' shares against one half have p < 0.05. Any
    /// thread (allocates).
    double at(double share) const;

    /// The smallest share above one half, in steps of 1 % up to 95 %; none if even that is found less often.
    /// Any thread (allocates).
    std::optional<double> smallestShare(double power) const;

private:
    std::size_t participants_, trials_;
};

} // namespace physvib
