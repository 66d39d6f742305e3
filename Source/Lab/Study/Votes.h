// SPDX-License-Identifier: MIT
// Summaries of forced choices and slider ratings by condition (thesis 5.2, 5.3).
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// One forced choice: alternative, condition and participant (which may be empty).
struct ChoiceTrial {
    std::string participant, condition, choice;
};

/// How often an alternative was chosen. The unit is the participant, whose trials give one share.
struct ChoiceShare {
    std::string alternative;
    std::uint64_t hits = 0;
    double share = 0.0;             ///< mean of the participants' shares
    double least = 0.0, most = 1.0; ///< 95 %: t interval over participants, within 0 and 1; for one or
                                    ///< unknown participants Wilson's over trials
    double median = 0.0;            ///< of the participants' shares
};

struct ChoiceSummary {
    std::string condition; ///< "all": all conditions together
    std::size_t participants = 0;
    std::uint64_t trials = 0;
    std::vector<ChoiceShare> shares; ///< by name of the alternative
};

/// First all trials together. With several conditions, then each factor of names like "pair=wood size=small"
/// and each condition, sorted by name. Any thread (allocates).
std::vector<ChoiceSummary> summariseChoices(const std::vector<ChoiceTrial>& trials);

/// One rating trial: a score per scale.
struct RatingTrial {
    std::string participant, condition;
    std::vector<double> scores;
};

struct RatingSummary {
    std::string condition;
    std::size_t trials = 0, participants = 0;
    std::vector<double> means, deviations; ///< per scale: over trials; sample standard deviation, 0 for one
                                           ///< trial
    std::vector<double> halfIntervals;     ///< 95 %: t interval over participants' means, or over trials if
                                           ///< participants are unknown; 0 for one value
};

/// Each condition by name. If every condition's name has the parts AV/AF, FV/FF, DRV/DRF of the thesis'
/// methods, then also each part. Precondition: every trial has the same number of scores. Any thread
/// (allocates).
std::vector<RatingSummary> summariseRatings(const std::vector<RatingTrial>& trials);

} // namespace physvib
