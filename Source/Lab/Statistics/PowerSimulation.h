// SPDX-License-Identifier: MIT
// Statistical power by simulation: how often a study with a given number of participants detects a true
// difference.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace physvib {

/// Within-participant comparison of two conditions with normal differences. Seed 1: identical results on
/// every machine.
class PairedPower {
public:
    static constexpr int studies = 2000;

    /// `participants` >= 2. Any thread (allocates).
    explicit PairedPower(std::size_t participants);

    /// Share of studies in which a paired t test at `alpha` finds a mean difference of `effect` standard
    /// deviations of the differences. Any thread.
    double at(double effect, double alpha) const;

    /// The smallest detectable effect in steps of 0.01 up to 5; nullopt if the power at 5 is below `power`.
    /// Any thread.
    std::optional<double> smallestEffect(double power, double alpha) const;

private:
    struct Sample {
        double mean, error; ///< mean of the differences without an effect, and its standard error
    };
    std::size_t participants_;
    std::vector<Sample> samples_;
};

/// Forced choices between two alternatives: every participant has the same true share of one.
class SharePower {
public:
    static constexpr int studies = 500;

    SharePower(std::size_t participants, std::size_t trials) noexcept
        : participants_{participants}
        , trials_{trials} {}

    /// Share of studies in which a signed-rank test of the participants' shares against one half has p <
    /// 0.05. Any thread (allocates).
    double at(double share) const;

    /// The smallest detectable share above one half in steps of 1 % up to 95 %; nullopt if even that has less
    /// power. Any thread (allocates).
    std::optional<double> smallestShare(double power) const;

private:
    std::size_t participants_, trials_;
};

} // namespace physvib
