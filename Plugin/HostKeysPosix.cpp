// SPDX-License-Identifier: GPL-3.0-or-later
// The key as an event of X11, sent to the top-level window. X11 is loaded as JUCE loads it: no program has to
// be linked with it.
#include "HostKeys.h"
#ifdef __linux__
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <dlfcn.h>
#endif

namespace physvib {

#ifdef __linux__
namespace {

/// The functions of X11 that are needed, and a connection of its own while one key is sent.
class X11 {
    struct Found {
        void* at;
        template <class Function>
        operator Function() const noexcept {
            return reinterpret_cast<Function>(at);
        }
    };
    Found find(const char* name) noexcept {
        void* const at = isThere_ ? dlsym(library_, name) : nullptr;
        isThere_ = at != nullptr;
        return {at};
    }
    void* const library_ = dlopen("libX11.so.6", RTLD_LAZY);
    bool isThere_ = library_ != nullptr;
    decltype(&XOpenDisplay) open_ = find("XOpenDisplay");
    decltype(&XCloseDisplay) close_ = find("XCloseDisplay");
    decltype(&XSetErrorHandler) onError_ = find("XSetErrorHandler");
    XErrorHandler before_ = nullptr;

public:
    decltype(&XQueryTree) tree = find("XQueryTree");
    decltype(&XFree) free = find("XFree");
    decltype(&XInternAtom) atom = find("XInternAtom");
    decltype(&XGetWindowProperty) property = find("XGetWindowProperty");
    decltype(&XKeysymToKeycode) code = find("XKeysymToKeycode");
    decltype(&XSendEvent) send = find("XSendEvent");
    decltype(&XSetInputFocus) focus = find("XSetInputFocus");
    Display* const display = isThere_ ? open_(nullptr) : nullptr;

    X11() noexcept {
        if (display)
            before_ = onError_([](Display*, XErrorEvent*) { return 0; }); // a window may just be gone
    }
    ~X11() {
        if (display) close_(display);
        if (display) onError_(before_);
        if (library_ != nullptr) dlclose(library_);
    }
    X11(const X11&) = delete;
};

bool isManaged(const X11& x, Window window) noexcept {
    const Atom state = x.atom(x.display, "WM_STATE", True);
    if (state == None) return false;
    Atom type = None;
    int format = 0;
    unsigned long count = 0, rest = 0;
    unsigned char* data = nullptr;
    x.property(x.display, window, state, 0, 0, False, AnyPropertyType, &type, &format, &count, &rest, &data);
    if (data) x.free(data);
    return type != None;
}

/// The window that a window manager holds, above `inner`; without one the last below the root.
Window topLevelAbove(const X11& x, Window inner, Window& root) noexcept {
    for (Window at = inner;;) {
        Window parent = None, *children = nullptr;
        unsigned int count = 0;
        if (!x.tree(x.display, at, &root, &parent, &children, &count)) return None;
        if (children) x.free(children);
        if (parent == root || parent == None) return at == inner ? None : at;
        if (isManaged(x, parent)) return parent;
        at = parent;
    }
}

} // namespace

bool sendToHost(void* nativeWindow, const HostKey& key) noexcept {
    const X11 x;
    if (!x.display || key.symbol == 0) return false;
    Window root = None;
    const auto own = reinterpret_cast<Window>(nativeWindow);
    const Window host = isManaged(x, own) ? None : topLevelAbove(x, own, root); // else that is a frame
    const KeyCode code = x.code(x.display, key.symbol);
    if (host == None || code == 0) return false;
    XEvent event{};
    event.xkey.display = x.display;
    event.xkey.window = host;
    event.xkey.root = root;
    event.xkey.time = CurrentTime;
    event.xkey.same_screen = True;
    event.xkey.keycode = code;
    event.xkey.state =
        (key.shift ? ShiftMask : 0u) | (key.control ? ControlMask : 0u) | (key.alt ? Mod1Mask : 0u);
    for (int kind = KeyPress; kind <= KeyRelease; ++kind) {
        event.type = kind;
        x.send(x.display, host, True, kind == KeyPress ? KeyPressMask : KeyReleaseMask, &event);
    }
    return true;
}

// JUCE asks by the time of its last event; the server ignores what is older than another's.
void takeKeys(void* nativeWindow) noexcept {
    if (const X11 x; x.display)
        x.focus(x.display, reinterpret_cast<Window>(nativeWindow), RevertToParent, CurrentTime);
}
#else
void takeKeys(void*) noexcept {}
bool sendToHost(void*, const HostKey&) noexcept { return false; }
#endif

} // namespace physvib
