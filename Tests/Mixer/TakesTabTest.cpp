// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings are listed, played on the device, copied and deleted in the window.
#include "Mixer/Output/TakesTab.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;

/// Four channels, of which only the third sounds.
void writeTake(const juce::File& file, double seconds) {
    juce::AudioBuffer<float> samples{4, static_cast<int>(48000 * seconds)};
    samples.clear();
    for (int k = 0; k < samples.getNumSamples(); ++k)
        samples.setSample(2, k, 0.3f * std::sin(0.02f * static_cast<float>(k)));
    juce::WavAudioFormat wav;
    std::unique_ptr<juce::AudioFormatWriter> writer{
        wav.createWriterFor(file.createOutputStream().release(), 48000.0, 4, 24, {}, 0)};
    ASSERT_NE(writer, nullptr);
    writer->writeFromAudioSampleBuffer(samples, 0, samples.getNumSamples());
}

struct Taken {
    TestFolder folder;
    juce::SharedResourcePointer<UserFolder> user;
    Desk desk{onlyNoDevice(), noDevice, Desk::firstMix(), {.isPaused = true}};
    MixerView view{desk};
    TakesTab* takes = nullptr;

    Taken() {
        user->choose(folder.folder);
        writeTake(folder("hands-take.wav"), 1.5);
        folder("hands-take.csv").replaceWithText("time_s");
        folder("no take.wav").replaceWithText("text");
        view.scope().choose("Takes");
        takes = dynamic_cast<TakesTab*>(view.scope().find("Takes"));
    }
    ~Taken() { user->choose({}); }
    juce::ListBox& list() { return dynamic_cast<juce::ListBox&>(*find(view, "List of takes")); }
    juce::Button& button(const juce::String& title) {
        return dynamic_cast<juce::Button&>(*find(view, title));
    }
};

TEST(TakesTab, ListsNamesAndLengthsAndWhatIsRecordedLater) {
    Taken taken;
    ASSERT_EQ(taken.list().getModel()->getNumRows(), 1) << "no files that cannot be played";
    EXPECT_EQ(taken.list().getModel()->getNameForRow(0), "hands-take, 1.5 s");
    EXPECT_FALSE(taken.button("Play the take on the device").isEnabled()) << "none is chosen";
    runFor(1.1); // the folder's time is of whole seconds on some systems
    writeTake(taken.folder("another.wav"), 75.0);
    EXPECT_TRUE(
        runUntil([&] { return taken.view.refresh(), taken.list().getModel()->getNumRows() == 2; }, 4.0));
    EXPECT_EQ(taken.list().getModel()->getNameForRow(0), "another, 1:15") << "the newest first";
}

TEST(TakesTab, ATakeIsPlayedEachChannelOnItsActuator) {
    Taken taken;
    taken.takes->choose(0);
    taken.button("Play the take on the device").onClick();
    EXPECT_TRUE(runUntil([&] {
        taken.view.refresh();
        return taken.view.latest().meters.peaks[2] > 0.01f;
    })) << taken.desk.trouble();
    EXPECT_EQ(taken.view.latest().meters.peaks[0], 0.0f);
}

TEST(TakesTab, ATakeIsCopiedAndDeletedWithItsEvents) {
    Taken taken;
    taken.takes->choose(0);
    taken.button("Copy the take elsewhere").onClick();
    auto* card = dynamic_cast<FileCard*>(taken.view.card());
    ASSERT_NE(card, nullptr);
    EXPECT_EQ(card->name(), "hands-take");
    taken.folder("copies").createDirectory();
    card->enter(taken.folder("copies"));
    card->take();
    ASSERT_TRUE(runUntil([&] { return taken.view.card() == nullptr; }));
    EXPECT_TRUE(taken.folder("copies/hands-take.wav").hasIdenticalContentTo(taken.folder("hands-take.wav")));
    EXPECT_TRUE(taken.folder("copies/hands-take.csv").existsAsFile());
    taken.button("Delete the take").onClick();
    ASSERT_NE(taken.view.question(), nullptr);
    EXPECT_TRUE(taken.folder("hands-take.wav").existsAsFile()) << "not before it was asked";
    taken.view.question()->answer("Delete");
    EXPECT_TRUE(runUntil([&] { return !taken.folder("hands-take.wav").existsAsFile(); }));
    EXPECT_FALSE(taken.folder("hands-take.csv").existsAsFile());
    EXPECT_EQ(taken.list().getModel()->getNumRows(), 0);
}

} // namespace
} // namespace physvib
