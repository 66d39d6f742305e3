// SPDX-License-Identifier: GPL-3.0-or-later
// The materials: edited and taken back, measured from recordings, felt at a spot, saved and rendered again.
#include "Mixer/Materials/MaterialsTab.h"
#include "Io/Wav/WavSink.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Recordings/Recording.h"
#include "Mixer/Knock.h"
#include "MixerTesting.h"
#include "Scene/SceneFile.h"
#include "Support/WriteSound.h"

namespace physvib::materials_tab_test {

using namespace test;

constexpr int wood = 4; // of shake-the-box; others come before it and are silent there

void write(const juce::File& file, const std::vector<float>& samples) {
    WavSink sink{pathOf(file), 1, 48000};
    const float* channels[]{samples.data()};
    sink.write(channels, static_cast<int>(samples.size()));
    ASSERT_EQ(sink.finish(), "");
}

struct Materials : testing::Test {
    TestFolder folder;
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    MaterialsTab& tab = open();

    MaterialsTab& open() {
        view.tabs().choose("Materials");
        auto& opened = *view.tabs().find<MaterialsTab>();
        opened.choose(wood);
        return opened;
    }
    const Material& now() const { return model.world().scene().materials[wood]; }
    juce::Slider& slider(const juce::String& title) { return the<juce::Slider>(tab, title); }
    const std::vector<LiveInput>& inputs() { return model.savedSession().log.runs.back().inputs; }
    /// Whether such a hit has been played, whoever has looked: the view does by itself, and what one look
    /// shows the next does not.
    bool isPlayed(const std::function<bool(const CollisionEvent&)>& is) {
        model.poll();
        return std::ranges::any_of(model.recentContacts().newestFirst(), is, &RecentContact::event);
    }
};

TEST_F(Materials, OneOfOnesOwnIsACopyWithANameAndNoNameIsThereTwice) {
    const auto all = [&]() -> const std::vector<Material>& {
        return model.world().drawing().drawn().materials;
    };
    const auto before = all().size();
    const auto make = [&](const char* name) {
        dynamic_cast<juce::Button&>(
            *find(tab, "A material of one's own: a copy of the chosen one, with a name and a colour"))
            .onClick();
        ASSERT_NE(view.question(), nullptr);
        view.question()->setValue("Name", name);
        view.question()->setValue("Colour", "olive");
        view.question()->answer("Make it");
        ASSERT_TRUE(runUntil([&] { return view.card() == nullptr; }));
    };
    make("my wood");
    ASSERT_TRUE(runUntil([&] { return all().size() == before + 1; }));
    Material expected = all()[wood];
    expected.name = "my wood", expected.colour = 8;
    EXPECT_EQ(all().back(), expected);
    EXPECT_EQ(palette::material(all(), static_cast<int>(before)),
              palette::material(std::vector<Material>{}, 7));
    EXPECT_EQ(readScene(sceneJson(model.world().drawing().drawn()), "own").value.materials, all())
        << "it is kept";
    slider("Frequency").setValue(205.0, juce::sendNotificationSync);
    EXPECT_EQ(model.world().scene().materials.back().frequencyHz, 205.0) << "it is the chosen one";
    make("my wood");
    EXPECT_TRUE(runUntil([&] { return model.messageText().contains("my wood"); })) << model.messageText();
    EXPECT_EQ(all().size(), before + 1);
    model.undoManager().undo();
    model.undoManager().undo();
    EXPECT_EQ(all().size(), before);
}

TEST_F(Materials, AreSetWhileTheyArePlayedAndTakenBack) {
    slider("Frequency").setValue(205.0, juce::sendNotificationSync);
    slider("Decay").setValue(30.0, juce::sendNotificationSync);
    EXPECT_EQ(now().frequencyHz, 205.0);
    EXPECT_EQ(now().decayPerSecond, 30.0);
    ASSERT_EQ(inputs().size(), 2u);
    EXPECT_EQ(std::get<SoundAction>(inputs()[1].action), (SoundAction{wood, 205.0, 30.0}));
    EXPECT_TRUE(runUntil([&] {
        return isPlayed(
            [](const CollisionEvent& e) { return e.frequencyHz == 205.0 && e.decayPerSecond == 30.0; });
    })) << "hits of the world sound as it says";
    model.undoManager().undo();
    EXPECT_EQ(now().decayPerSecond, 106.99);
    model.undoManager().undo();
    EXPECT_EQ(now().frequencyHz, 349.0);
    EXPECT_FALSE(model.undoManager().canUndo());
    model.undoManager().redo();
    EXPECT_EQ(now().frequencyHz, 205.0);
}

TEST_F(Materials, SurfacesAreMadeRoughAndTakenBack) {
    tab.choose(0);
    EXPECT_FALSE(the(tab, "Frequency").isEnabled()) << "rubber is silent there";
    EXPECT_FALSE(the(tab, "Roughness").isEnabled()) << "a smooth surface has none";
    slider("Grain").setValue(0.004, juce::sendNotificationSync);
    model.dispatchPendingMessages();
    EXPECT_TRUE(the(tab, "Roughness").isEnabled()) << "another's camera feels what slides over it";
    slider("Roughness").setValue(2.5, juce::sendNotificationSync);
    slider("Rolling").setValue(0.75, juce::sendNotificationSync);
    the<juce::ComboBox>(tab, "Pattern").setSelectedItemIndex(1, juce::sendNotificationSync);
    ASSERT_EQ(inputs().size(), 4u);
    EXPECT_EQ(inputs()[3].action, (Action{TextureAction{0, 0.004, 2.5, GrainPattern::regular, 0.75}}));
    EXPECT_EQ(model.world().scene().materials[0].texture().pattern, GrainPattern::regular);
    tab.choose(wood);
    EXPECT_EQ(slider("Grain").getValue(), 0.0) << "of another";
    tab.choose(0);
    EXPECT_EQ(slider("Grain").getValue(), 0.004);
    EXPECT_EQ(slider("Grain").getTextFromValue(0.004), "grain 4.0 mm");
    EXPECT_DOUBLE_EQ(slider("Grain").getValueFromText("grain 8 mm"), 0.008);
    EXPECT_DOUBLE_EQ(slider("Grain").getValueFromText("0,5"), 0.0005);
    EXPECT_DOUBLE_EQ(slider("Grain").getValueFromText("1.5 m"), 1.5);
    EXPECT_EQ(slider("Grain").getTextFromValue(0.0), "smooth");
    model.restart(model.mix().seed);
    EXPECT_EQ(model.world().scene().materials[0].roughness, 2.5) << "start anew keeps it";
    for (int k = 0; k < 4; ++k) model.undoManager().undo();
    EXPECT_EQ(model.world().scene().materials[0].texture().grainMetres, 0.0);
    EXPECT_EQ(model.world().scene().materials[0].texture().rolling, 0.2);
    EXPECT_EQ(model.world().edit("Grain", TextureAction{0, 11.0}), "grain_m: expected 0 to 10, found 11");
    EXPECT_EQ(model.world().edit("Grain", TextureAction{99, 0.1}),
              "material: expected one of the 6 materials of the scene");
}

TEST_F(Materials, WhatIsTurnedAndHeldIsOneThingToUndo) {
    const auto turn = [&](const char* name, auto actionOf) {
        for (int k = 1; k <= 20; ++k) EXPECT_EQ(model.world().edit(name, actionOf(k), k > 1), "");
    };
    turn("Grain", [](int k) { return TextureAction{wood, 0.001 * k}; });
    EXPECT_EQ(now().grainMetres, 0.02);
    model.undoManager().undo();
    EXPECT_EQ(now().grainMetres, 0.0);
    EXPECT_FALSE(model.undoManager().canUndo());
    turn("Frequency", [](int k) { return SoundAction{wood, 100.0 + k, 50.0}; });
    EXPECT_EQ(now().frequencyHz, 120.0);
    model.undoManager().undo();
    EXPECT_EQ(inputs().size(), 42u) << "one more each, not the twenty in turn";
    EXPECT_EQ(now().frequencyHz, 349.0);
    EXPECT_FALSE(model.undoManager().canUndo());
    model.undoManager().redo();
    EXPECT_EQ(now().frequencyHz, 120.0);
}

TEST_F(Materials, StayWhenTheSceneStartsAnewAndGoWithAnother) {
    EXPECT_EQ(model.world().edit("Frequency", SoundAction{wood, 205.0, 30.0}), "");
    model.restart(model.mix().seed);
    EXPECT_EQ(now().frequencyHz, 205.0);
    model.restart(7);
    EXPECT_EQ(now().frequencyHz, 205.0);
    EXPECT_TRUE(runUntil([&] {
        return model.savedSession().log.runs.size() > 1 && model.savedSession().log.runs.back().seed == 7;
    }));
    EXPECT_EQ(model.savedSession().log.runs.back().scene->materials[wood].frequencyHz, 205.0)
        << "it is so from the first hit on";
    setScene(model, *MixerModel::defaultMix().scene);
    EXPECT_EQ(now().frequencyHz, 349.0);
}

TEST_F(Materials, ARecordingThatIsDroppedGivesBothNumbers) {
    ASSERT_TRUE(writeKnock(folder("knock.wav")));
    tab.filesDropped({folder("knock.wav").getFullPathName()}, 5, 400);
    EXPECT_TRUE(tab.isMeasuring());
    EXPECT_EQ(now().frequencyHz, 349.0) << "measured beside the message thread";
    ASSERT_TRUE(runUntil([&] { return !tab.isMeasuring(); }));
    EXPECT_EQ(model.messageText(), "");
    EXPECT_NEAR(now().frequencyHz, 352.0, 0.5);
    EXPECT_NEAR(now().decayPerSecond, 98.0, 2.0);
    const auto* recording = tab.findRecording(wood);
    ASSERT_NE(recording, nullptr);
    EXPECT_EQ(recording->name, "knock.wav");
    EXPECT_TRUE(recording->sound.isConfident());
    const auto peak =
        std::ranges::max_element(recording->waveform.levels) - recording->waveform.levels.begin();
    EXPECT_NEAR(FrequencyAxis::hzAtPoint(static_cast<int>(peak)), 352.0, 10.0);
    EXPECT_GT(recording->amplitude, 0.4);
    EXPECT_LE(recording->amplitude, 1.0);
    EXPECT_TRUE(the(tab, "Decay of the material").getDescription().contains("confidence high"));
    model.undoManager().undo();
    EXPECT_EQ(now().frequencyHz, 349.0);
    model.undoManager().redo();
    EXPECT_NEAR(now().frequencyHz, 352.0, 0.5);
}

TEST_F(Materials, ARecordingThatIsDroppedOnARowIsOfThatMaterial) {
    ASSERT_TRUE(writeKnock(folder("knock.wav")));
    auto& list = the<juce::ListBox>(tab, "List of materials");
    tab.filesDropped({folder("knock.wav").getFullPathName()}, 20, list.getY() + list.getRowHeight() / 2);
    tab.finishMeasuring();
    EXPECT_NEAR(model.world().scene().materials[3].frequencyHz, 352.0, 0.5)
        << "concrete, the first that sounds";
    EXPECT_EQ(now().frequencyHz, 349.0);
}

TEST_F(Materials, FlacAndOggAreReadAsWell) {
    ASSERT_TRUE(writeKnock(folder("knock.wav")));
    const auto knock = readRecording(pathOf(folder("knock.wav")));
    ASSERT_EQ(knock.error, "");
    for (const auto& [ending, format] : {std::pair{"flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16},
                                         std::pair{"ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS}}) {
        const auto file = folder("knock").withFileExtension(ending);
        ASSERT_TRUE(test::writeSound(pathOf(file), format, knock.value)) << ending;
        tab.measure(file);
        tab.finishMeasuring();
        EXPECT_EQ(model.messageText(), "");
        ASSERT_NE(tab.findRecording(wood), nullptr) << ending;
        EXPECT_EQ(tab.findRecording(wood)->name, file.getFileName().toStdString());
        EXPECT_NEAR(now().frequencyHz, 352.0, 1.0) << ending;
        EXPECT_NEAR(now().decayPerSecond, 98.0, 4.0) << ending;
        juce::MemoryBlock bytes;
        file.loadFileAsData(bytes);
        file.replaceWithData(bytes.getData(), 40);
        tab.measure(file);
        tab.finishMeasuring();
        EXPECT_TRUE(model.messageText().startsWith(file.getFileName() + ": expected")) << model.messageText();
        model.report({});
    }
}

TEST_F(Materials, WhatIsNoHitIsToldInOneLineAndChangesNothing) {
    const auto expect = [&](const juce::File& file, const juce::String& words) {
        tab.measure(file);
        tab.finishMeasuring();
        EXPECT_TRUE(model.messageText().contains(words)) << model.messageText();
        EXPECT_TRUE(model.messageText().contains(file.getFileName())) << model.messageText();
        EXPECT_FALSE(model.messageText().containsAnyOf("/\n")) << "the file by its name, in one line";
        EXPECT_FALSE(model.undoManager().canUndo());
    };
    expect(folder("none.wav"), "cannot be read");
    folder("text.wav").replaceWithText("no sound at all");
    expect(folder("text.wav"), "expected a");
    ASSERT_TRUE(writeKnock(folder("knock.wav")));
    juce::MemoryBlock bytes;
    folder("knock.wav").loadFileAsData(bytes);
    folder("cut.wav").replaceWithData(bytes.getData(), 60);
    expect(folder("cut.wav"), "expected");
    std::vector<float> samples(24'000, 0.0f);
    write(folder("silent.wav"), samples);
    expect(folder("silent.wav"), "found silence");
    for (std::size_t i = 2400; i < samples.size(); ++i)
        samples[i] = std::clamp(3.0f * std::sin(0.02f * static_cast<float>(i)), -1.0f, 1.0f);
    write(folder("clipped.wav"), samples);
    expect(folder("clipped.wav"), "not clipped");
    samples.resize(100);
    write(folder("short.wav"), samples);
    expect(folder("short.wav"), "expected at least");
    tab.filesDropped({"a.wav", "b.wav"}, 0, 0);
    EXPECT_TRUE(model.messageText().contains("2 files"));
    EXPECT_EQ(tab.findRecording(wood), nullptr);
    tab.choose(0);
    tab.measure(folder("knock.wav"));
    EXPECT_FALSE(tab.isMeasuring()) << "rubber is silent there";
    EXPECT_TRUE(model.messageText().contains("that sounds"));
}

TEST_F(Materials, AnAuditionIsAHitOfTheMaterialAtTheSpot) {
    model.setSlowness(0); // nothing else is to be felt
    tab.playAt({0.25, 0.75});
    const auto& strikes = model.savedSession().log.strikes;
    ASSERT_EQ(strikes.size(), 1u);
    EXPECT_EQ(strikes[0].frequencyHz, 349.0);
    EXPECT_EQ(strikes[0].decayPerSecond, 106.99);
    EXPECT_LE(strikes[0].amplitude, 0.5) << "hands are attached";
    EXPECT_EQ(strikes[0].x, 0.25 * model.world().scene().fieldWidthMetres);
    EXPECT_EQ(strikes[0].y, 0.75 * model.world().scene().fieldHeightMetres);
    EXPECT_TRUE(runUntil([&] {
        return isPlayed(
            [&](const CollisionEvent& e) { return e.frequencyHz == 349.0 && e.x == strikes[0].x; });
    }));
    slider("Spot from the left").setValue(100.0, juce::sendNotificationSync);
    the<juce::Button>(tab, "Feel the material at the spot").onClick();
    EXPECT_EQ(model.savedSession().log.strikes.back().x, model.world().scene().fieldWidthMetres);
    tab.choose(0);
    EXPECT_FALSE(the(tab, "Feel the material at the spot").isEnabled());
    EXPECT_NE(model.eventPlayer().audition(0, 0.5, 0.5), "") << "rubber is silent there";
    EXPECT_NE(model.eventPlayer().audition(99, 0.5, 0.5), "");
}

TEST_F(Materials, AClickInTheWorldFeelsItThereWhileTheTabIsShown) {
    auto& world = view.world().view();
    ASSERT_TRUE(world.onSpot != nullptr);
    world.onSpot({0.5, 0.5});
    EXPECT_EQ(model.savedSession().log.strikes.size(), 1u);
    view.tabs().choose("Output");
    EXPECT_TRUE(world.onSpot == nullptr);
}

TEST_F(Materials, ASavedSessionHasThemAndRendersTheSameBytes) {
    ASSERT_TRUE(runUntil([&] { return model.poll().session.sessionNs > 300'000'000; }));
    EXPECT_EQ(model.world().edit("Sound", SoundAction{wood, 205.0, 30.0}), "");
    EXPECT_EQ(model.world().edit("Grain", TextureAction{wood, 0.01}), "");
    tab.playAt({0.25, 0.75});
    ASSERT_TRUE(runUntil([&] { return model.poll().session.sessionNs > 1'500'000'000; }));
    const auto& saved = model.savedSession();
    const auto read = readSession(sessionJson(saved), "again");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(mixAtEnd(read.value).scene->materials[wood].frequencyHz, 205.0);
    EXPECT_EQ(mixAtEnd(read.value).scene->materials[wood].grainMetres, 0.01);
    for (const auto& [session, name] : {std::pair{&saved, "one.wav"}, {&read.value, "two.wav"}})
        EXPECT_EQ(renderSessionWav(*session, {48000, 1.5, [](double) { return true; }},
                                   folder(name).getFullPathName().toStdString(), "test"),
                  "");
    juce::MemoryBlock one, two;
    folder("one.wav").loadFileAsData(one);
    folder("two.wav").loadFileAsData(two);
    EXPECT_GT(one.getSize(), 100'000u);
    EXPECT_TRUE(one == two);
    const auto events = sessionEvents(read.value, 1'500'000'000).events;
    EXPECT_TRUE(std::ranges::any_of(events, [](const CollisionEvent& e) { return e.frequencyHz == 205.0; }));
}

} // namespace physvib::materials_tab_test
