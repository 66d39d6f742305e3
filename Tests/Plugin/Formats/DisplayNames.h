// SPDX-License-Identifier: GPL-3.0-or-later
// A display without a window manager, as JUCE can use it. Included last: X11's names are macros.
#pragma once
#include <X11/Xlib.h>
#include <array>

namespace physvib::test {

/// What a window manager would have named, and JUCE takes for granted; kept until the display is closed.
inline Display* openDisplayWithNames() {
    Display* const display = XOpenDisplay(nullptr);
    if (display == nullptr) return nullptr;
    for (const char* name :
         std::array{"WM_PROTOCOLS", "WM_TAKE_FOCUS", "WM_DELETE_WINDOW", "WM_CHANGE_STATE", "WM_STATE",
                    "_NET_WM_PING", "_NET_WM_STATE", "_NET_WM_STATE_HIDDEN", "_NET_WM_STATE_FULLSCREEN",
                    "_NET_WM_WINDOW_TYPE", "_NET_WM_ALLOWED_ACTIONS", "_NET_FRAME_EXTENTS", "_NET_WORKAREA",
                    "_MOTIF_WM_HINTS"})
        XInternAtom(display, name, 0);
    XSync(display, 0);
    return display;
}

} // namespace physvib::test
