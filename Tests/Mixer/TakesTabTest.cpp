// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings are listed, played on the device, copied and deleted in the window.
#include "Mixer/Output/TakesTab.h"
#include "Live/Recordings/ReadRecording.h"
#include "MixerTesting.h"
#include "Scene/EventsCsv.h"

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
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::firstMix(), {.isPaused = true}};
    MixerView view{model};
    TakesTab* takes = nullptr;

    Taken() {
        user->choose(folder.folder);
        writeTake(folder("hands-take.wav"), 1.5);
        folder("hands-take.csv").replaceWithText("time_s");
        folder("no take.wav").replaceWithText("text");
        view.scope().choose("Takes");
        takes = view.scope().find<TakesTab>();
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

TEST(TakesTab, ATakeIsPlayedEachChannelOnItsActuatorUntilItIsStopped) {
    Taken taken;
    taken.folder("hands-take.wav").deleteFile();
    writeTake(taken.folder("hands-take.wav"), 60.0);
    taken.takes->look();
    taken.takes->choose(0);
    auto& play = taken.button("Play the take on the device");
    const auto isFelt = [&] { return taken.view.refresh(), taken.view.latest().meters.peaks[2] > 0.01f; };
    play.onClick();
    EXPECT_TRUE(runUntil(isFelt)) << taken.model.trouble();
    EXPECT_EQ(taken.view.latest().meters.peaks[0], 0.0f);
    EXPECT_EQ(play.getButtonText(), "Stop");
    play.onClick();
    EXPECT_TRUE(runUntil([&] { return !isFelt(); })) << "long before its end";
    EXPECT_EQ(play.getButtonText(), "Play");
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
    card->accept();
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

SampledSound soundOf(const juce::File& file) {
    auto sound = readRecording(file.getFullPathName().toStdString());
    EXPECT_TRUE(sound) << sound.error;
    return std::move(sound.value);
}

/// Silence, half a second of sound from 0.4 s on, and silence; events before, in and behind it.
void writeSoundInSilence(const juce::File& file) {
    juce::AudioBuffer<float> samples{4, 72000};
    samples.clear();
    for (int k = 19200; k < 43200; ++k) samples.setSample(1, k, 0.5f);
    juce::WavAudioFormat wav;
    std::unique_ptr<juce::AudioFormatWriter> writer{
        wav.createWriterFor(file.createOutputStream().release(), 48000.0, 4, 32, {}, 0)};
    ASSERT_NE(writer, nullptr);
    writer->writeFromAudioSampleBuffer(samples, 0, samples.getNumSamples());
    std::vector<CollisionEvent> events(3);
    for (std::size_t k = 0; k < 3; ++k) {
        events[k].timeNs = static_cast<std::int64_t>(k) * 500'000'000 + 100'000'000;
        events[k].frequencyHz = 100.0;
        events[k].decayPerSecond = 20.0;
        events[k].amplitude = 0.5;
    }
    file.withFileExtension("csv").replaceWithText(utf8(eventsCsv(events, {}, {"test", {}})));
}

struct Trimmed : Taken {
    Trimmed() {
        folder("hands-take.wav").deleteFile();
        writeSoundInSilence(folder("hands-take.wav"));
        takes->look();
        takes->choose(0);
    }
    juce::String shown() { return list().getModel()->getNameForRow(0); }
};

TEST(TakesTab, OnePressCutsTheSilenceAndAnotherTakesItBack) {
    Trimmed t;
    auto& trim = t.button("Trim the take");
    EXPECT_TRUE(t.button("Trim the take").isEnabled());
    trim.onClick(); // the levels may not have been read yet
    ASSERT_TRUE(runUntil([&] { return t.shown() == "hands-take, 0.5 s of 1.5 s"; })) << t.shown();
    EXPECT_EQ(trim.getButtonText(), "Whole");
    EXPECT_EQ(soundOf(t.folder("hands-take.wav")).channels[1].size(), 72000U) << "it stays as it is";
    trim.onClick();
    EXPECT_EQ(t.shown(), "hands-take, 1.5 s");
}

TEST(TakesTab, ATrimLastsBeyondTheProgramAndIsOfThatTakeAlone) {
    Trimmed t;
    auto& trim = t.button("Trim the take");
    trim.onClick();
    ASSERT_TRUE(runUntil([&] { return t.shown().contains("of"); }));
    const auto shownAnew = [&] {
        MixerView later{t.model};
        later.scope().choose("Takes");
        return dynamic_cast<juce::ListBox&>(*find(later, "List of takes")).getModel()->getNameForRow(0);
    };
    EXPECT_EQ(shownAnew(), "hands-take, 0.5 s of 1.5 s");
    const auto kept = t.folder("parts/hands-take.json");
    const auto text = kept.loadFileAsString();
    trim.onClick();
    EXPECT_EQ(shownAnew(), "hands-take, 1.5 s");
    EXPECT_FALSE(kept.existsAsFile()) << "nothing is left of a trim that was taken back";
    auto* trimmer = find(t.view, "Start and end of the take");
    trimmer->keyPressed(juce::KeyPress{juce::KeyPress::leftKey, juce::ModifierKeys::shiftModifier, 0});
    EXPECT_EQ(keptPart(t.folder("hands-take.wav"), 1.5), (juce::Range{0.0, 1.49}));
    EXPECT_EQ(keptPart(t.folder("hands-take.wav"), 1.6), (juce::Range{0.0, 1.6})) << "another of its name";
    for (const char* broken : {"", "{", "[1]", R"({"from_s": 1, "to_s": 0.5, "of_s": 1.5})",
                               R"({"from_s": 0, "to_s": 2, "of_s": 1.5})", R"({"from_s": "x"})"}) {
        kept.replaceWithText(broken);
        EXPECT_EQ(shownAnew(), "hands-take, 1.5 s") << broken;
    }
    kept.replaceWithText(text);
    t.takes->erase();
    EXPECT_FALSE(kept.existsAsFile());
}

TEST(TakesTab, ATrimmedTakeIsExportedWithTheEventsInIt) {
    Trimmed t;
    t.button("Trim the take").onClick();
    ASSERT_TRUE(runUntil([&] { return t.shown().contains("of"); }));
    t.takes->exportTo(t.folder("part.wav"));
    const auto sound = soundOf(t.folder("part.wav"));
    ASSERT_EQ(sound.channels.size(), 4U);
    EXPECT_NEAR(static_cast<double>(sound.channels[1].size()), 24000.0, 400.0) << "to a 400th of it";
    EXPECT_EQ(sound.channels[1][12000], 0.5f);
    EXPECT_LT(sound.channels[1].front(), 0.01f) << "no click";
    EXPECT_LT(sound.channels[1].back(), 0.01f);
    const auto events = loadEventsCsv(t.folder("part.csv").getFullPathName().toStdString());
    ASSERT_TRUE(events) << events.error;
    ASSERT_EQ(events.value.events.size(), 1U);
    EXPECT_NEAR(1e-6 * static_cast<double>(events.value.events[0].timeNs), 200.0, 5.0);
    EXPECT_EQ(soundOf(t.folder("hands-take.wav")).channels[1].size(), 72000U);
}

TEST(TakesTab, ATrimmedTakePlaysThatPartFromAFileThatStays) {
    Trimmed t;
    auto* trimmer = find(t.view, "Start and end of the take");
    ASSERT_TRUE(trimmer->isVisible());
    trimmer->setSize(300, 40);
    trimmer->mouseDown(mouseAt(*trimmer, {290.0f, 5.0f}));
    trimmer->mouseDrag(mouseAt(*trimmer, {200.0f, 5.0f}));
    EXPECT_EQ(t.shown(), "hands-take, 1.0 s of 1.5 s");
    trimmer->keyPressed(juce::KeyPress{juce::KeyPress::rightKey});
    trimmer->keyPressed(juce::KeyPress{juce::KeyPress::leftKey, juce::ModifierKeys::shiftModifier, 0});
    t.takes->play();
    const auto parts = t.folder("parts").findChildFiles(juce::File::findFiles, false, "*.wav");
    ASSERT_EQ(parts.size(), 1);
    EXPECT_EQ(parts[0].getFileNameWithoutExtension(), "hands-take 10 to 990 ms");
    EXPECT_EQ(soundOf(parts[0]).channels[0].size(), 47040U);
    EXPECT_TRUE(runUntil([&] {
        t.view.refresh();
        return t.view.latest().meters.peaks[1] > 0.01f;
    })) << t.model.trouble();
    EXPECT_EQ(t.list().getModel()->getNumRows(), 1) << "the part is not listed";
    trimmer->mouseDrag(mouseAt(*trimmer, {-50.0f, 5.0f}));
    EXPECT_EQ(t.shown(), "hands-take, 0.0 s of 1.5 s") << "not less than nothing";
    trimmer->mouseDoubleClick(mouseAt(*trimmer, {5.0f, 5.0f}));
    EXPECT_EQ(t.shown(), "hands-take, 1.5 s");
}

TEST(TakesTab, EventsOfAnotherTakeOrDamagedOnesAreNotTakenForTheCopys) {
    Trimmed t;
    const auto exports = [&t] {
        t.takes->exportTo(t.folder("part.wav"));
        return std::pair{t.folder("part.wav").existsAsFile(), t.folder("part.csv").existsAsFile()};
    };
    t.folder("part.csv").replaceWithText("another's");
    EXPECT_EQ(exports(), (std::pair{false, true})) << "a list alone is not replaced";
    EXPECT_EQ(t.folder("part.csv").loadFileAsString(), "another's");
    t.folder("part.csv").deleteFile();
    t.button("Trim the take").onClick();
    ASSERT_TRUE(runUntil([&] { return t.shown().contains("of"); }));
    const auto list = t.folder("hands-take.csv");
    const auto whole = list.loadFileAsString();
    list.replaceWithText(whole + "0.2,x\n");
    EXPECT_EQ(exports(), (std::pair{false, false})) << "not a copy without events, told as whole";
    list.replaceWithText(whole);
    EXPECT_EQ(exports(), (std::pair{true, true}));
    list.replaceWithText(utf8(eventsCsv({}, {}, {"test", {}})));
    EXPECT_EQ(exports(), (std::pair{true, true}));
    EXPECT_FALSE(t.folder("part.csv").loadFileAsString().contains("0.2")) << "it felt nothing";
    t.folder("part.csv").replaceWithText("another's");
    list.deleteFile();
    EXPECT_EQ(exports(), (std::pair{true, false}));
    t.folder("part.csv").replaceWithText("another's");
    t.button("Trim the take").onClick();
    EXPECT_EQ(exports(), (std::pair{true, false})) << "nor beside the whole take";
}

TEST(TakesTab, TwoPartsWithinAMillisecondAreTwoFiles) {
    Trimmed t;
    auto* trimmer = find(t.view, "Start and end of the take");
    trimmer->setSize(3000, 40); // half a millisecond a pixel
    trimmer->mouseDown(mouseAt(*trimmer, {2990.0f, 5.0f}));
    for (const float x : {2001.0f, 2000.6f}) {
        trimmer->mouseDrag(mouseAt(*trimmer, {x, 5.0f}));
        t.takes->play();
    }
    EXPECT_EQ(t.folder("parts").findChildFiles(juce::File::findFiles, false, "*.wav").size(), 2);
}

TEST(TakesTab, AMinuteIsNotSixtySeconds) {
    Taken taken;
    taken.folder("hands-take.wav").deleteFile();
    writeTake(taken.folder("hands-take.wav"), 59.96);
    taken.takes->look();
    EXPECT_EQ(taken.list().getModel()->getNameForRow(0), "hands-take, 1:00");
}

TEST(TakesTab, WhatIsSilentThroughoutIsNotTrimmed) {
    EXPECT_EQ(soundingPart(std::vector<float>(10, 0.0f), 2.0), (juce::Range{0.0, 2.0}));
    EXPECT_EQ(soundingPart({0.0f, 0.5f, 0.0f, 0.002f, 0.0005f}, 5.0), (juce::Range{1.0, 4.0}));
}

} // namespace
} // namespace physvib
