// SPDX-License-Identifier: GPL-3.0-or-later
// Hands keys that the plug-in's window does not use to the host's window around it (save, undo, play). Under
// X11 the window that was clicked gets the keys, and nobody passes them on; other systems do.
#pragma once
#include <memory>

namespace physvib {

/// The X11 key symbol of a key code of juce::KeyPress.
constexpr unsigned long keySymbolOf(int juceKeyCode) noexcept {
    constexpr int extended = 0x10000000, lastControl = 0x1f;
    if ((juceKeyCode & extended) != 0 || juceKeyCode <= lastControl)
        return 0xff00ul | static_cast<unsigned long>(juceKeyCode & 0xff);
    return static_cast<unsigned long>(juceKeyCode);
}

/// For the thread of the windows, under X11; elsewhere it does nothing.
class HostKeys {
public:
    /// `nativeWindow`: JUCE's, within that of the host, or null.
    void watch(void* nativeWindow);
    /// To the host, if the key was typed into that window since the last call. What a host has handed on it
    /// has seen: it would come back for ever. False: not sent.
    bool send(unsigned long symbol) noexcept;
    /// Gives that window the keyboard focus.
    void take() noexcept;

private:
    std::shared_ptr<class HostConnection> connection_;
};

} // namespace physvib
