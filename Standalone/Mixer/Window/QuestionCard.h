// SPDX-License-Identifier: GPL-3.0-or-later
// A question over the window, in its own look: one answer by Return, the other by a button.
#pragma once
#include "Mixer/Window/Parts.h"
#include <functional>

namespace physvib {

/// M only.
class QuestionCard final : public juce::Component {
public:
    static constexpr int wide = 520, high = 190;

    QuestionCard(const juce::String& title, const juce::String& words, const juce::String& yes,
                 const juce::String& no);

    std::function<void(bool isYes)> onAnswer; ///< once; may destroy the card

    void answer(bool isYes);
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    juce::Label title_, words_;
    juce::TextButton yes_, no_;
};

} // namespace physvib
