// SPDX-License-Identifier: MIT
// A protocol's fields and their values, for the section on methods, and for plans. Any thread (allocates).
#pragma once
#include "Lab/Study/Protocol.h"
#include <string>

namespace physvib {

// "layout phone1; stimuli grid; columns 3": each field that says something, by its name in files.
std::string protocolWords(const Protocol& protocol); ///< without conditions and sessions
std::string conditionWords(const ConditionPlan& condition);
std::string sessionWords(const SessionPlan& session);

/// What a score of that scale goes from and to, and the scale's sentence.
std::string scoreWords(const SessionPlan& session, const std::string& scale);

/// The full scale of each condition's layout, and whether it is calibrated: "phone1: 1 g, assumed".
std::string fullScales(const Protocol& protocol);

} // namespace physvib
