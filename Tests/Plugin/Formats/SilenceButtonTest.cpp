// SPDX-License-Identifier: GPL-3.0-or-later
// SILENCE clicked in a module's window in its host: it stays pressed, and nothing moves. Needs a display.
#include "Plugin/Formats/Player.h"
#include "Plugin/PluginTesting.h"
#include "PluginEditor.h"
#include <cstdlib>
#include <filesystem>
// X11's macros come last
#include "Plugin/Formats/DisplayNames.h"

namespace physvib::silence_button_test {

using namespace test;

/// Where the button is in a window of that size; the module's own cannot be looked into.
juce::Point<int> placeOfSilence(int width, int height) {
    PluginProcessor plugin{"PhysVib", BusPlan{}};
    const std::unique_ptr<juce::AudioProcessorEditor> editor{plugin.createEditorIfNeeded()};
    editor->setSize(width, height);
    auto* const button = buttonOf(*editor, "SILENCE");
    return button ? editor->getLocalPoint(button, button->getLocalBounds().getCentre()) : juce::Point<int>{};
}

/// The innermost window: hosts and formats nest it in others, below one of a pixel for the keyboard.
Window innermost(Display* display, Window window) {
    Window root = 0, parent = 0, *children = nullptr;
    unsigned int count = 0;
    if (XQueryTree(display, window, &root, &parent, &children, &count) == 0 || count == 0) return window;
    const Window child = children[0];
    XFree(children);
    return innermost(display, child);
}

// The pointer goes there, and nothing lies between press and release: a button elsewhere is let go.
void click(Display* display, Window window, juce::Point<int> at) {
    XWarpPointer(display, 0, window, 0, 0, 0, 0, at.x, at.y);
    XSync(display, 0);
    runFor(0.3);
    XEvent event{};
    event.xbutton.window = window;
    event.xbutton.root = DefaultRootWindow(display);
    event.xbutton.x = at.x;
    event.xbutton.y = at.y;
    event.xbutton.button = Button1;
    event.xbutton.same_screen = 1;
    for (const auto& [type, mask, state] :
         {std::tuple{ButtonPress, ButtonPressMask, 0}, {ButtonRelease, ButtonReleaseMask, Button1Mask}}) {
        event.type = type;
        event.xbutton.state = static_cast<unsigned int>(state);
        XSendEvent(display, window, 1, mask, &event);
    }
    XSync(display, 0);
    runFor(0.3);
}

/// Closes a window when the host has no message left: JUCE's host of LV2 posts itself one at each change of
/// the window's size (XEmbedComponent, ConfigureNotify), and does not take it back with the window.
void close(std::unique_ptr<juce::AudioProcessorEditor> editor) {
    while (juce::dispatchNextMessageOnSystemQueue(true)) continue;
    editor.reset();
}

void expectTheButtonSilences(Kind kind, Display* display) {
    Player player{kind};
    player.load(playing());
    player.prepare(true);
    EXPECT_TRUE(player.isFelt());
    std::unique_ptr<juce::AudioProcessorEditor> editor{player.plugin().createEditorIfNeeded()};
    ASSERT_NE(editor, nullptr);
    editor->addToDesktop(0);
    editor->setVisible(true);
    runFor(1.0);
    const auto window =
        innermost(display, static_cast<Window>(reinterpret_cast<std::uintptr_t>(editor->getWindowHandle())));
    const auto place = placeOfSilence(editor->getWidth(), editor->getHeight());
    click(display, window, place);
    EXPECT_EQ(player.peakOf(40, block + ramp), 0.0f);
    click(display, window, place);
    EXPECT_TRUE(player.isFelt()) << "clicked again";
    close(std::move(editor));
}

TEST(SilenceButton, InEveryFormatsWindow) {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "there is no display";
    Display* const display = openDisplayWithNames();
    for (const auto kind : {Kind::processor, Kind::vst3, Kind::lv2}) {
        SCOPED_TRACE(static_cast<int>(kind));
        expectTheButtonSilences(kind, display);
    }
    XCloseDisplay(display);
}

TEST(SilenceButton, WindowsThatAreOpenedAgainAndAgainKeepNoThreadAndNoDescriptor) {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "there is no display";
    Display* const display = openDisplayWithNames();
    const auto held = [](const char* folder) {
        return std::distance(std::filesystem::directory_iterator{folder}, {});
    };
    for (const auto kind : {Kind::processor, Kind::vst3, Kind::lv2}) {
        Player player{kind};
        player.load(playing());
        player.prepare(true);
        std::pair<std::ptrdiff_t, std::ptrdiff_t> before, now;
        for (int opening = 0; opening < 25; ++opening) {
            std::unique_ptr<juce::AudioProcessorEditor> editor{player.plugin().createEditorIfNeeded()};
            editor->addToDesktop(0);
            editor->setVisible(true);
            EXPECT_LE(player.peakOf(2), 1.0f);
            runFor(0.04);
            EXPECT_TRUE(editor->isShowing());
            close(std::move(editor));
            runFor(0.02);
            now = {held("/proc/self/task"), held("/proc/self/fd")};
            if (opening == 5) before = now;
        }
        EXPECT_EQ(now, before) << static_cast<int>(kind);
    }
    XCloseDisplay(display);
}

} // namespace physvib::silence_button_test
