// SPDX-License-Identifier: GPL-3.0-or-later
// Hands keys that the plug-in's window does not use to the host's window around it (save, undo, play). Under
// X11 the window that was clicked gets the keys, and nobody passes them on; other systems do.
#pragma once

namespace physvib {

/// A key as X11 numbers it, with what is held down beside it.
struct HostKey {
    unsigned long symbol = 0;
    bool shift = false, control = false, alt = false;
};

/// `symbol` of a key code of juce::KeyPress; 0: there is none.
constexpr unsigned long keySymbolOf(int juceKeyCode) noexcept {
    constexpr int extended = 0x10000000, lastControl = 0x1f;
    if (juceKeyCode <= 0) return 0;
    if ((juceKeyCode & extended) != 0 || juceKeyCode <= lastControl)
        return 0xff00ul | static_cast<unsigned long>(juceKeyCode & 0xff);
    return static_cast<unsigned long>(juceKeyCode);
}

/// `nativeWindow`: JUCE's, within that of the host. False: it has none around it, or there is no X11. Thread
/// of the windows.
bool sendToHost(void* nativeWindow, const HostKey& key) noexcept;

/// Gives the keyboard to that window of JUCE's, under X11. Thread of the windows.
void takeKeys(void* nativeWindow) noexcept;

} // namespace physvib
