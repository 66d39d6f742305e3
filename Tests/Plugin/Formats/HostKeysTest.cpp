// SPDX-License-Identifier: GPL-3.0-or-later
// Keys in the plug-in's window, in the window of a host without a window manager: those that no control uses
// reach the host once, Esc silences and stays here. As with the formats, JUCE's window is a component's
// around ours.
#include "HostKeys.h"
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

/// As from a keyboard.
void type(Display* display, const Key& key) {
    const auto mods = key.getModifiers();
    std::vector<KeySym> keys{keySymbolOf(key.getKeyCode())};
    if (mods.isAnyModifierKeyDown()) keys.insert(keys.begin(), mods.isCtrlDown() ? XK_Control_L : XK_Shift_L);
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
    void press(const Key& key) const { type(around.display, key); }
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
    const std::unique_ptr<PluginEditor> editor{
        dynamic_cast<PluginEditor*>(host.plugin->createEditorIfNeeded())};
};

TEST(HostKeys, WhatNoControlUsesReachesTheHostAndEscStays) {
    Embedded embedded;
    auto& [around, host, wrapper, editor] = embedded;
    if (fakeKey == nullptr) GTEST_SKIP() << "libxtst6 is not installed";
    embedded.press(Key{'S', juce::ModifierKeys::ctrlModifier, 0});
    embedded.press(Key{Key::spaceKey});
    embedded.press(Key{Key::F5Key, juce::ModifierKeys::shiftModifier, 0});
    embedded.press(Key{Key::returnKey});
    const auto came = around.keys();
    const std::vector<std::pair<KeySym, unsigned int>> expected{
        {XK_s, ControlMask}, {XK_space, 0}, {XK_F5, ShiftMask}, {XK_Return, 0}};
    EXPECT_EQ(came, expected);
    embedded.handBack(XK_F5);
    EXPECT_TRUE(around.keys().empty()) << "the host gave it, and would for ever";
    embedded.press(Key{Key::escapeKey});
    EXPECT_TRUE(around.keys().empty());
    EXPECT_TRUE(host.plugin->isStopped()) << "Esc silences";
    EXPECT_EQ(host.plugin->parameter(Parameter::bypass).getValue(), 0.0f) << "and no session keeps it";
}

juce::Label* valueIn(juce::Component& in) {
    for (auto* child : in.getChildren()) {
        if (auto* const value = dynamic_cast<juce::Label*>(child);
            value && value->isShowing() && dynamic_cast<juce::Slider*>(&in) != nullptr)
            return value;
        if (auto* const found = valueIn(*child)) return found;
    }
    return nullptr;
}

// Under some window managers the box has no keyboard after a list was open: keys come to the window then.
TEST(HostKeys, AValueThatIsTypedIsTheValuesAndEscClosesItFirst) {
    Embedded embedded;
    auto& [around, host, wrapper, editor] = embedded;
    if (fakeKey == nullptr) GTEST_SKIP() << "libxtst6 is not installed";
    auto* const value = valueIn(*editor);
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
    EXPECT_EQ(value->getCurrentTextEditor(), nullptr);
    EXPECT_NE(value->getText(), before);
    EXPECT_TRUE(around.keys().empty());
    embedded.press(Key{Key::spaceKey});
    EXPECT_EQ(around.keys().size(), 1u) << "after a value the host plays by Space";
    value->showEditor();
    embedded.press(Key{Key::escapeKey});
    EXPECT_EQ(value->getCurrentTextEditor(), nullptr);
    EXPECT_FALSE(host.plugin->isStopped()) << "it closed what was open";
    embedded.press(Key{Key::escapeKey});
    EXPECT_TRUE(host.plugin->isStopped());
    EXPECT_TRUE(around.keys().empty()) << "nothing of it was the host's";
}

TEST(HostKeys, AWindowOfItsOwnHasNoHost) {
    TestHost host;
    const std::unique_ptr<PluginEditor> editor{
        dynamic_cast<PluginEditor*>(host.plugin->createEditorIfNeeded())};
    editor->addToDesktop(0);
    editor->setVisible(true);
    runFor(0.2);
    if (fakeKey == nullptr) GTEST_SKIP() << "libxtst6 is not installed";
    const HostWindow other;
    HostKeys keys;
    const auto own = editor->getPeer()->getNativeHandle();
    keys.watch(own);
    XSetInputFocus(other.display, reinterpret_cast<Window>(own), RevertToParent, CurrentTime);
    type(other.display, Key{'S'});
    EXPECT_FALSE(keys.send(XK_s));
}

} // namespace
} // namespace physvib
