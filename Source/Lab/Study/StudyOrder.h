// SPDX-License-Identifier: MIT
// Orders of conditions and trials: balanced by Latin squares, or random from the seed.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Stimuli/SeededRandom.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Row `row` of a balanced Latin square (Williams 1949) over 0 to count - 1. Within `count` rows (twice as
/// many if `count` is odd) each item has each position, and follows each other item, equally often. Any
/// thread (allocates).
std::vector<std::size_t> latinSquareRow(std::size_t count, std::size_t row);

/// Conditions in the order of participant `number` (from 1). Groups use one square, conditions within a group
/// another. Any thread (allocates).
std::vector<std::size_t> conditionOrder(const Protocol& protocol, int number);

/// A trial of a planned order: its stimulus, and whether its two alternatives are swapped.
struct PlannedTrial {
    std::size_t stimulus = 0;
    bool isSwapped = false;
};

/// All trials of a session with fixed levels. Any thread (allocates).
std::vector<PlannedTrial> sessionOrder(const SessionPlan& session, std::size_t stimuli, SeededRandom& random);

} // namespace physvib
