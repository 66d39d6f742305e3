// SPDX-License-Identifier: MIT
// Reuses the same random samples for every effect, so that power never decreases with the effect.
#include "Lab/Statistics/PowerSimulation.h"
#include "Lab/Statistics/Distributions.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Statistics/RankTests.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <cmath>

namespace physvib {

PairedPower::PairedPower(std::size_t participants)
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

double PairedPower::at(double effect, double alpha) const {
    const double critical = studentQuantile(1.0 - 0.5 * alpha, static_cast<double>(participants_ - 1));
    const auto found = std::ranges::count_if(samples_, [&](const Sample& sample) {
        return std::abs(sample.mean + effect) > critical * sample.error;
    });
    return static_cast<double>(found) / static_cast<double>(samples_.size());
}

std::optional<double> PairedPower::smallestEffect(double power, double alpha) const {
    for (int hundredths = 1; hundredths <= 500; ++hundredths)
        if (at(0.01 * hundredths, alpha) >= power) return 0.01 * hundredths;
    return std::nullopt;
}

double SharePower::at(double share) const {
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

std::optional<double> SharePower::smallestShare(double power) const {
    int low = 50, high = 95; // power increases with the share
    if (at(0.01 * high) < power) return std::nullopt;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (at(0.01 * middle) >= power ? high : low) = middle;
    }
    return 0.01 * high;
}

} // namespace physvib
