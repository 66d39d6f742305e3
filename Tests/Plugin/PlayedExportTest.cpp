// SPDX-License-Identifier: GPL-3.0-or-later
// What was felt as files, the window's keyboard, presets as files, and a controller that is learned.
#include "PlayedExport.h"
#include "EditorPanels.h"
#include "Formats/ClipFile.h"
#include "PluginEditor.h"
#include "PluginFiles.h"
#include "PluginTesting.h"
#include "Scene/EventsCsv.h"

namespace physvib::felt_export_test {

using namespace test;

/// Notes on and off of a MIDI file, times in seconds; only what it says itself.
std::vector<juce::MidiMessage> notesOf(const std::vector<CollisionEvent>& events, const PluginState& state) {
    const std::string bytes = midiFileBytes({events, state, makePanner(state, PanningLaw::linear, 1.0)});
    juce::MemoryInputStream stream{bytes.data(), bytes.size(), false};
    juce::MidiFile file;
    EXPECT_TRUE(file.readFrom(stream, false)); // else it adds what is missing
    file.convertTimestampTicksToSeconds();
    std::vector<juce::MidiMessage> notes;
    for (const auto* event : *file.getTrack(0))
        if (event->message.isNoteOnOrOff()) notes.push_back(event->message);
    return notes;
}

/// The instrument of that name, and what hands do to it.
class PlayedInstrument : public TestHost {
public:
    explicit PlayedInstrument(const std::string& name) {
        plugin->open(presetNamed(name, 0));
        prepare(48000, 480);
        block(480);
    }
    void send(const juce::MidiMessage& message, int blocks) {
        block(480, oneMessage(message));
        rest(blocks);
    }
    void rest(int blocks) {
        for (int b = 1; b < blocks; ++b) block(480);
    }
    std::vector<juce::MidiMessage> exported() {
        plugin->drainEvents();
        return notesOf(plugin->playedEvents().events(true), plugin->state());
    }
};

TEST(PlayedExport, NotesComeBackAsTheNotesThatWerePlayed) {
    PlayedInstrument host{"Bass"};
    host.send(juce::MidiMessage::noteOn(1, 36, juce::uint8{127}), 50);
    host.send(juce::MidiMessage::noteOn(1, 43, juce::uint8{64}), 50);
    host.rest(50);
    const auto notes = host.exported();
    ASSERT_EQ(notes.size(), 4u);
    EXPECT_EQ(notes[0].getNoteNumber(), 36);
    EXPECT_EQ(notes[0].getVelocity(), 127);
    EXPECT_EQ(notes[0].getTimeStamp(), 0.0);
    EXPECT_EQ(notes[1].getNoteNumber(), 43);
    EXPECT_NEAR(notes[1].getVelocity(), 64, 1);
    EXPECT_NEAR(notes[1].getTimeStamp(), 0.5, 1e-4);
}

TEST(PlayedExport, AHeldNoteIsOneNoteAsLongAsItWasHeld) {
    PlayedInstrument host{"Strings"};
    host.send(juce::MidiMessage::noteOn(1, 60, juce::uint8{100}), 80);
    host.send(juce::MidiMessage::noteOff(1, 60), 100);
    const auto notes = host.exported();
    ASSERT_EQ(notes.size(), 2u) << "not one for each of its strikes";
    EXPECT_EQ(notes[0].getNoteNumber(), 60);
    EXPECT_NEAR(notes[1].getTimeStamp(), 0.8 + 0.4, 0.01) << "with its release";
}

TEST(PlayedExport, AStrikeOfASoundingNoteEndsItOnceAndLastsAsLongAsBoth) {
    PlayedInstrument host{"Bass"};
    using Velocities = std::vector<std::pair<double, int>>; // by time; 0: off
    const auto velocitiesOf = [&](const std::vector<CollisionEvent>& events) {
        Velocities all;
        for (const auto& note : notesOf(events, host.plugin->state()))
            all.emplace_back(note.getTimeStamp(), note.isNoteOn() ? note.getVelocity() : 0);
        return all;
    };
    CollisionEvent first;
    first.frequencyHz = 110.0;
    first.amplitude = 1.0;
    first.durationNs = 1'000'000'000;
    CollisionEvent second = first;
    second.timeNs = 500'000'000;
    second.durationNs = 250'000'000;
    EXPECT_EQ(velocitiesOf({first, second}), (Velocities{{0.0, 127}, {0.5, 0}, {0.5, 127}, {1.0, 0}}));
    EXPECT_EQ(velocitiesOf({first, first}), (Velocities{{0.0, 127}, {1.0, 0}}));
    first.amplitude = 0.0;
    EXPECT_EQ(velocitiesOf({first}), (Velocities{{0.0, 1}, {1.0, 0}}));
}

TEST(PlayedExport, EndingsSayWhatIsWrittenAndOthersWriteNothing) {
    PlayedInstrument host{"Four corners"};
    for (int note = 60; note < 68; ++note)
        host.send(juce::MidiMessage::noteOn(1, note, juce::uint8{100}), 10);
    host.rest(50);
    host.plugin->drainEvents();
    const auto state = host.plugin->state();
    const auto events = host.plugin->playedEvents().events(true);
    ASSERT_EQ(events.size(), 8u);
    const PlayedExport felt{events, state, makePanner(state, PanningLaw::linear, 1.0)};
    const auto folder = juce::File::createTempFile("felt");
    ASSERT_TRUE(folder.createDirectory().wasOk());
    const auto at = [&folder](const char* name) {
        return folder.getChildFile(name).getFullPathName().toStdString();
    };
    ASSERT_TRUE(exportPlayed(felt, at("felt.csv")));
    EXPECT_EQ(loadEventsCsv(at("felt.csv")).value.events, events);
    EXPECT_EQ(loadEventsCsv(at("felt.csv")).value.field, fieldOf(felt.panner));
    ASSERT_TRUE(exportPlayed(felt, at("felt.HJIF")));
    EXPECT_EQ(loadClip(at("felt.HJIF"), ClipFormat::hjif).value.channels.size(), 4u);
    EXPECT_TRUE(exportPlayed(felt, at("felt.mid")));
    EXPECT_TRUE(exportPlayed(felt, at("felt.ahap")));
    EXPECT_EQ(folder.getNumberOfChildFiles(juce::File::findFiles, "felt-*.ahap"), 4)
        << "one for each actuator";
    const auto part = folder.getChildFile("felt-A.ahap");
    EXPECT_TRUE(part.replaceWithText("of the user"));
    EXPECT_EQ(exportPlayed(felt, at("felt.ahap")).error.find(at("felt-A.ahap") + ": is there already"), 0u)
        << "only felt.ahap was asked about";
    EXPECT_EQ(part.loadFileAsString(), "of the user");
    EXPECT_FALSE(exportPlayed(felt, at("felt.xyz")));
    EXPECT_FALSE(exportPlayed({{}, state, felt.panner}, at("nothing.mid")));
    EXPECT_EQ(folder.getNumberOfChildFiles(juce::File::findFiles, "*"), 3 + 4);
    folder.deleteRecursively();
}

std::vector<RunEvent> row(RunEvent event, std::size_t count) {
    std::vector all(count, event);
    for (std::size_t k = 0; k < count; ++k) all[k].indexInRun = event.indexInRun + k;
    return all;
}

TEST(PlayedExport, OnlyTheNewestRunIsKeptAndNotWithoutEnd) {
    PlayedEvents felt;
    RunEvent event;
    event.played.event = {1'000'000, 100.0, 10.0, 0.5, 0.0, 0.0, 0, {}};
    event.runNumber = 1;
    felt.add(1, row(event, 3));
    event.runNumber = 2;
    felt.add(1, row(event, 2));
    event.runNumber = 1; // the end of the one before
    felt.add(1, row(event, 5));
    EXPECT_EQ(felt.events(false).size(), 2u);
    EXPECT_EQ(felt.events(false)[0].timeNs, 1'000'000);
    EXPECT_EQ(felt.events(true)[0].timeNs, 0);
    EXPECT_EQ(felt.droppedCount(), 0u);
    felt.add(2, row(event, PlayedEvents::maxEvents + 7)); // prepared anew
    EXPECT_EQ(felt.events(false).size(), PlayedEvents::maxEvents);
    EXPECT_EQ(felt.droppedCount(), 7u);
    event.indexInRun = PlayedEvents::maxEvents + 10; // three that the log had no room for
    felt.add(2, row(event, 1));
    EXPECT_EQ(felt.droppedCount(), 7u + 3u + 1u);
}

TEST(Keyboard, EveryKeyIsFoundWhereItIsAndSaysWhatItIs) {
    PlayedInstrument host{"Drum kit"};
    std::vector<std::pair<int, int>> played;
    KeyboardPanel keys{[&played](int note, int velocity) { played.emplace_back(note, velocity); }};
    keys.setBounds(0, 0, 940, KeyboardPanel::height);
    keys.showState(host.plugin->state(), {});
    std::vector<int> found;
    for (int x = 0; x < 940; ++x)
        for (const int y : {40, 70})
            if (const int note = keys.noteAt({x, y});
                note >= 0 && std::ranges::find(found, note) == found.end())
                found.push_back(note);
    EXPECT_EQ(std::ssize(found), KeyboardPanel::highestNote - KeyboardPanel::lowestNote + 1);
    EXPECT_LT(keys.velocityAt({470, 30}), keys.velocityAt({470, 68}));
    const auto state = host.plugin->state();
    const MidiTable table{state};
    EXPECT_EQ(describeKey(36, table, state), "C2: kick, 48 Hz, 50 % from the left, 0 % from below");
    EXPECT_EQ(describeKey(60, table, state), "C4: 262 Hz, 0 % from the left, 50 % from below");
    EXPECT_EQ(describeKey(60, MidiTable{shakenBox()}, shakenBox()).substring(0, 4), "C4: ");
}

TEST(Keyboard, AKeyThatWasPressedIsLetGoWhereverTheMouseGoesAndWithTheWindow) {
    std::vector<std::pair<int, int>> played;
    auto keys = std::make_unique<KeyboardPanel>([&played](int n, int v) { played.emplace_back(n, v > 0); });
    keys->setBounds(0, 0, 940, KeyboardPanel::height);
    const auto at = [&keys](int x) { return mouseAt(*keys, {static_cast<float>(x), 70.0f}); };
    const int first = keys->noteAt({400, 70}), next = keys->noteAt({430, 70}), beside = 0;
    ASSERT_NE(first, next);
    keys->mouseDown(at(400));
    for (const int x : {401, 430, beside, 400}) keys->mouseDrag(at(x));
    keys->mouseUp(at(400));
    keys->mouseDown(at(beside));
    keys->mouseDown(at(430));
    keys.reset();
    EXPECT_EQ(
        played,
        (std::vector<std::pair<int, int>>{
            {first, 1}, {first, 0}, {next, 1}, {next, 0}, {first, 1}, {first, 0}, {next, 1}, {next, 0}}));
}

TEST(Keyboard, AKeyOfTheWindowIsANote) {
    PlayedInstrument host{"Strings"};
    host.plugin->playKey(60, 100);
    host.rest(40);
    EXPECT_GT(host.plugin->runs().status().session.render.played, 10u) << "held";
    host.plugin->playKey(60, 0);
    host.rest(20);
    const auto played = host.plugin->runs().status().session.render.played;
    host.rest(20);
    EXPECT_EQ(host.plugin->runs().status().session.render.played, played) << "let go";
}

TEST(Learning, TheNextControllerMovesTheParameterAndNoOther) {
    PlayedInstrument host{"Keys"};
    host.send(juce::MidiMessage::controllerEvent(1, 7, 10), 2); // before: means nothing
    const auto editor = openEditor<PluginEditor>(*host.plugin);
    editor->learn(Parameter::tilt);
    editor->refresh();
    EXPECT_TRUE(host.plugin->state().controllers.empty());
    EXPECT_TRUE(editor->statusText().contains("Move a controller"));
    host.send(juce::MidiMessage::controllerEvent(3, 21, 10), 2);
    editor->refresh();
    EXPECT_EQ(host.plugin->state().controllers, (std::vector<ControllerRule>{{21, "tilt"}}));
    host.rest(5);
    host.send(juce::MidiMessage::controllerEvent(1, 21, 127), 2);
    EXPECT_EQ(host.plugin->parameter(Parameter::tilt).value(), 180.0);
    editor->learn(Parameter::gravity);
    host.send(juce::MidiMessage::controllerEvent(1, 21, 64), 2);
    editor->refresh();
    EXPECT_EQ(host.plugin->state().controllers, (std::vector<ControllerRule>{{21, "gravity"}}))
        << "a controller moves one";
}

TEST(Learning, EachEntryOfAParametersMenuDoesWhatItSays) {
    TestHost host;
    auto state = host.plugin->state();
    state.controllers = {{7, "tilt"}, {8, "tilt"}, {9, "gravity"}};
    ASSERT_TRUE(host.plugin->edit(state));
    const auto editor = openEditor<PluginEditor>(*host.plugin);
    auto& tilt = host.plugin->parameter(Parameter::tilt);
    const auto menu = editor->makeMenu(tilt);
    EXPECT_EQ(wordsOf(menu).size(), 4) << wordsOf(menu).joinIntoString(", ");
    press(menu, "Forget controller 7");
    EXPECT_EQ(host.plugin->state().controllers, (std::vector<ControllerRule>{{8, "tilt"}, {9, "gravity"}}));
    tilt.setValue(1.0f);
    press(menu, "Back to " + tilt.getText(tilt.getDefaultValue(), 0));
    EXPECT_EQ(tilt.getValue(), tilt.getDefaultValue());
    press(menu, "Learn a controller: move it now");
    editor->refresh();
    EXPECT_EQ(editor->statusText(), "Move a controller: it will move Tilt");
}

/// A home folder of its own, as presets are in the user's.
struct PresetList : testing::Test {
    PresetList() {
        EXPECT_EQ(savePreset(presetNamed("Strings"), presetFolder().getChildFile("Mine.json")), "");
        EXPECT_TRUE(presetFolder().getChildFile("Old.json").replaceWithText("{}"));
        editor = openEditor<PluginEditor>(*host.plugin);
        list = below<juce::ComboBox>(*editor,
                                     [](const auto& one) { return one.getTitle() == "Instrument or world"; });
    }
    ~PresetList() override { folder.deleteRecursively(); }
    juce::String said() {
        editor->refresh();
        return editor->statusText();
    }
    const juce::File folder = juce::File::createTempFile("home");
    const Home home{folder};
    TestHost host;
    std::unique_ptr<PluginEditor> editor;
    juce::ComboBox* list = nullptr;
};

TEST_F(PresetList, ShowsWhatPlays) {
    for (const auto& [chosen, playing] :
         {std::pair{"Bass", "Bass"}, {"Mine", "Strings"}, {"Old", "Strings"}}) {
        list->setText(chosen, juce::sendNotificationSync);
        EXPECT_EQ(host.plugin->state().scene.name, playing);
        EXPECT_EQ(list->getText(), playing) << chosen;
        EXPECT_EQ(said().contains("Old.json"), juce::String{"Old"} == chosen) << said();
    }
}

// A preset of one's own, and a layout, may bear the name of another, which is then shown.
TEST_F(PresetList, WhatIsShownCanBeChosenAgain) {
    const auto choose = [](juce::ComboBox& box, const char* words) { // as its menu does
        const auto item = itemOf(*box.getRootMenu(), words);
        box.setSelectedId(item.itemID, juce::sendNotificationSync);
        if (item.action) item.action();
    };
    auto& layouts = *below<juce::ComboBox>(*editor, [](auto& one) { return one.getTitle() == "Layout"; });
    choose(*list, "Bass");
    const auto bass = host.plugin->state();
    auto mine = bass;
    mine.voice.decayPerSecond *= 2.0;
    std::swap(mine.layout.geometry.places[0], mine.layout.geometry.places[3]);
    host.plugin->open(mine);
    host.set(Parameter::strikeLevel, -20.0);
    editor->savePresetAs(presetFolder().getChildFile("Mine.json"));
    EXPECT_EQ(list->getText(), "Bass");
    for (int i = 0; i < 2; ++i) {
        choose(*list, "Mine");
        EXPECT_EQ(host.plugin->state().voice, mine.voice);
        choose(*list, "Bass");
        EXPECT_EQ(host.plugin->state().voice, bass.voice);
        EXPECT_EQ(host.plugin->state().parameters, bass.parameters);
    }
    choose(*list, "Mine");
    choose(layouts, mine.layout.name.c_str());
    EXPECT_TRUE(isSame(host.plugin->state().layout.geometry, bass.layout.geometry));
    host.plugin->stepHistory(PluginProcessor::Direction::undo);
    EXPECT_TRUE(isSame(host.plugin->state().layout.geometry, mine.layout.geometry)) << "once each";
}

TEST_F(PresetList, NothingIsReplacedThatNobodyWasAskedAbout) {
    const auto file = [](const char* name) { return presetFolder().getChildFile(name); };
    const auto mine = file("Mine.json").loadFileAsString();
    for (const auto& [name, words] :
         {std::pair{"Mine", "Mine.json exists: choose it in the list to replace it"},
          {"Bass 1.5", "Bass 1.5.json is saved"}}) {
        editor->savePresetAs(file(name));
        EXPECT_EQ(said(), words);
        EXPECT_EQ(file("Mine.json").loadFileAsString(), mine);
    }
    EXPECT_EQ(presetFiles(presetFolder()).front(), file("Bass 1.5.json"));
    editor->savePresetAs(file("Mine.json"));
    EXPECT_NE(file("Mine.json").loadFileAsString(), mine);
    editor->savePresetAs(file("Mine.json/Lost.json"));
    EXPECT_TRUE(said().contains("Mine.json: ")) << said();
}

TEST_F(PresetList, EachEntryOfTheMenuOfFilesDoesWhatItSays) {
    const auto take = [this](const char* words) { press(editor->makeFilesMenu(), words); };
    const auto isOn = [this](const juce::String& words) {
        return itemOf(editor->makeFilesMenu(), words).isEnabled;
    };
    const auto exportWords = juce::String::fromUTF8("Export what was felt\xe2\x80\xa6");
    EXPECT_FALSE(isOn("Undo") || isOn("Redo") || isOn(exportWords));
    auto state = host.plugin->state();
    state.seed = 5;
    ASSERT_TRUE(host.plugin->edit(state));
    std::vector<std::uint32_t> seeds;
    for (const auto* words : {"Undo", "Redo", "Compare: go to B", "Compare: back to A", "Undo"})
        take(words), seeds.push_back(host.plugin->state().seed);
    EXPECT_EQ(seeds, (std::vector<std::uint32_t>{1, 5, 5, 5, 1}));
    take("About PhysVib");
    EXPECT_TRUE(said().contains("GPL-3.0-or-later")) << said();
    for (const bool isLight : {true, false}) {
        take("Light window");
        EXPECT_EQ(savedTheme() == Theme::light, isLight);
        EXPECT_EQ(itemOf(editor->makeFilesMenu(), "Light window").isTicked, isLight);
    }
    editor->exportPlayedAs(folder.getChildFile("felt.csv"));
    EXPECT_TRUE(said().startsWith("nothing was felt yet")) << said();
    host.prepare(48000, 480);
    host.block(480, oneNote(60));
    host.played(9600);
    editor->exportPlayedAs(folder.getChildFile("felt.csv"));
    EXPECT_TRUE(said().endsWith("felt.csv: 1 events") && isOn(exportWords)) << said();
    host.block(480, oneNote(60));
    restore(*host.plugin, chunkOf(*host.plugin));
    EXPECT_FALSE(isOn(exportWords)) << "nothing of this state was felt";
    host.played(9600); // the note of before
    editor->exportPlayedAs(folder.getChildFile("felt.csv"));
    EXPECT_TRUE(said().startsWith("nothing was felt yet") && !isOn(exportWords)) << said();
}

TEST(PresetFiles, APresetIsSavedListedAndPlayedElsewhereNoLouder) {
    const auto folder = juce::File::createTempFile("presets");
    PlayedInstrument maker{"MPE pad"};
    maker.setNormal(Parameter::level, 1.0f); // 0 dB
    maker.setNormal(Parameter::music, 1.0f); // 12 dB
    auto state = maker.plugin->state();
    state.editorWidth = 1500;
    state.editorHeight = 900;
    state.limiterEnabled = false;
    EXPECT_EQ(savePreset(state, folder.getChildFile("Mine.json")), "");
    const auto files = presetFiles(folder);
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files[0].getFileNameWithoutExtension(), "Mine");
    TestHost other;
    other.plugin->open(newPluginState());
    other.set(Parameter::bypass, 1.0);
    const auto now = other.plugin->state();
    const auto opened = openFile(files[0].getFullPathName().toStdString(), now);
    ASSERT_TRUE(opened) << opened.error;
    EXPECT_EQ(opened.value.note,
              "Mine.json: lowered to this instance: master 0.0 to -12.0 dB; music; the limiter "
              "stays on");
    other.plugin->open(opened.value.state);
    EXPECT_EQ(other.plugin->state().voice, state.voice);
    EXPECT_TRUE(other.plugin->state().limiterEnabled);
    EXPECT_NEAR(other.plugin->parameter(Parameter::level).value(), -12.0, 1e-5);
    EXPECT_NEAR(other.plugin->parameter(Parameter::music).value(), 0.0, 1e-5);
    EXPECT_NE(other.plugin->state().editorWidth, 1500);
    EXPECT_EQ(other.plugin->parameter(Parameter::bypass).value(), 1.0) << "nothing but its button lifts it";
    auto unknown = now;
    unknown.parameters.emplace_back("volume", 1.0);
    for (const auto& text :
         {std::string{R"({"physvib_plugin_state": 5, "seed": "much"})"}, pluginStateJson(unknown)}) {
        EXPECT_TRUE(files[0].replaceWithText(text));
        const auto path = files[0].getFullPathName().toStdString();
        EXPECT_EQ(openFile(path, now).error.find(path + ": "), 0u);
    }
    folder.deleteRecursively();
}

} // namespace physvib::felt_export_test
