// SPDX-License-Identifier: GPL-3.0-or-later
// HostKeys by X11 events to the host's top-level window. X11 is loaded at run time, as JUCE loads it.
#include "HostKeys.h"
#ifdef __linux__
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <dlfcn.h>
#endif

namespace physvib {

#ifdef __linux__
/// Functions of libX11 and a connection of its own to the X server.
class X11Connection {
    struct Symbol {
        void* address;
        template <class Function>
        operator Function() const noexcept {
            return reinterpret_cast<Function>(address);
        }
    };
    Symbol find(const char* name) const noexcept { return {library_ ? dlsym(library_, name) : nullptr}; }
    void* const library_ = dlopen("libX11.so.6", RTLD_LAZY);
    decltype(&XOpenDisplay) openDisplay_ = find("XOpenDisplay");
    decltype(&XCloseDisplay) closeDisplay_ = find("XCloseDisplay");
    decltype(&XSetErrorHandler) setErrorHandler_ = find("XSetErrorHandler");
    decltype(&XQueryTree) queryTree_ = find("XQueryTree");
    decltype(&XFree) freeData_ = find("XFree");
    decltype(&XInternAtom) internAtom_ = find("XInternAtom");
    decltype(&XGetWindowProperty) getProperty_ = find("XGetWindowProperty");

public:
    decltype(&XSync) sync = find("XSync");
    decltype(&XSelectInput) selectInput = find("XSelectInput");
    decltype(&XCheckTypedEvent) checkEvent = find("XCheckTypedEvent");
    decltype(&XKeysymToKeycode) toKeycode = find("XKeysymToKeycode");
    decltype(&XSendEvent) sendEvent = find("XSendEvent");
    decltype(&XSetInputFocus) setFocus = find("XSetInputFocus");
    Display* const display = library_ ? openDisplay_(nullptr) : nullptr;
    Window pluginWindow = None;

    X11Connection() = default;
    ~X11Connection() {
        if (display) closeDisplay_(display);
        if (library_ != nullptr) dlclose(library_);
    }
    X11Connection(const X11Connection&) = delete;

    /// Runs `call` while X11 errors are ignored: a window may have been closed meanwhile.
    template <class Call>
    void ignoringErrors(const Call& call) const noexcept {
        const auto previousHandler = setErrorHandler_([](Display*, XErrorEvent*) { return 0; });
        call();
        sync(display, False);
        setErrorHandler_(previousHandler);
    }
    bool isManaged(Window window) const noexcept {
        const Atom state = internAtom_(display, "WM_STATE", True);
        Atom type = None;
        int format = 0;
        unsigned long count = 0, bytesAfter = 0;
        unsigned char* data = nullptr;
        if (state != None)
            getProperty_(display, window, state, 0, 0, False, AnyPropertyType, &type, &format, &count,
                         &bytesAfter, &data);
        if (data) freeData_(data);
        return type != None;
    }
    /// The managed window above `pluginWindow`, or the last below the root; None if the plug-in's is managed.
    Window host() const noexcept {
        for (Window window = pluginWindow; !isManaged(pluginWindow);) {
            Window root = None, parent = None, *children = nullptr;
            unsigned int count = 0;
            if (!queryTree_(display, window, &root, &parent, &children, &count)) break;
            if (children) freeData_(children);
            if (parent == root || parent == None) return window == pluginWindow ? None : window;
            if (isManaged(parent)) return parent;
            window = parent;
        }
        return None;
    }
};

void HostKeys::setWindow(void* nativeWindow) {
    const auto newWindow = reinterpret_cast<Window>(nativeWindow);
    if (connection_ == nullptr) connection_ = std::make_shared<X11Connection>();
    auto& x = *connection_;
    if (x.pluginWindow == newWindow || !x.display) return;
    x.pluginWindow = newWindow;
    x.ignoringErrors([&] { x.selectInput(x.display, newWindow, KeyPressMask); });
}

bool HostKeys::forward(unsigned long symbol) noexcept {
    if (connection_ == nullptr || connection_->pluginWindow == None) return false;
    const auto& x = *connection_;
    XEvent typed{};
    x.ignoringErrors([&] {
        const KeyCode code = x.toKeycode(x.display, symbol);
        x.sync(x.display, False);
        for (XEvent event; x.checkEvent(x.display, KeyPress, &event);)
            if (event.xkey.keycode == code && event.xkey.window == x.pluginWindow && !event.xkey.send_event)
                typed = event;
        typed.xkey.window = typed.type == KeyPress ? x.host() : None;
        if (typed.xkey.window == None) return;
        x.sendEvent(x.display, typed.xkey.window, True, KeyPressMask, &typed);
        typed.type = KeyRelease;
        x.sendEvent(x.display, typed.xkey.window, True, KeyReleaseMask, &typed);
    });
    return typed.type == KeyRelease;
}

// JUCE would ask with the time of its last event, which the server ignores if the host's is newer.
void HostKeys::grabKeyboard() noexcept {
    if (connection_ == nullptr || connection_->pluginWindow == None) return;
    const auto& x = *connection_;
    x.ignoringErrors([&] { x.setFocus(x.display, x.pluginWindow, RevertToParent, CurrentTime); });
}
#else
void HostKeys::setWindow(void*) {}
void HostKeys::grabKeyboard() noexcept {}
bool HostKeys::forward(unsigned long) noexcept { return false; }
#endif

} // namespace physvib
