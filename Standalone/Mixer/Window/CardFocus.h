// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the keyboard and the mouse from what is behind an open card.
#pragma once
#include "Host/Views/Look.h"
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// Gives a card the keyboard, its first text field if it has one, and keeps it there. What would take it
/// away: a menu that is pressed by the mouse has a window of its own, and when that closes, JUCE gives the
/// keyboard to what had it before. Message thread.
class CardFocus final : private juce::FocusChangeListener {
public:
    CardFocus() { juce::Desktop::getInstance().addFocusChangeListener(this); }
    ~CardFocus() override { juce::Desktop::getInstance().removeFocusChangeListener(this); }

    /// The card is shown.
    void give(juce::Component& card) {
        card_ = &card;
        card.setFocusContainerType(juce::Component::FocusContainerType::keyboardFocusContainer); // for Tab
        auto* const field = fieldOf(card);
        (field != nullptr ? *field : card).grabKeyboardFocus();
    }

private:
    static juce::Component* fieldOf(juce::Component& in) {
        for (auto* child : in.getChildren()) {
            if (dynamic_cast<juce::TextEditor*>(child) != nullptr && child->isVisible()) return child;
            if (auto* const within = fieldOf(*child)) return within;
        }
        return nullptr;
    }
    void globalFocusChanged(juce::Component* focused) override {
        if (card_ == nullptr || focused == nullptr || focused == card_ || card_->isParentOf(focused)) return;
        if (focused->getTopLevelComponent() == card_->getTopLevelComponent()) give(*card_);
    }
    juce::Component::SafePointer<juce::Component> card_;
};

/// Lies between a card and the window: only the button that silences is reached through it. Message thread.
class Curtain final : public juce::Component {
public:
    void paint(juce::Graphics& g) override {
        if (const auto* stop = stopButton(*getParentComponent()))
            g.excludeClipRegion(getLocalArea(stop, stop->getLocalBounds()));
        g.fillAll(shade(*this, Shade::ground).withAlpha(0.45f));
    }
    bool hitTest(int x, int y) override {
        const auto* stop = stopButton(*getParentComponent());
        return stop == nullptr || !getLocalArea(stop, stop->getLocalBounds()).contains(x, y);
    }

private:
    static const juce::Component* stopButton(const juce::Component& in) {
        if (in.getProperties()[stopProperty] && in.isShowing()) return &in;
        for (const auto* child : in.getChildren())
            if (const auto* found = stopButton(*child)) return found;
        return nullptr;
    }
};

} // namespace physvib
