// SPDX-License-Identifier: GPL-3.0-or-later
// The window on the screen: the view, its menu, and what happens when it is closed.
#pragma once
#include "Mixer/MixerView.h"

namespace physvib {

class MixerWindow final : public juce::DocumentWindow {
public:
    explicit MixerWindow(Desk& desk);
    void closeButtonPressed() override { juce::JUCEApplicationBase::quit(); }
    MixerView& view() noexcept { return view_; }

private:
    void showMenu(juce::Component& from);

    Desk& desk_;
    MixerView view_;
};

} // namespace physvib
