// SPDX-License-Identifier: GPL-3.0-or-later
// The model and its window in tests: a clock instead of a device, and JUCE's message loop for a while.
#pragma once
#include "Host/MessageManagerForTests.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Window/MixerView.h"
#include <gtest/gtest.h>
#include <juce_audio_formats/juce_audio_formats.h>

namespace physvib::test {

/// As in a program of its own, JUCE bears errors of X: a display without a window manager lacks properties.
inline const bool isProgram = (
    juce::JUCEApplicationBase::createInstance =
        [] { return static_cast<juce::JUCEApplicationBase*>(nullptr); },
    true);

inline const DeviceChoice noDevice{std::string{noDeviceType} + ":" + noDeviceName, 48000, 128};

/// A folder that is gone afterwards.
struct TestFolder {
    juce::File folder = juce::File::createTempFile("physvib-mixer-test");
    TestFolder() { folder.createDirectory(); }
    ~TestFolder() { folder.deleteRecursively(); }
    juce::File operator()(const juce::String& name) const { return folder.getChildFile(name); }
};

/// The first component of that title under `root`; null if there is none.
inline juce::Component* find(juce::Component& root, const juce::String& title) {
    if (root.getTitle() == title) return &root;
    for (auto* child : root.getChildren())
        if (auto* found = find(*child, title)) return found;
    return nullptr;
}

/// Chooses the entry that begins with `words`, as a hand does. Its whole text.
inline juce::String chooseIn(juce::Component& view, const juce::String& title, const juce::String& words) {
    auto* const list = dynamic_cast<juce::ComboBox*>(find(view, title));
    juce::String all;
    for (int k = 0; list != nullptr && k < list->getNumItems(); ++k) {
        const auto entry = list->getItemText(k);
        if (entry.startsWith(words)) return list->setSelectedItemIndex(k, juce::sendNotificationSync), entry;
        all << entry << "\n";
    }
    ADD_FAILURE() << title << " has no " << words << " but\n" << all;
    return {};
}

/// A button, the left one unless told, at a place of `c`.
inline juce::MouseEvent mouseAt(juce::Component& c, juce::Point<float> at,
                                juce::ModifierKeys button = juce::ModifierKeys::leftButtonModifier) {
    const auto now = juce::Time::getCurrentTime();
    return {juce::Desktop::getInstance().getMainMouseSource(),
            at,
            button,
            0.0f,
            0.0f,
            0.0f,
            0.0f,
            0.0f,
            &c,
            &c,
            now,
            at,
            now,
            1,
            false};
}

} // namespace physvib::test
