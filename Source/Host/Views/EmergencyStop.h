// SPDX-License-Identifier: GPL-3.0-or-later
// Emergency stop of a window: Esc and the red button silence the output, even while a menu, dialog or text
// field has the keyboard.
#pragma once
#include <functional>
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

class StopKeys;

/// While this object exists, Esc silences before the menu, list, dialog or text field with keyboard focus
/// gets the key. A click on a red button of this window (see stopProperty) also silences while a modal
/// component blocks the window. Key and click are then passed on as usual. Esc in a separate window, such as
/// a dialog, silences all windows of the process, because the owner of that window is unknown. `closesFirst`:
/// whether Esc has something to close, and silences with the next press. M.
class EmergencyStop {
public:
    EmergencyStop(juce::Component& window, std::function<void()> silence,
                  std::function<bool()> closesFirst = {});
    ~EmergencyStop();

private:
    friend class StopKeys;
    juce::Component& window_;
    std::function<void()> silence_;
    std::function<bool()> closesFirst_;
    juce::SharedResourcePointer<StopKeys> keys_;
    juce::VBlankAttachment frames_; // last: it calls the keys
};

} // namespace physvib
