// SPDX-License-Identifier: MIT
// How often a study of so many participants finds a difference that is there, by simulated studies.
#pragma once
#include "Lab/Statistics/Distributions.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Statistics/RankTests.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace physvib {

/// Two conditions, each participant in both, normal differences. Seed 1: the same numbers on every machine.
class PairedPower {
public:
    static constexpr int studies = 2000;

    /// `participants` >= 2. Any thread (allocates).
    explicit PairedPower(std::size_t participants)
        : participants_{participants} {
        SeededRandom random{1, "paired power"};
        std::vector<double> differences(participants);
        samples_.reserve(studies);
        for (int study = 0; study < studies; ++study) {
            std::ranges::generate(differences, [&] { return random.normal(); });
            const Moments moments{differences};
            samples_.push_back({moments.mean, moments.standardError()});
        }
    }

    /// Share of studies in which a paired t test at `alpha` finds a mean difference of `effect` standard
    /// deviations of the differences. Any thread.
    double at(double effect, double alpha) const {
        const double critical = studentQuantile(1.0 - 0.5 * alpha, static_cast<double>(participants_ - 1));
        const auto found = std::ranges::count_if(samples_, [&](const Sample& sample) {
            return std::abs(sample.mean + effect) > critical * sample.error;
        });
        return static_cast<double>(found) / static_cast<double>(samples_.size());
    }

    /// The smallest such effect, in steps of 0.01 up to 5; none if even that is found less often than
    /// `power`. Any thread.
    std::optional<double> smallestEffect(double power, double alpha) const {
        for (int hundredths = 1; hundredths <= 500; ++hundredths)
            if (at(0.01 * hundredths, alpha) >= power) return 0.01 * hundredths;
        return std::nullopt;
    }

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
    double at(double share) const {
        SeededRandom random{1, "share power"};
        int found = 0;
        std::vector<double> leads(participants_);
        for (int study = 0; study < studies; ++study) {
            for (double& lead : leads) {
                std::size_t hits = 0;
                for (std::size_t trial = 0; trial < trials_; ++trial) hits += random.chance(share) ? 1 : 0;
                lead = (2.0 * static_cast<double>(hits) - static_cast<double>(trials_)) /
                       static_cast<double>(trials_);
            }
            const TestLine line = signedRank(leads);
            found += line.p && *line.p < 0.05 ? 1 : 0;
        }
        return static_cast<double>(found) / studies;
    }

    /// The smallest share above one half, in steps of 1 % up to 95 %; none if even that is found less often.
    /// Any thread (allocates).
    std::optional<double> smallestShare(double power) const {
        int low = 50, high = 95; // it grows with the share
        if (at(0.01 * high) < power) return std::nullopt;
        while (high - low > 1) {
            const int middle = (low + high) / 2;
            (at(0.01 * middle) >= power ? high : low) = middle;
        }
        return 0.01 * high;
    }

private:
    std::size_t participants_, trials_;
};

} // namespace physvib
