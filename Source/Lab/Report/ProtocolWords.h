// SPDX-License-Identifier: MIT
// A protocol in sentences, for a paper's section on methods: each comes from a field, and a field that says
// nothing has none. What rows tell better (device, noise, limiter, orders as they were) is not here: see
// ReportApparatus.cpp and ReportDesign.cpp.
#pragma once
#include "Lab/Study/Protocol.h"
#include <string>
#include <vector>

namespace physvib {

/// Of the whole protocol. Any thread (allocates).
std::vector<std::string> protocolSentences(const Protocol& protocol);

/// What is felt in a condition: one line. Any thread (allocates).
std::string conditionWords(const ConditionPlan& condition);

/// What is asked in a session, how often and with which breaks: one line. Any thread (allocates).
std::string sessionWords(const SessionPlan& session);

/// The recordings that calls with --method SV play: a line each. Any thread (allocates).
std::vector<std::string> soundLines(const Protocol& protocol);

} // namespace physvib
