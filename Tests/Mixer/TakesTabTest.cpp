// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings are listed, played on the device, copied and deleted in the window.
#include "Mixer/Output/TakesTab.h"
#include "Live/Recordings/ReadRecording.h"
#include "MixerTesting.h"
#include "Scene/EventsCsv.h"

namespace physvib::takes_tab_test {

using namespace test;

/// Four channels, of which one sounds, in place of any file.
void writeWav(const juce::File& file, int frames, int bits, int channel, auto sampleAt) {
    file.deleteFile();
    juce::AudioBuffer<float> samples{4, frames};
    samples.clear();
    for (int k = 0; k < frames; ++k) samples.setSample(channel, k, sampleAt(k));
    juce::WavAudioFormat wav;
    std::unique_ptr<juce::AudioFormatWriter> writer{
        wav.createWriterFor(file.createOutputStream().release(), 48000.0, 4, bits, {}, 0)};
    ASSERT_NE(writer, nullptr);
    writer->writeFromAudioSampleBuffer(samples, 0, frames);
}

/// The third channel sounds.
void writeTake(const juce::File& file, double seconds) {
    writeWav(file, static_cast<int>(48000 * seconds), 24, 2,
             [](int k) { return 0.3f * std::sin(0.02f * static_cast<float>(k)); });
}

struct ListedTakes : testing::Test {
    TestFolder folder;
    juce::SharedResourcePointer<UserFolder> user;
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{model};
    TakesTab* takes = nullptr;

    ListedTakes() {
        user->choose(folder.folder);
        writeTake(folder("hands-take.wav"), 1.5);
        folder("hands-take.csv").replaceWithText("time_s");
        folder("no take.wav").replaceWithText("text");
        view.scope().choose("Takes");
        takes = view.scope().find<TakesTab>();
    }
    ~ListedTakes() { user->choose({}); }
    juce::ListBox& list() { return the<juce::ListBox>(view, "List of takes"); }
    juce::Button& button(const juce::String& title) { return the<juce::Button>(view, title); }
};

TEST_F(ListedTakes, ListsNamesAndLengthsAndWhatIsRecordedLater) {
    ASSERT_EQ(list().getModel()->getNumRows(), 1) << "no files that cannot be played";
    EXPECT_EQ(list().getModel()->getNameForRow(0), "hands-take, 1.5 s");
    EXPECT_FALSE(button("Play the take on the device").isEnabled()) << "none is chosen";
    runFor(1.1); // the folder's time is of whole seconds on some systems
    writeTake(folder("another.wav"), 75.0);
    EXPECT_TRUE(runUntil([&] { return view.refresh(), list().getModel()->getNumRows() == 2; }, 4.0));
    EXPECT_EQ(list().getModel()->getNameForRow(0), "another, 1:15") << "the newest first";
    writeTake(folder("another.wav"), 59.96);
    takes->rescan();
    EXPECT_EQ(list().getModel()->getNameForRow(0), "another, 1:00") << "not 60.0 s";
}

TEST_F(ListedTakes, ATakeIsPlayedEachChannelOnItsActuatorUntilItIsStopped) {
    writeTake(folder("hands-take.wav"), 60.0);
    takes->rescan();
    takes->choose(0);
    auto& play = button("Play the take on the device");
    const auto isFelt = [&] { return view.refresh(), view.snapshot().meters.peaks[2] > 0.01f; };
    play.onClick();
    EXPECT_TRUE(runUntil(isFelt)) << model.messageText();
    EXPECT_EQ(view.snapshot().meters.peaks[0], 0.0f);
    EXPECT_EQ(play.getButtonText(), "Stop");
    play.onClick();
    EXPECT_TRUE(runUntil([&] { return !isFelt(); })) << "long before its end";
    EXPECT_EQ(play.getButtonText(), "Play");
}

TEST_F(ListedTakes, ATakeIsCopiedAndDeletedWithItsEvents) {
    takes->choose(0);
    button("Copy the take elsewhere").onClick();
    auto* card = dynamic_cast<FileCard*>(view.card());
    ASSERT_NE(card, nullptr);
    EXPECT_EQ(card->name(), "hands-take");
    folder("copies").createDirectory();
    card->openFolder(folder("copies"));
    card->accept();
    ASSERT_TRUE(runUntil([&] { return view.card() == nullptr; }));
    EXPECT_TRUE(folder("copies/hands-take.wav").hasIdenticalContentTo(folder("hands-take.wav")));
    EXPECT_TRUE(folder("copies/hands-take.csv").existsAsFile());
    button("Delete the take").onClick();
    ASSERT_NE(view.question(), nullptr);
    EXPECT_TRUE(folder("hands-take.wav").existsAsFile()) << "not before it was asked";
    view.question()->answer("Delete");
    EXPECT_TRUE(runUntil([&] { return !folder("hands-take.wav").existsAsFile(); }));
    EXPECT_FALSE(folder("hands-take.csv").existsAsFile());
    EXPECT_EQ(list().getModel()->getNumRows(), 0);
}

TEST_F(ListedTakes, WhatIsChosenStaysChosenAndKeepsItsEventsWhereItCannotBeDeleted) {
    takes->choose(0);
    writeTake(folder("another.wav"), 0.1);
    folder("another.wav").setLastModificationTime(juce::Time::getCurrentTime() + juce::RelativeTime{60.0});
    takes->rescan();
    EXPECT_EQ(list().getModel()->getNameForRow(list().getSelectedRow()), "hands-take, 1.5 s");
    folder("hands-take.wav").deleteFile();
    folder("hands-take.wav/inside").createDirectory(); // deleting no folder that is not empty
    button("Delete the take").onClick();
    view.question()->answer("Delete");
    EXPECT_TRUE(runUntil([&] { return list().getModel()->getNumRows() == 1; }));
    EXPECT_EQ(folder("hands-take.csv").existsAsFile(), folder("hands-take.wav").exists());
}

SampledSound soundOf(const juce::File& file) {
    auto sound = readRecording(pathOf(file));
    EXPECT_TRUE(sound) << sound.error;
    return std::move(sound.value);
}

/// Silence, half a second of sound from 0.4 s on, and silence; events before, in and behind it.
void writeSoundInSilence(const juce::File& file) {
    writeWav(file, 72000, 32, 1, [](int k) { return k >= 19200 && k < 43200 ? 0.5f : 0.0f; });
    std::vector<CollisionEvent> events(3);
    for (std::size_t k = 0; k < 3; ++k) {
        events[k].timeNs = static_cast<std::int64_t>(k) * 500'000'000 + 100'000'000;
        events[k].frequencyHz = 100.0;
        events[k].decayPerSecond = 20.0;
        events[k].amplitude = 0.5;
    }
    file.withFileExtension("csv").replaceWithText(utf8(eventsCsv(events, {}, {"test", {}})));
}

struct TrimmedTake : ListedTakes {
    TrimmedTake() {
        writeSoundInSilence(folder("hands-take.wav"));
        takes->rescan();
        takes->choose(0);
    }
    juce::String shown() { return list().getModel()->getNameForRow(0); }
    void trim() {
        button("Trim the take").onClick(); // the levels may not have been read yet
        ASSERT_TRUE(runUntil([&] { return shown() == "hands-take, 0.5 s of 1.5 s"; })) << shown();
    }
};

TEST_F(TrimmedTake, OnePressCutsTheSilenceBeyondTheProgramOfThatTakeAloneAndAnotherTakesItBack) {
    EXPECT_TRUE(button("Trim the take").isEnabled());
    trim();
    EXPECT_EQ(button("Trim the take").getButtonText(), "Whole");
    EXPECT_EQ(soundOf(folder("hands-take.wav")).channels[1].size(), 72000U) << "it stays as it is";
    const auto shownAnew = [&] {
        MixerView later{model};
        later.scope().choose("Takes");
        return the<juce::ListBox>(later, "List of takes").getModel()->getNameForRow(0);
    };
    EXPECT_EQ(shownAnew(), "hands-take, 0.5 s of 1.5 s");
    const auto kept = folder("parts/hands-take.json");
    const auto text = kept.loadFileAsString();
    button("Trim the take").onClick();
    EXPECT_EQ(shown(), "hands-take, 1.5 s");
    EXPECT_EQ(shownAnew(), "hands-take, 1.5 s");
    EXPECT_FALSE(kept.existsAsFile()) << "nothing is left of a trim that was taken back";
    auto& trimmer = the(view, "Start and end of the take");
    trimmer.keyPressed(KeyPress{KeyPress::leftKey, juce::ModifierKeys::shiftModifier, 0});
    EXPECT_EQ(loadPart(folder("hands-take.wav"), 1.5), (juce::Range{0.0, 1.49}));
    EXPECT_EQ(loadPart(folder("hands-take.wav"), 1.6), (juce::Range{0.0, 1.6})) << "another of its name";
    for (const char* broken : {"", "{", "[1]", R"({"from_s": 1, "to_s": 0.5, "of_s": 1.5})",
                               R"({"from_s": 0, "to_s": 2, "of_s": 1.5})", R"({"from_s": "x"})"}) {
        kept.replaceWithText(broken);
        EXPECT_EQ(shownAnew(), "hands-take, 1.5 s") << broken;
    }
    kept.replaceWithText(text);
    takes->erase();
    EXPECT_FALSE(kept.existsAsFile());
}

TEST_F(TrimmedTake, ATrimmedTakeIsExportedWithTheEventsInIt) {
    trim();
    takes->exportTo(folder("part.wav"));
    const auto sound = soundOf(folder("part.wav"));
    ASSERT_EQ(sound.channels.size(), 4U);
    EXPECT_NEAR(static_cast<double>(sound.channels[1].size()), 24000.0, 400.0) << "to a 400th of it";
    EXPECT_EQ(sound.channels[1][12000], 0.5f);
    EXPECT_LT(sound.channels[1].front(), 0.01f) << "no click";
    EXPECT_LT(sound.channels[1].back(), 0.01f);
    const auto events = loadEventsCsv(pathOf(folder("part.csv")));
    ASSERT_TRUE(events) << events.error;
    ASSERT_EQ(events.value.events.size(), 1U);
    EXPECT_NEAR(1e-6 * static_cast<double>(events.value.events[0].timeNs), 200.0, 5.0);
    EXPECT_EQ(soundOf(folder("hands-take.wav")).channels[1].size(), 72000U);
}

TEST_F(TrimmedTake, ATrimmedTakePlaysThatPartFromAFileThatStays) {
    auto& trimmer = the(view, "Start and end of the take");
    ASSERT_TRUE(trimmer.isVisible());
    trimmer.setSize(300, 40);
    trimmer.mouseDown(mouseAt(trimmer, {290.0f, 5.0f}));
    trimmer.mouseDrag(mouseAt(trimmer, {200.0f, 5.0f}));
    EXPECT_EQ(shown(), "hands-take, 1.0 s of 1.5 s");
    trimmer.keyPressed(KeyPress{KeyPress::rightKey});
    trimmer.keyPressed(KeyPress{KeyPress::leftKey, juce::ModifierKeys::shiftModifier, 0});
    takes->play();
    const auto parts = folder("parts").findChildFiles(juce::File::findFiles, false, "*.wav");
    ASSERT_EQ(parts.size(), 1);
    EXPECT_EQ(parts[0].getFileNameWithoutExtension(), "hands-take 10 to 990 ms");
    EXPECT_EQ(soundOf(parts[0]).channels[0].size(), 47040U);
    EXPECT_TRUE(runUntil([&] {
        view.refresh();
        return view.snapshot().meters.peaks[1] > 0.01f;
    })) << model.messageText();
    EXPECT_EQ(list().getModel()->getNumRows(), 1) << "the part is not listed";
    trimmer.mouseDrag(mouseAt(trimmer, {-50.0f, 5.0f}));
    EXPECT_EQ(shown(), "hands-take, 0.0 s of 1.5 s") << "not less than nothing";
    trimmer.mouseDoubleClick(mouseAt(trimmer, {5.0f, 5.0f}));
    EXPECT_EQ(shown(), "hands-take, 1.5 s");
}

TEST_F(TrimmedTake, EventsOfAnotherTakeOrDamagedOnesAreNotTakenForTheCopys) {
    const auto exports = [&] {
        takes->exportTo(folder("part.wav"));
        return std::pair{folder("part.wav").existsAsFile(), folder("part.csv").existsAsFile()};
    };
    folder("part.csv").replaceWithText("another's");
    EXPECT_EQ(exports(), (std::pair{false, true})) << "a list alone is not replaced";
    EXPECT_EQ(folder("part.csv").loadFileAsString(), "another's");
    folder("part.csv").deleteFile();
    trim();
    const auto list = folder("hands-take.csv");
    const auto whole = list.loadFileAsString();
    list.replaceWithText(whole + "0.2,x\n");
    EXPECT_EQ(exports(), (std::pair{false, false})) << "not a copy without events, told as whole";
    list.replaceWithText(whole);
    EXPECT_EQ(exports(), (std::pair{true, true}));
    list.replaceWithText(utf8(eventsCsv({}, {}, {"test", {}})));
    EXPECT_EQ(exports(), (std::pair{true, true}));
    EXPECT_FALSE(folder("part.csv").loadFileAsString().contains("0.2")) << "it felt nothing";
    folder("part.csv").replaceWithText("another's");
    list.deleteFile();
    EXPECT_EQ(exports(), (std::pair{true, false}));
    folder("part.csv").replaceWithText("another's");
    button("Trim the take").onClick();
    EXPECT_EQ(exports(), (std::pair{true, false})) << "nor beside the whole take";
}

TEST_F(TrimmedTake, TwoPartsWithinAMillisecondAreTwoFiles) {
    auto& trimmer = the(view, "Start and end of the take");
    trimmer.setSize(3000, 40); // half a millisecond a pixel
    trimmer.mouseDown(mouseAt(trimmer, {2990.0f, 5.0f}));
    for (const float x : {2001.0f, 2000.6f}) {
        trimmer.mouseDrag(mouseAt(trimmer, {x, 5.0f}));
        takes->play();
    }
    EXPECT_EQ(folder("parts").findChildFiles(juce::File::findFiles, false, "*.wav").size(), 2);
}

TEST(TakesTab, WhatIsSilentThroughoutIsNotTrimmed) {
    EXPECT_EQ(perceptiblePart(std::vector<float>(10, 0.0f), 2.0), (juce::Range{0.0, 2.0}));
    EXPECT_EQ(perceptiblePart({0.0f, 0.5f, 0.0f, 0.002f, 0.0005f}, 5.0), (juce::Range{1.0, 4.0}));
}

} // namespace physvib::takes_tab_test
