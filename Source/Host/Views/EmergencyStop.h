// SPDX-License-Identifier: GPL-3.0-or-later
// The emergency stop of a window: Esc and its red button, whatever has the keyboard and whatever lies
// between.
#pragma once
#include <functional>
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

class StopKeys;

/// While it lives, Esc silences before the menu, list, dialog or text field that has the keyboard gets the
/// key, and so does a press on a red button of this window (see stopProperty) that something modal blocks.
/// Key and press then go where they went anyway. An Esc in a window of its own, as a dialog's, is everybody's
/// in this process: nothing says whose it is. M.
class EmergencyStop {
public:
    EmergencyStop(juce::Component& window, std::function<void()> silence);
    ~EmergencyStop();

private:
    friend class StopKeys;
    juce::Component& window_;
    std::function<void()> silence_;
    juce::SharedResourcePointer<StopKeys> keys_;
};

} // namespace physvib
