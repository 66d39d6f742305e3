// SPDX-License-Identifier: MIT
// Orders of conditions and trials: balanced by Latin squares, or random by seed.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Stimuli/SeededRandom.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Row `row` of a balanced Latin square (Williams 1949) over 0 to count - 1. Over `count` rows (twice as many
/// if it is odd) every item is in every position, and follows every other one, equally often. Any thread
/// (allocates).
std::vector<std::size_t> latinSquareRow(std::size_t count, std::size_t row);

/// The conditions in the order of participant `number` (from 1): groups by one square, conditions within a
/// group by another. Any thread (allocates).
std::vector<std::size_t> conditionOrder(const Protocol& protocol, int number);

/// A trial before it is one: which stimulus, and whether two alternatives are swapped.
struct PlannedTrial {
    std::size_t stimulus = 0;
    bool isSwapped = false;
};

/// All trials of a session whose levels do not follow the answers. Any thread (allocates).
std::vector<PlannedTrial> sessionOrder(const SessionPlan& session, std::size_t stimuli, SeededRandom& random);

} // namespace physvib
