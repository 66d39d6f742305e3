// SPDX-License-Identifier: GPL-3.0-or-later
// JUCE's message manager for all tests of a program, with or without a display, and what a window needs
// there.
#pragma once
#include "Host/MessageLoop.h"
#include <gtest/gtest.h>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>

namespace physvib::test {

/// From before the first test until after the last one: JUCE's own statics do not outlive those of a program.
class MessageManagerForTests final : public testing::Environment {
public:
    void SetUp() override { initialised_.emplace(); }
    void TearDown() override { initialised_.reset(); }

private:
    std::optional<juce::ScopedJuceInitialiser_GUI> initialised_;
};
inline testing::Environment* const messageManagerForTests =
    testing::AddGlobalTestEnvironment(new MessageManagerForTests);

/// A button, the left one unless another is given, at a place of `c`; pressed there, or elsewhere before.
inline juce::MouseEvent mouseAt(juce::Component& c, juce::Point<float> at,
                                juce::ModifierKeys button = juce::ModifierKeys::leftButtonModifier,
                                std::optional<juce::Point<float>> pressedAt = {}) {
    const auto now = juce::Time::getCurrentTime();
    const auto from = pressedAt.value_or(at);
    return juce::MouseEvent(juce::Desktop::getInstance().getMainMouseSource(), at, button, 0.0f, 0.0f, 0.0f,
                            0.0f, 0.0f, &c, &c, now, from, now, 1, from != at);
}

/// For forms and lists, which are placed on a screen, also where there is none.
struct ScreenForTests {
    ScreenForTests() {
        if (!displays.isEmpty()) return;
        juce::Displays::Display one;
        one.isMain = true;
        one.totalArea = one.userArea = {1920, 1080};
        displays.add(one);
    }
    juce::Array<juce::Displays::Display>& displays =
        const_cast<juce::Displays&>(juce::Desktop::getInstance().getDisplays()).displays;
};

inline juce::StringArray wordsOf(const juce::PopupMenu& menu) {
    juce::StringArray words;
    for (juce::PopupMenu::MenuItemIterator it{menu}; it.next();)
        if (!it.getItem().isSeparator) words.add(it.getItem().text);
    return words;
}

inline juce::PopupMenu::Item itemOf(const juce::PopupMenu& menu, const juce::String& words) {
    for (juce::PopupMenu::MenuItemIterator it{menu, true}; it.next();)
        if (it.getItem().text == words) return it.getItem();
    ADD_FAILURE() << words << " is not among " << wordsOf(menu).joinIntoString(", ");
    return {};
}

inline void press(const juce::PopupMenu& menu, const juce::String& words) {
    const auto item = itemOf(menu, words);
    ASSERT_TRUE(item.isEnabled && item.action) << words;
    item.action();
}

/// Another home folder for the test.
class Home {
public:
    explicit Home(const juce::File& home)
        : before_{juce::SystemStats::getEnvironmentVariable("HOME", {})} {
        setenv("HOME", home.getFullPathName().toRawUTF8(), 1);
    }
    ~Home() { setenv("HOME", before_.toRawUTF8(), 1); }

private:
    juce::String before_;
};

} // namespace physvib::test
