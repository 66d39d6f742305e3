// SPDX-License-Identifier: MIT
// Forced choices and slider ratings, summed up by condition (thesis 5.2, 5.3).
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// One forced choice: what was chosen, in which condition, by whom (may be empty).
struct ChoiceTrial {
    std::string participant, condition, choice;
};

/// How often an alternative was chosen: the unit is the participant, whose trials are one share.
struct ChoiceShare {
    std::string alternative;
    std::uint64_t hits = 0;
    double share = 0.0;             ///< mean of the participants' own shares
    double least = 0.0, most = 1.0; ///< 95 %: t over participants, within 0 and 1; of one (or unknown)
                                    ///< participants Wilson's, over trials
    double median = 0.0;            ///< of the participants' own shares
};

struct ChoiceSummary {
    std::string condition; ///< "all": every trial
    std::size_t participants = 0;
    std::uint64_t trials = 0;
    std::vector<ChoiceShare> shares; ///< by name of the alternative
    std::optional<double> p; ///< of two alternatives: signed ranks of the participants' shares against one
                             ///< half; none of one participant, or if all share equally
};

/// All trials together; then, if there are several conditions, each factor of names like "pair=wood
/// size=small", and each condition, by name. Any thread (allocates).
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
    std::vector<double> halfIntervals; ///< 95 %: t over participants' means; over trials if participants are
                                       ///< unknown; 0 for one
};

/// Each condition by name, then, if every condition's name has the parts AV/AF, FV/FF, DRV/DRF of the thesis'
/// methods, each of these parts. Every trial has as many scores. Any thread (allocates).
std::vector<RatingSummary> summariseRatings(const std::vector<RatingTrial>& trials);

} // namespace physvib
