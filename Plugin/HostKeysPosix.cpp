// SPDX-License-Identifier: GPL-3.0-or-later
// The key as an event of X11 to the top-level window. X11 is loaded, as by JUCE: nothing is linked with it.
#include "HostKeys.h"
#ifdef __linux__
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <dlfcn.h>
#endif

namespace physvib {

#ifdef __linux__
/// Functions of X11, on a connection of its own.
class HostConnection {
    struct Found {
        void* at;
        template <class Function>
        operator Function() const noexcept {
            return reinterpret_cast<Function>(at);
        }
    };
    Found find(const char* name) const noexcept { return {library_ ? dlsym(library_, name) : nullptr}; }
    void* const library_ = dlopen("libX11.so.6", RTLD_LAZY);
    decltype(&XOpenDisplay) open_ = find("XOpenDisplay");
    decltype(&XCloseDisplay) close_ = find("XCloseDisplay");
    decltype(&XSetErrorHandler) onError_ = find("XSetErrorHandler");
    decltype(&XQueryTree) tree_ = find("XQueryTree");
    decltype(&XFree) free_ = find("XFree");
    decltype(&XInternAtom) atom_ = find("XInternAtom");
    decltype(&XGetWindowProperty) property_ = find("XGetWindowProperty");

public:
    decltype(&XSync) sync = find("XSync");
    decltype(&XSelectInput) select = find("XSelectInput");
    decltype(&XCheckTypedEvent) next = find("XCheckTypedEvent");
    decltype(&XKeysymToKeycode) code = find("XKeysymToKeycode");
    decltype(&XSendEvent) send = find("XSendEvent");
    decltype(&XSetInputFocus) focus = find("XSetInputFocus");
    Display* const display = library_ ? open_(nullptr) : nullptr;
    Window own = None;

    HostConnection() = default;
    ~HostConnection() {
        if (display) close_(display);
        if (library_ != nullptr) dlclose(library_);
    }
    HostConnection(const HostConnection&) = delete;

    /// `call`, while no window has to be there any more.
    template <class Call>
    void quietly(const Call& call) const noexcept {
        const auto before = onError_([](Display*, XErrorEvent*) { return 0; });
        call();
        sync(display, False);
        onError_(before);
    }
    bool isManaged(Window window) const noexcept {
        const Atom state = atom_(display, "WM_STATE", True);
        Atom type = None;
        int format = 0;
        unsigned long count = 0, rest = 0;
        unsigned char* data = nullptr;
        if (state != None)
            property_(display, window, state, 0, 0, False, AnyPropertyType, &type, &format, &count, &rest,
                      &data);
        if (data) free_(data);
        return type != None;
    }
    /// The window that a window manager holds, above `own`; without one the last below the root.
    Window host() const noexcept {
        for (Window at = own; !isManaged(own);) { // else that is a frame
            Window root = None, parent = None, *children = nullptr;
            unsigned int count = 0;
            if (!tree_(display, at, &root, &parent, &children, &count)) break;
            if (children) free_(children);
            if (parent == root || parent == None) return at == own ? None : at;
            if (isManaged(parent)) return parent;
            at = parent;
        }
        return None;
    }
};

void HostKeys::watch(void* nativeWindow) {
    const auto own = reinterpret_cast<Window>(nativeWindow);
    if (connection_ == nullptr) connection_ = std::make_shared<HostConnection>();
    auto& x = *connection_;
    if (x.own == own || !x.display) return;
    x.own = own;
    x.quietly([&] { x.select(x.display, own, KeyPressMask); });
}

bool HostKeys::send(unsigned long symbol) noexcept {
    if (connection_ == nullptr || connection_->own == None) return false;
    const auto& x = *connection_;
    XEvent typed{};
    x.quietly([&] {
        const KeyCode code = x.code(x.display, symbol);
        x.sync(x.display, False);
        for (XEvent event; x.next(x.display, KeyPress, &event);)
            if (event.xkey.keycode == code && event.xkey.window == x.own && !event.xkey.send_event)
                typed = event;
        typed.xkey.window = typed.type == KeyPress ? x.host() : None;
        if (typed.xkey.window == None) return;
        x.send(x.display, typed.xkey.window, True, KeyPressMask, &typed);
        typed.type = KeyRelease;
        x.send(x.display, typed.xkey.window, True, KeyReleaseMask, &typed);
    });
    return typed.type == KeyRelease;
}

// JUCE asks by the time of its last event; the server ignores what is older than another's.
void HostKeys::take() noexcept {
    if (connection_ == nullptr || connection_->own == None) return;
    const auto& x = *connection_;
    x.quietly([&] { x.focus(x.display, x.own, RevertToParent, CurrentTime); });
}
#else
void HostKeys::watch(void*) {}
void HostKeys::take() noexcept {}
bool HostKeys::send(unsigned long) noexcept { return false; }
#endif

} // namespace physvib
