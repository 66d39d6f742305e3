// SPDX-License-Identifier: GPL-3.0-or-later
// What is chosen in the list of events, dragged out or saved: those contacts alone, from the first on, on the
// enchanters that are there.
#include "Mixer/Output/EventsTab.h"
#include "Core/NameNumbers.h"
#include "Live/Recordings/ReadRecording.h"
#include "Mixer/Model/MixerRecording.h"
#include "MixerTesting.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::events_tab_test {

using namespace test;

/// Nothing is struck but what the test strikes.
Mix emptyBox() {
    Mix mix = MixerModel::defaultMix();
    Scene scene = *mix.scene;
    scene.bodies.clear();
    scene.joints.clear();
    scene.script.clear();
    mix.scene = std::make_shared<const Scene>(scene);
    return mix;
}

class EventsTabTest : public testing::Test {
protected:
    EventsTabTest() { view.scope().choose("Events"); }

    void strike(double shareX, double shareY) {
        const auto sounds = std::ranges::find_if(model.world().scene().materials,
                                                 [](const Material& m) { return m.frequencyHz > 0.0; });
        ASSERT_EQ(model.eventPlayer().audition(
                      static_cast<int>(sounds - model.world().scene().materials.begin()), shareX, shareY),
                  "");
    }
    /// One after the other, so that each is later than the one before.
    void strikeInTurn(std::initializer_list<juce::Point<double>> shares) {
        for (const auto& at : shares) {
            const int rows = list.getModel()->getNumRows();
            strike(at.x, at.y);
            ASSERT_TRUE(runUntil([&] { return view.refresh(), list.getModel()->getNumRows() > rows; }));
        }
    }
    std::vector<juce::File> drag() {
        juce::StringArray addresses;
        bool mayBeMoved = true;
        const juce::DragAndDropTarget::SourceDetails details{
            list.getModel()->getDragSourceDescription(list.getSelectedRows()), &list, {}};
        const bool hasFiles = view.shouldDropFilesWhenDraggedExternally(details, addresses, mayBeMoved);
        EXPECT_EQ(hasFiles, !addresses.isEmpty());
        EXPECT_TRUE(!hasFiles || !mayBeMoved);
        std::vector<juce::File> files;
        for (const auto& address : addresses) files.push_back(juce::URL{address}.getLocalFile());
        return files;
    }
    /// What Eq. 5.1 says of these rows, from the first of them on.
    double valueAt(const std::vector<int>& rows, std::size_t channel, std::int64_t frame) {
        const auto& recent = model.recentContacts().newestFirst();
        const std::int64_t first = recent[static_cast<std::size_t>(rows.back())].event.timeNs; // the oldest
        double sum = 0.0;
        for (const int row : rows) {
            const CollisionEvent& e = nth(recent, row).event;
            const double t =
                static_cast<double>(frame) / 48000.0 - 1e-9 * static_cast<double>(e.timeNs - first);
            PhantomPanner::Gains gains{};
            model.mix().panner().gainsAt(e.x, e.y, gains);
            const bool rings =
                t >= 0.0 && (e.durationNs == 0 || t < 1e-9 * static_cast<double>(e.durationNs));
            if (rings)
                sum += e.amplitude * gains[channel] * std::sin(2.0 * std::numbers::pi * e.frequencyHz * t) *
                       std::exp(-e.decayPerSecond * t);
        }
        return sum;
    }
    double farthest(const SampledSound& sound, const std::vector<int>& rows) {
        double most = 0.0;
        for (std::size_t j = 0; j < sound.channels.size(); ++j)
            for (std::size_t i = 0; i < sound.channels[j].size(); ++i)
                most = std::max(
                    most, std::abs(sound.channels[j][i] - valueAt(rows, j, static_cast<std::int64_t>(i))));
        return most;
    }
    void chooseFormat(const juce::String& ending) {
        the<juce::ComboBox>(view, "Dragged as")
            .setSelectedItemIndex(hitFileExtensions().indexOf(ending), juce::sendNotificationSync);
    }
    EventsTab& tab() { return *view.scope().find<EventsTab>(); }

    MixerModel model{onlyNoDevice(), noDevice, emptyBox()};
    MixerView view{model};
    juce::ListBox& list = the<juce::ListBox>(view, "List of played events");
};

TEST_F(EventsTabTest, WhatIsDraggedOutIsTheChosenHitsAloneSampleBySample) {
    strikeInTurn({{0.1, 0.9}, {0.9, 0.1}, {0.5, 0.2}, {0.2, 0.5}});
    list.selectRow(0);
    list.selectRow(2, true, false); // not the one between them, not the first of all
    const auto files = drag();
    ASSERT_EQ(files.size(), 1U);
    EXPECT_TRUE(files[0].hasFileExtension(".wav"));
    const auto sound = readRecording(pathOf(files[0]));
    ASSERT_TRUE(sound) << sound.error;
    EXPECT_EQ(sound.value.sampleRateHz, 48000);
    EXPECT_EQ(sound.value.channels.size(), 4U);
    EXPECT_LT(farthest(sound.value, {0, 2}), 1e-6);
    EXPECT_GT(farthest(sound.value, {0, 1}), 1e-3) << "the other would be told from it";
}

TEST_F(EventsTabTest, AClipHasTheSameWithChannelsAndPlaces) {
    strikeInTurn({{0.1, 0.9}, {0.6, 0.3}});
    list.selectRow(0);
    list.selectRow(1, true, false);
    chooseFormat(".hjif");
    const auto files = drag();
    ASSERT_EQ(files.size(), 1U);
    const auto path = pathOf(files[0]);
    const auto clip = loadClip(path, *findClipFormat(path));
    ASSERT_TRUE(clip) << clip.error;
    ASSERT_EQ(clip.value.channels.size(), 4U);
    EXPECT_EQ(clip.value.channels[3].label, "D");
    EXPECT_NEAR(clip.value.channels[1].place->xMetres, 0.12, 1e-3) << "of a grid of whole millimetres";
    const auto sound = readRecording(path);
    ASSERT_TRUE(sound) << sound.error;
    EXPECT_LT(farthest(sound.value, {0, 1}), 0.02) << ": 2 hits of at most 0.5, 0.004 of it each";
}

TEST_F(EventsTabTest, WhatIsChosenStaysChosenHoweverManyFollow) {
    strikeInTurn({{0.1, 0.9}, {0.9, 0.1}});
    list.selectRow(1);
    const auto name = list.getModel()->getNameForRow(1);
    strikeInTurn({{0.5, 0.5}});
    ASSERT_EQ(list.getNumSelectedRows(), 1);
    EXPECT_EQ(list.getSelectedRow(), 2);
    EXPECT_EQ(list.getModel()->getNameForRow(2), name);
    for (int k = 0; k < static_cast<int>(RecentContacts::maxContacts); ++k) strike(0.5, 0.5);
    ASSERT_TRUE(runUntil([&] {
        return view.refresh(), list.getSelectedRow() == static_cast<int>(RecentContacts::maxContacts) + 2;
    })) << "behind the last hundred";
    EXPECT_EQ(list.getModel()->getNameForRow(list.getSelectedRow()), name);
    EXPECT_EQ(drag().size(), 1U);
    list.deselectAllRows();
    strike(0.5, 0.5);
    EXPECT_TRUE(runUntil([&] {
        return view.refresh(), list.getModel()->getNumRows() == static_cast<int>(RecentContacts::maxContacts);
    }));
}

TEST_F(EventsTabTest, IsSavedInEveryFormatOrRefusedInALine) {
    TestFolder folder;
    strikeInTurn({{0.1, 0.9}});
    list.selectRow(0);
    for (const auto& ending : hitFileExtensions()) {
        tab().saveTo(folder("one" + ending));
        EXPECT_TRUE(model.isInfo()) << model.messageText();
        const auto files = folder.folder.findChildFiles(juce::File::findFiles, false, "one*" + ending);
        EXPECT_EQ(files.isEmpty(), false) << ending;
        for (const auto& file : files)
            if (ending == ".envelope") // which is for phones alone
                EXPECT_TRUE(file.loadFileAsString().contains("\"effects\"")) << file.getFileName();
            else
                EXPECT_TRUE(readRecording(pathOf(file))) << file.getFileName();
    }
    EXPECT_TRUE(folder("one-A.haptic").existsAsFile()) << "one channel each";
    tab().saveTo(folder("one.haptic"));
    EXPECT_TRUE(model.messageText().contains("is there already")) << model.messageText();
    tab().saveTo(folder("one.mp3"));
    EXPECT_TRUE(
        model.messageText().endsWith("expected a name that ends in .wav, .hjif, .haptic, .ahap, .envelope"))
        << model.messageText();
    EXPECT_FALSE(folder("one.mp3").exists());
    chooseFormat(".hjif");
    tab().saveTo(folder("two"));
    EXPECT_TRUE(folder("two.hjif").existsAsFile()) << model.messageText();
    tab().saveTo(folder("no/such/folder.wav"));
    EXPECT_FALSE(model.isInfo());
}

TEST(HitFiles, AClipIsNoHitAndNothingIsWritten) {
    TestFolder folder;
    CollisionEvent clip;
    clip.sound = soundOfClip(3);
    const auto written = writeHits({clip}, MixerModel::defaultMix(), 48000, folder("a.wav"));
    EXPECT_EQ(written.error, "Chosen contacts: expected hits, found a clip, which is a file already");
    EXPECT_EQ(writeHits({}, MixerModel::defaultMix(), 48000, folder("a.wav")).error,
              "Chosen contacts: expected one whose grains are still kept");
    EXPECT_FALSE(folder("a.wav").exists());
}

TEST_F(EventsTabTest, NothingChosenAndOtherDragsLeaveNoFiles) {
    strikeInTurn({{0.1, 0.9}});
    EXPECT_TRUE(drag().empty());
    list.selectRow(0);
    juce::StringArray files;
    bool mayBeMoved = false;
    EXPECT_FALSE(view.shouldDropFilesWhenDraggedExternally({WorldView::newActuatorDrag, &list, {}}, files,
                                                           mayBeMoved));
    EXPECT_EQ(model.messageText(), "");
}

TEST(DraggedFiles, AreThereUntilTheMixerEnds) {
    juce::File folder;
    {
        const juce::SharedResourcePointer<DraggedFiles> window;
        {
            const juce::SharedResourcePointer<DraggedFiles> document;
            const auto first = document->makeFolder(), second = document->makeFolder();
            ASSERT_TRUE(first) << first.error;
            EXPECT_NE(first.value, second.value);
            folder = first.value;
        }
        EXPECT_TRUE(folder.isDirectory());
    }
    EXPECT_FALSE(folder.getParentDirectory().exists());
}

// Lists for people: a ball that rolls is one contact, however many grains it passes.

CollisionEvent at(std::int64_t ms, ContactKind kind, double amplitude = 0.1, std::int32_t other = 2) {
    CollisionEvent e;
    e.timeNs = ms * 1'000'000;
    e.amplitude = amplitude;
    e.source = {1, other, 0.0, 0.0, kind};
    return e;
}

TEST(RecentContacts, WhatRollsIsOneHowManyGrainsItPasses) {
    RecentContacts recent;
    for (int i = 0; i < 500; ++i) recent.add(at(i, ContactKind::roll, i == 100 ? 0.5 : 0.1));
    recent.add(at(500, ContactKind::hit));
    recent.add(at(501, ContactKind::roll));
    ASSERT_EQ(recent.newestFirst().size(), 2U);
    EXPECT_EQ(recent.newestFirst()[0].event.source.kind, ContactKind::hit);
    const RecentContact& rolled = recent.newestFirst()[1];
    EXPECT_EQ(rolled.grainCount, 501);
    EXPECT_EQ(rolled.event.timeNs, 0);
    EXPECT_EQ(rolled.event.amplitude, 0.5);
}

TEST(RecentContacts, AnotherPairAnotherKindAndAPauseAreAnother) {
    RecentContacts recent;
    recent.add(at(0, ContactKind::roll));
    recent.add(at(1, ContactKind::slide));
    recent.add(at(2, ContactKind::roll, 0.1, 3));
    recent.add(at(300, ContactKind::roll));
    EXPECT_EQ(recent.newestFirst().size(), 4U);
    for (int i = 0; i < 200; ++i) recent.add(at(400 + i, ContactKind::hit));
    EXPECT_EQ(recent.newestFirst().size(), RecentContacts::maxContacts);
}

TEST(RecentContacts, EachContactHasItsOwnEventsAsFarAsTheyAreKept) {
    RecentContacts recent;
    recent.add(at(0, ContactKind::roll, 0.3));
    recent.add(at(1, ContactKind::slide));
    recent.add(at(2, ContactKind::roll, 0.2));
    recent.add(at(3, ContactKind::hit, 0.7));
    const auto eventsOf = [&](std::size_t row) {
        std::vector<CollisionEvent> events;
        recent.appendEvents(recent.newestFirst()[row], events);
        return events;
    };
    ASSERT_EQ(eventsOf(2).size(), 2U);
    EXPECT_EQ(eventsOf(2)[0].amplitude, 0.3);
    EXPECT_EQ(eventsOf(2)[1].amplitude, 0.2) << "each as it was";
    EXPECT_EQ(eventsOf(1).size(), 1U);
    EXPECT_EQ(eventsOf(0)[0].amplitude, 0.7);
    for (std::size_t i = 0; i < RecentContacts::maxGrains; ++i)
        recent.add(at(static_cast<std::int64_t>(i) / 100, ContactKind::roll, 0.1, 9));
    EXPECT_EQ(eventsOf(0).size(), RecentContacts::maxGrains);
    EXPECT_TRUE(eventsOf(3).empty()) << "grains are the oldest to go";
    EXPECT_EQ(eventsOf(1).size(), 1U) << "a hit never";
}

} // namespace physvib::events_tab_test
