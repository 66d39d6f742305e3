// SPDX-License-Identifier: GPL-3.0-or-later
// HostKeys sends keys that the plug-in's window does not use to the host's window around it (save, undo,
// play). X11 gives keys to the window that was clicked and does not pass them on; other systems do.
#pragma once
#include <memory>

namespace physvib {

/// The X11 key symbol of a key code of juce::KeyPress.
constexpr unsigned long x11KeySymbol(int juceKeyCode) noexcept {
    constexpr int extended = 0x10000000, lastControl = 0x1f;
    if ((juceKeyCode & extended) != 0 || juceKeyCode <= lastControl)
        return 0xff00ul | static_cast<unsigned long>(juceKeyCode & 0xff);
    return static_cast<unsigned long>(juceKeyCode);
}

/// Works under X11; elsewhere it does nothing. M only.
class HostKeys {
public:
    /// Sets the plug-in's window, JUCE's within that of the host, or null.
    void setWindow(void* nativeWindow);
    /// Sends the key to the host if it was typed into that window since the last call. A key that the host
    /// itself sent is not returned, or it would come back for ever. False: not sent.
    bool forward(unsigned long symbol) noexcept;
    /// Gives that window the keyboard focus.
    void grabKeyboard() noexcept;

private:
    std::shared_ptr<class X11Connection> connection_;
};

} // namespace physvib
