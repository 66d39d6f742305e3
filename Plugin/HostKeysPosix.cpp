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

/// The functions of X11 that are needed, and a connection of its own.
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

public:
    decltype(&XSetErrorHandler) onError = find("XSetErrorHandler");
    decltype(&XSync) sync = find("XSync");
    decltype(&XSelectInput) select = find("XSelectInput");
    decltype(&XCheckTypedEvent) next = find("XCheckTypedEvent");
    decltype(&XQueryTree) tree = find("XQueryTree");
    decltype(&XFree) free = find("XFree");
    decltype(&XInternAtom) atom = find("XInternAtom");
    decltype(&XGetWindowProperty) property = find("XGetWindowProperty");
    decltype(&XKeysymToKeycode) code = find("XKeysymToKeycode");
    decltype(&XSendEvent) send = find("XSendEvent");
    decltype(&XSetInputFocus) focus = find("XSetInputFocus");
    Display* const display = isThere_ ? open_(nullptr) : nullptr;

    X11() = default;
    ~X11() {
        if (display) close_(display);
        if (library_ != nullptr) dlclose(library_);
    }
    X11(const X11&) = delete;
};

/// While it lives a window may be gone; the host's handler has its place again afterwards.
struct Unheard {
    explicit Unheard(const X11& of) noexcept
        : x{of}
        , before{x.onError([](Display*, XErrorEvent*) { return 0; })} {}
    ~Unheard() {
        x.sync(x.display, False);
        x.onError(before);
    }
    Unheard(const Unheard&) = delete;
    const X11& x;
    const XErrorHandler before;
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

struct HostKeys::Connection {
    X11 x;
    Window own = None;
};

void HostKeys::watch(void* nativeWindow) {
    const auto own = reinterpret_cast<Window>(nativeWindow);
    if (connection_ == nullptr && own != None) connection_ = std::make_unique<Connection>();
    if (connection_ == nullptr || connection_->own == own || !connection_->x.display) return;
    const Unheard guard{connection_->x};
    connection_->own = own;
    connection_->x.select(connection_->x.display, own, KeyPressMask);
}

bool HostKeys::send(const HostKey& key) noexcept {
    if (connection_ == nullptr || !connection_->x.display || key.symbol == 0) return false;
    const auto& [x, own] = *connection_;
    const Unheard guard{x};
    const KeyCode code = x.code(x.display, key.symbol);
    bool isTyped = false;
    x.sync(x.display, False);
    for (XEvent event; x.next(x.display, KeyPress, &event);)
        isTyped |= event.xkey.keycode == code && event.xkey.window == own && !event.xkey.send_event;
    Window root = None;
    const Window host = isManaged(x, own) ? None : topLevelAbove(x, own, root); // else that is a frame
    if (!isTyped || host == None || code == 0) return false;
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
void HostKeys::take() noexcept {
    if (connection_ == nullptr || !connection_->x.display) return;
    const Unheard guard{connection_->x};
    connection_->x.focus(connection_->x.display, connection_->own, RevertToParent, CurrentTime);
}
#else
struct HostKeys::Connection {};
void HostKeys::watch(void*) {}
void HostKeys::take() noexcept {}
bool HostKeys::send(const HostKey&) noexcept { return false; }
#endif

HostKeys::HostKeys() noexcept = default;
HostKeys::~HostKeys() = default;

} // namespace physvib
