// SPDX-License-Identifier: GPL-3.0-or-later
// What a participant reads.
#pragma once
#include "Study/Protocol.h"
#include <juce_core/juce_core.h>

namespace physvib {

/// The question of a trial: the protocol's, or that of the task. Any thread.
juce::String questionOf(const SessionPlan& session, const ConditionPlan& condition);

/// How a session goes, in a few lines. Any thread.
juce::String instructionOf(const SessionPlan& session, const ConditionPlan& condition);

/// "1:05". Any thread.
juce::String minutesText(double seconds);

} // namespace physvib
