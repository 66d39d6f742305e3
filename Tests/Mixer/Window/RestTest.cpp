// SPDX-License-Identifier: GPL-3.0-or-later
// What a window costs at which nothing happens: its timers wake no more than its pictures do.
#include "../MixerTesting.h"
#include "Mixer/Window/MixerWindow.h"

namespace physvib {
namespace {

using namespace test;

/// Of the thread that wakes for JUCE's timers; -1: not found.
std::int64_t wakingsOfTimers() {
    for (const auto& task : juce::File{"/proc/self/task"}.findChildFiles(juce::File::findDirectories, false))
        if (task.getChildFile("comm").loadFileAsString().trim() == "JUCE Timer")
            for (const auto& line :
                 juce::StringArray::fromLines(task.getChildFile("status").loadFileAsString()))
                if (line.startsWith("voluntary_ctxt_switches:"))
                    return line.fromFirstOccurrenceOf(":", false, false).trim().getLargeIntValue();
    return -1;
}

TEST(Rest, APausedWindowWakesForItsPicturesAndHardlyForAnythingElse) {
    constexpr double seconds = 3.0;
    constexpr int ofAPicture = 4; // JUCE wakes that thread so often for each timer that is due
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    window.desk().setSlowness(0);
    runFor(2.0); // until what rang is silent
    std::int64_t pictures = 0;
    const juce::VBlankAttachment count{&window, [&pictures] { ++pictures; }};
    const auto before = wakingsOfTimers();
    ASSERT_GE(before, 0);
    runFor(seconds);
    const auto wakings = wakingsOfTimers() - before;
    std::cout << pictures / seconds << " pictures a second, " << wakings / seconds << " wakings\n";
    EXPECT_GT(pictures, 20);
    EXPECT_LT(wakings, ofAPicture * pictures * 12 / 10);
}

} // namespace
} // namespace physvib
