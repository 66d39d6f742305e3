// SPDX-License-Identifier: GPL-3.0-or-later
// Texts for participants, translated and with values inserted.
#pragma once
#include "Lab/Files/Words.h"
#include "Lab/Study/Protocol.h"
#include <juce_core/juce_core.h>
#include <set>

namespace physvib {

/// The texts of the screens and of a protocol in the participant's language. Message thread.
class StudyWords {
public:
    explicit StudyWords(Words words = {})
        : words_{std::move(words)} {}

    /// "trial {n}" with the value of {n}. Texts without a translation stay English and are recorded in
    /// missed().
    juce::String operator()(const std::string& english,
                            std::initializer_list<std::pair<const char*, juce::String>> values = {}) const;
    const std::set<std::string>& missed() const noexcept { return missed_; }

    /// Question of a trial: the protocol's, or the task's default.
    juce::String question(const SessionPlan& session, const ConditionPlan& condition) const;
    /// Course of a session, in a few lines.
    juce::String instruction(const SessionPlan& session, const ConditionPlan& condition) const;
    /// "the first", for the parts to choose from.
    juce::String ordinal(int part) const;

private:
    juce::String lines(const TaskText& text, const ConditionPlan& condition) const;
    juce::String feel(const SessionPlan& session) const;
    Words words_;
    mutable std::set<std::string> missed_;
};

/// "1:05". Any thread.
juce::String minutesText(double seconds);

} // namespace physvib
