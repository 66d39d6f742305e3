// SPDX-License-Identifier: GPL-3.0-or-later
// The desk and its window in tests: a clock instead of a device, and JUCE's message loop for a while.
#pragma once
#include "Host/NoDevice.h"
#include "Mixer/MixerView.h"
#include <functional>
#include <gtest/gtest.h>
#include <juce_audio_formats/juce_audio_formats.h>
#include <optional>

namespace juce {
bool dispatchNextMessageOnSystemQueue(bool returnIfNoPendingMessages); // what a message loop is made of
}

namespace physvib::test {

/// JUCE's message manager, from before the first test until after the last one.
class MessageManagerForTests final : public testing::Environment {
public:
    void SetUp() override { initialised_.emplace(); }
    void TearDown() override { initialised_.reset(); }

private:
    std::optional<juce::ScopedJuceInitialiser_GUI> initialised_;
};
inline testing::Environment* const messageManagerForTests = testing::AddGlobalTestEnvironment(new MessageManagerForTests);

/// Runs the message loop until `isTrue`, at most `seconds`; whether it became true.
inline bool runUntil(const std::function<bool()>& isTrue, double seconds = 20.0) {
    for (const double end = juce::Time::getMillisecondCounterHiRes() + 1e3 * seconds; juce::Time::getMillisecondCounterHiRes() < end;) {
        if (isTrue()) return true;
        if (!juce::dispatchNextMessageOnSystemQueue(true)) juce::Thread::sleep(1);
    }
    return isTrue();
}
inline void runFor(double seconds) {
    runUntil([] { return false; }, seconds);
}

inline AudioDeviceTypes onlyNoDevice() {
    return [] {
        std::vector<std::unique_ptr<juce::AudioIODeviceType>> types;
        types.push_back(std::make_unique<NoDeviceType>());
        return types;
    };
}
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

} // namespace physvib::test
