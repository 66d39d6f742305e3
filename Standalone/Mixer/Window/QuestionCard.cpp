// SPDX-License-Identifier: GPL-3.0-or-later
// Two lines and two buttons.
#include "Mixer/Window/QuestionCard.h"
#include <utility>

namespace physvib {

QuestionCard::QuestionCard(const juce::String& title, const juce::String& words, const juce::String& yes,
                           const juce::String& no)
    : yes_{yes}
    , no_{no} {
    setTitle(title);
    setDescription(words);
    setWantsKeyboardFocus(true);
    title_.setText(title, juce::dontSendNotification);
    title_.setFont(juce::Font{text::large, juce::Font::bold});
    words_.setText(words, juce::dontSendNotification);
    words_.setFont(juce::Font{text::medium});
    words_.setJustificationType(juce::Justification::topLeft);
    words_.setMinimumHorizontalScale(1.0f); // it has room for two lines
    yes_.onClick = [this] { answer(true); };
    no_.onClick = [this] { answer(false); };
    yes_.setTitle(yes);
    no_.setTitle(no);
    yes_.setTooltip(yes + " (Return)");
    yes_.setToggleState(true, juce::dontSendNotification); // what Return does
    for (juce::Component* c : std::initializer_list<juce::Component*>{&title_, &words_, &yes_, &no_})
        addAndMakeVisible(c);
    prepareControls(*this);
    setSize(wide, high);
}

void QuestionCard::answer(bool isYes) {
    if (const auto tell = std::exchange(onAnswer, nullptr)) tell(isYes);
}

bool QuestionCard::keyPressed(const juce::KeyPress& key) {
    if (key != juce::KeyPress::returnKey) return false;
    answer(!no_.hasKeyboardFocus(false));
    return true;
}

void QuestionCard::paint(juce::Graphics& g) { drawCard(g, *this); }

void QuestionCard::resized() {
    auto area = getLocalBounds().reduced(24, 20);
    title_.setBounds(area.removeFromTop(30));
    auto row = area.removeFromBottom(34);
    words_.setBounds(area.withTrimmedTop(4));
    yes_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(gap);
    no_.setBounds(row.removeFromLeft(130));
}

} // namespace physvib
