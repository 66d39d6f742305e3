// SPDX-License-Identifier: GPL-3.0-or-later
// The model and its window in tests: a clock instead of a device, and JUCE's message loop for a while.
#pragma once
#include "Host/MessageManagerForTests.h"
#include "Mixer/OnlyNoDevice.h"
#include "Mixer/Window/MixerView.h"
#include <gtest/gtest.h>
#include <juce_audio_formats/juce_audio_formats.h>
#include <optional>
#include <stdexcept>

namespace physvib::test {

using juce::KeyPress;

/// As in a program of its own, JUCE bears errors of X: a display without a window manager lacks properties.
inline const bool isProgram = (
    juce::JUCEApplicationBase::createInstance =
        [] { return static_cast<juce::JUCEApplicationBase*>(nullptr); },
    true);

inline const DeviceChoice noDevice{std::string{nullDeviceType} + ":" + nullDeviceName, 48000, 128};

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

/// The same, of a class; throws where there is none.
template <class T = juce::Component>
T& the(juce::Component& root, const juce::String& title) {
    if (auto* const found = dynamic_cast<T*>(find(root, title))) return *found;
    throw std::invalid_argument{title.toStdString() + " is not there, or of another class"};
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

/// Another scene, as a choice from a list gives.
inline void setScene(MixerModel& model, const Scene& scene) {
    model.change("Scene", [&scene](Mix& mix) { mix.scene = std::make_shared<const Scene>(scene); });
}

/// Other actuators, as a choice from the list of presets gives.
inline void setLayout(Mix& mix, std::string_view preset) {
    mix.layout = presetLayout(preset);
    mix.resizeStrips();
}

/// A mixer without a device in its view.
struct MixerInView {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};

    /// What has changed is shown.
    void show() {
        model.dispatchPendingMessages();
        view.refresh();
    }
    juce::Button& button(const juce::String& title) { return the<juce::Button>(view, title); }
};

} // namespace physvib::test
