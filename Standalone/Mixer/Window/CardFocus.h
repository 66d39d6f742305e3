// SPDX-License-Identifier: GPL-3.0-or-later
// Gives a card the keyboard, and keeps it there.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// A menu that is pressed by the mouse has a window of its own, with the keyboard. The system gives that back
/// to our window only after the menu's card was shown, and JUCE then gives it to what had it before the menu:
/// from there it goes to the card, once. Message thread.
class CardFocus final : private juce::FocusChangeListener {
public:
    CardFocus() { juce::Desktop::getInstance().addFocusChangeListener(this); }
    ~CardFocus() override { juce::Desktop::getInstance().removeFocusChangeListener(this); }

    /// The card is shown.
    void give(juce::Component& card) {
        behind_ = juce::Component::getCurrentlyFocusedComponent();
        if (auto* peer = card.getPeer(); behind_ == nullptr && peer != nullptr)
            behind_ = peer->getLastFocusedSubcomponent();
        card_ = &card;
        card.grabKeyboardFocus();
    }

private:
    void globalFocusChanged(juce::Component* focused) override {
        if (card_ == nullptr || focused == nullptr || focused != behind_) return;
        behind_ = nullptr;
        card_->grabKeyboardFocus();
    }
    juce::Component::SafePointer<juce::Component> card_, behind_;
};

} // namespace physvib
