// SPDX-License-Identifier: GPL-3.0-or-later
// Keys in the plug-in's window, in the window of a host without a window manager: those that no control uses
// reach the host once, Esc silences and stays here. As in the formats, a component is around the editor.
#include "../PluginTesting.h"
#include "PluginEditor.h"
namespace physvib {
using Key = juce::KeyPress; // which is a macro of X11
}
// X11's macros come last
#include "Plugin/Formats/DisplayNames.h"
#include <X11/keysym.h>
#include <dlfcn.h>

namespace physvib {
namespace {

using namespace test;

struct HostWindow {
    HostWindow()
        : window{XCreateSimpleWindow(display, DefaultRootWindow(display), 20, 20, 1200, 720, 0, 0, 0)} {
        XSelectInput(display, window, KeyPressMask | KeyReleaseMask);
        XMapWindow(display, window);
        XSync(display, False);
    }
    ~HostWindow() { XCloseDisplay(display); }
    /// Keys that came so far: their symbols and states.
    std::vector<std::pair<KeySym, unsigned int>> keys() {
        std::vector<std::pair<KeySym, unsigned int>> found;
        XSync(display, False);
        for (XEvent event; XCheckTypedWindowEvent(display, window, KeyPress, &event);)
            found.emplace_back(XLookupKeysym(&event.xkey, 0), event.xkey.state);
        return found;
    }
    Display* display = openDisplayWithNames();
    Window window;
};

using FakeKey = int (*)(Display*, unsigned int, Bool, unsigned long);
const auto fakeKey = reinterpret_cast<FakeKey>(dlsym(dlopen("libXtst.so.6", RTLD_LAZY), "XTestFakeKeyEvent"));

/// As from a keyboard, all held at once.
void type(Display* display, std::vector<KeySym> keys) {
    for (const Bool isDown : {True, False}) {
        for (const KeySym one : keys) fakeKey(display, XKeysymToKeycode(display, one), isDown, CurrentTime);
        std::ranges::reverse(keys);
    }
    XSync(display, False);
    runFor(0.1);
}

/// The plug-in's window within a host's.
struct Embedded {
    Embedded() {
        wrapper.addAndMakeVisible(*editor);
        wrapper.setSize(editor->getWidth(), editor->getHeight());
        wrapper.addToDesktop(0, reinterpret_cast<void*>(around.window));
        wrapper.setVisible(true);
        runFor(0.3);
        XSetInputFocus(around.display, own(), RevertToParent, CurrentTime);
    }
    Window own() const { return reinterpret_cast<Window>(wrapper.getWindowHandle()); }
    void press(const std::vector<KeySym>& keys) const { type(around.display, keys); }
    /// As a host does with what it does not use: the key goes back to the program of the window alone.
    void handBack(KeySym symbol) const {
        XEvent event{};
        event.xkey = {.type = KeyPress, .window = own(), .keycode = XKeysymToKeycode(around.display, symbol)};
        XSendEvent(around.display, own(), False, NoEventMask, &event);
        XSync(around.display, False);
        runFor(0.1);
    }
    HostWindow around;
    TestHost host;
    juce::Component wrapper;
    const std::unique_ptr<PluginEditor> editor = openEditor<PluginEditor>(*host.plugin);
};

TEST(HostKeys, WhatNoControlUsesReachesTheHostAndEscStays) {
    Embedded embedded;
    auto& [around, host, wrapper, editor] = embedded;
    if (fakeKey == nullptr) GTEST_SKIP() << "libxtst6 is not installed";
    embedded.press({XK_Control_L, XK_s});
    embedded.press({XK_space});
    embedded.press({XK_Shift_L, XK_F5});
    embedded.press({XK_Return});
    const std::vector<std::pair<KeySym, unsigned int>> expected{
        {XK_s, ControlMask}, {XK_space, 0}, {XK_F5, ShiftMask}, {XK_Return, 0}};
    EXPECT_EQ(around.keys(), expected);
    embedded.handBack(XK_F5);
    EXPECT_TRUE(around.keys().empty()) << "the host gave it, and would for ever";
    embedded.press({XK_Escape});
    EXPECT_TRUE(around.keys().empty());
    EXPECT_TRUE(host.plugin->isStopped()) << "Esc silences";
    EXPECT_EQ(host.plugin->parameter(Parameter::bypass).getValue(), 0.0f) << "and no session keeps it";
}

// Under some window managers the box has no keyboard after a list was open: keys come to the window then.
TEST(HostKeys, AValueThatIsTypedIsTheValuesAndEscClosesItFirst) {
    Embedded embedded;
    auto& [around, host, wrapper, editor] = embedded;
    if (fakeKey == nullptr) GTEST_SKIP() << "libxtst6 is not installed";
    auto* const value = below<juce::Label>(*editor, [](const juce::Label& label) {
        return label.isShowing() && dynamic_cast<juce::Slider*>(label.getParentComponent()) != nullptr;
    });
    ASSERT_NE(value, nullptr);
    const auto before = value->getText();
    value->showEditor();
    for (const Key& key :
         {Key{Key::backspaceKey}, Key{'3', 0, '3'}, Key{'s', juce::ModifierKeys::ctrlModifier, 0}})
        editor->keyPressed(key);
    ASSERT_NE(value->getCurrentTextEditor(), nullptr);
    EXPECT_EQ(value->getCurrentTextEditor()->getText(), "3");
    editor->keyPressed(Key{Key::returnKey});
    runFor(0.1);
    EXPECT_NE(value->getText(), before);
    juce::Component::unfocusAllComponents(); // as after a click into it
    embedded.press({XK_space});
    EXPECT_EQ(around.keys().size(), 1u) << "what was typed is not the host's, Space is";
    value->showEditor();
    embedded.press({XK_Escape});
    EXPECT_EQ(value->getCurrentTextEditor(), nullptr);
    EXPECT_FALSE(host.plugin->isStopped()) << "it closed what was open";
    embedded.press({XK_Escape});
    EXPECT_TRUE(host.plugin->isStopped());
    EXPECT_TRUE(around.keys().empty()) << "nothing of it was the host's";
}

TEST(HostKeys, AWindowOfItsOwnHasNoHost) {
    TestHost host;
    const auto editor = openEditor<PluginEditor>(*host.plugin);
    editor->addToDesktop(0);
    editor->setVisible(true);
    runFor(0.2);
    if (fakeKey == nullptr) GTEST_SKIP() << "libxtst6 is not installed";
    const HostWindow other;
    HostKeys keys;
    keys.setWindow(editor->getWindowHandle());
    XSetInputFocus(other.display, reinterpret_cast<Window>(editor->getWindowHandle()), RevertToParent,
                   CurrentTime);
    type(other.display, {XK_s});
    EXPECT_FALSE(keys.forward(XK_s));
}

} // namespace
} // namespace physvib
