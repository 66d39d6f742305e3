// SPDX-License-Identifier: GPL-3.0-or-later
// Lets a panel ask for a file or for values by a card over its window.
#pragma once
#include "Mixer/Window/FileCard.h"
#include "Mixer/Window/QuestionCard.h"

namespace physvib {

/// A component that shows cards over its panels.
class CardHost {
public:
    virtual ~CardHost() = default;
    /// Shows a card in the centre, with the keyboard; null: none.
    virtual void setCard(std::unique_ptr<juce::Component> card) = 0;
};

// All for the message thread. `use` and `cancelled` are called later, after the card has gone, and not if
// `from` has gone as well. Without a host above `from` nothing happens.

/// Asks for one file or folder.
void askForFile(juce::Component& from, const FileCard::Choice& choice,
                std::function<void(const juce::File&)> use, std::function<void()> cancelled = {});

/// Asks for one or several; see FileCard::Choice::areSeveral.
void askForFiles(juce::Component& from, const FileCard::Choice& choice,
                 const std::function<void(const juce::Array<juce::File>&)>& use,
                 std::function<void()> cancelled = {});

/// Asks for values: `use` gets one per field. `answer`: words of the button that takes them.
void askForValues(juce::Component& from, const juce::String& title, const juce::String& answer,
                  const std::vector<QuestionCard::Field>& fields,
                  std::function<void(const juce::StringArray&)> use);

} // namespace physvib
