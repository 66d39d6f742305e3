// SPDX-License-Identifier: MIT
// Describes a protocol in sentences for the methods section of a paper: one per field that has a value.
// Device, noise, limiter and actual orders come from the trials: see
// ReportApparatus.cpp.
#pragma once
#include "Lab/Study/Protocol.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
/// What a score of a scale, or of an object that is rated side by side, means. Any thread (allocates).
std::string scoreWords(const SessionPlan& session, const std::string& scale);

/// Sentences on the protocol as a whole. Message thread only.
std::vector<std::string> protocolSentences(const Protocol& protocol);

/// One line on the stimuli of a condition. Any thread (allocates).
std::string conditionWords(const ConditionPlan& condition);

/// One line on the question, repetitions and breaks of a session of that protocol. Any thread (allocates).
std::string sessionWords(const SessionPlan& session, const Protocol& protocol);

/// Names, and the conditions whose calls move them by a level in dB; none: these move the strength alone.
using Moved = std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>;
Moved movedIn(const Protocol& protocol, bool byRove = false); ///< Any thread (allocates).
/// {level_db} in the call itself, which then says what it is. Any thread.
bool isLevelItself(const std::vector<std::string>& moved);

/// One line per recording that calls with --method SV play. Any thread (allocates).
std::vector<std::string> soundLines(const Protocol& protocol);

// How a figure in g comes about, told wherever one is printed: samples, full scale, actuator.

/// A sentence with the full scale of each layout of the protocol, calibrated or assumed. `samples`: "as
/// rendered". A full scale counts as calibrated if its actuator's profile states the same. Message thread.
std::string levelChain(const Protocol& protocol, std::string_view samples);

} // namespace physvib
