// SPDX-License-Identifier: GPL-3.0-or-later
// The editor without a window: fifty openings, sizes, its cost. PHYSVIB_PICTURES: a folder for Docs' picture.
#include "PluginEditor.h"
#include "Host/Views/Look.h"
#include "PluginTesting.h"
#include "Scene/SceneFile.h"

namespace physvib::plugin_editor_test {

using namespace test;

juce::Image pictureOf(PluginEditor& editor) {
    return editor.createComponentSnapshot(editor.getLocalBounds());
}

/// Into the folder of PHYSVIB_PICTURES, to look at, if that is set.
void show(const juce::Image& picture, const juce::String& name) {
    const char* const folder = std::getenv("PHYSVIB_PICTURES");
    if (folder == nullptr) return;
    juce::FileOutputStream file{juce::File{folder}.getChildFile(name + ".png")};
    file.setPosition(0);
    file.truncate();
    juce::PNGImageFormat{}.writeImageToStream(picture, file);
}

TEST(PluginEditor, OpensFiftyTimesWhileItPlays) {
    TestHost host{shakenBox(), 512};
    for (int i = 0; i < 50; ++i) {
        auto editor = openEditor<PluginEditor>(*host.plugin);
        ASSERT_NE(editor, nullptr);
        for (int b = 0; b < 5; ++b) host.block(512);
        editor->refresh();
        editor->setSize(960 + 30 * i, 540 + 20 * i);
        if (i % 10 == 0) EXPECT_EQ(pictureOf(*editor).getWidth(), 960 + 30 * i);
        if (i % 7 == 0) host.plugin->setCurrentProgram(i % 5);
    }
}

TEST(PluginEditor, ANewInstanceSaysWhatToPressUntilANoteIsFelt) {
    TestHost host;
    host.plugin->setCurrentProgram(static_cast<int>(builtInScenes().size()));
    host.prepare(48000, 512);
    auto editor = openEditor<PluginEditor>(*host.plugin);
    host.block(512);
    editor->refresh();
    auto* const words = below<juce::Label>(
        *editor, [](const auto& label) { return label.getText().contains("Press a key below"); });
    ASSERT_NE(words, nullptr);
    EXPECT_TRUE(words->isVisible());
    host.block(512, oneNote(60));
    for (int b = 0; b < 20; ++b) host.block(512);
    editor->refresh();
    EXPECT_FALSE(words->isVisible());
    auto state = host.plugin->state();
    state.transport = TransportMode::restartOnPlay;
    host.plugin->edit(state);
    host.playHead.isThere = true;
    for (int b = 0; b < 20; ++b) host.block(512);
    editor->refresh();
    EXPECT_TRUE(words->isVisible() && words->getText().startsWith("Waits for play")) << words->getText();
}

TEST(PluginEditor, ShowsTheWorldMoving) {
    TestHost host{shakenBox(), 480};
    auto state = host.plugin->state();
    state.layout.actuators[2].actuator = "lra-205";
    state.equalised[2] = {{205.0, 12.0}, {160.0, 260.0}};
    state.strips[1].gainDb = -4.5;
    state.strips[1].delayMs = 2.0;
    state.strips[2].ceilingDb = -12.0;
    state.notes = {{.note = 60, .material = 4, .y = 0.0},
                   {.note = 61,
                    .kind = NoteKind::push,
                    .object = state.scene.bodies.back().name,
                    .atFullVelocity = {0.0, 500.0}}};
    state.controllers = {{1, "tilt"}};
    host.plugin->edit(state);
    host.setToDefault(Parameter::level);
    auto editor = openEditor<PluginEditor>(*host.plugin);
    std::vector<juce::Image> pictures;
    for (int second = 0; second < 3; ++second) {
        for (int b = 0; b < 100; ++b) host.block(480);
        editor->refresh();
        pictures.push_back(pictureOf(*editor));
    }
    const auto differ = [](const juce::Image& a, const juce::Image& b) {
        int pixels = 0;
        for (int y = 0; y < a.getHeight(); ++y)
            for (int x = 0; x < a.getWidth(); ++x) pixels += a.getPixelAt(x, y) != b.getPixelAt(x, y) ? 1 : 0;
        return pixels;
    };
    EXPECT_GT(differ(pictures[0], pictures[1]), 500);
    EXPECT_GT(differ(pictures[1], pictures[2]), 500);
    show(pictures.back(), "plugin-editor");
    for (const auto theme : {Theme::light, Theme::dark}) {
        editor->setTheme(theme);
        editor->refresh();
        const auto corner = pictureOf(*editor).getPixelAt(4, 4);
        EXPECT_EQ(corner.getPerceivedBrightness() > 0.5f, theme == Theme::light);
    }
}

TEST(PluginEditor, ItsLowerEdgeHelpsWithWhatIsUnderTheMouse) {
    TestHost host;
    auto editor = openEditor<PluginEditor>(*host.plugin);
    EXPECT_EQ(editor->findHelp(nullptr), "");
    EXPECT_EQ(editor->findHelp(editor.get()), "");
    auto* const silence = buttonOf(*editor, "SILENCE");
    EXPECT_EQ(editor->findHelp(silence), juce::String{"Silence; the world goes on"});
    juce::Component elsewhere;
    EXPECT_EQ(editor->findHelp(&elsewhere), "");
}

TEST(PluginEditor, SilenceIsFilledOnlyWhileItIsOn) {
    TestHost host;
    auto editor = openEditor<PluginEditor>(*host.plugin);
    auto* const silence = buttonOf(*editor, "SILENCE");
    ASSERT_NE(silence, nullptr);
    const auto ground = [&] {
        return silence->createComponentSnapshot(silence->getLocalBounds(), true, 1.0f)
            .getPixelAt(silence->getWidth() / 2, 6);
    };
    const auto red = shade(*silence, Shade::limit);
    EXPECT_LT(ground().getSaturation(), 0.5f * red.getSaturation());
    EXPECT_EQ(host.plugin->parameter(Parameter::bypass).getValue(), 0.0f);
    silence->setToggleState(true, juce::sendNotificationSync); // as a click
    EXPECT_EQ(ground(), red);
    EXPECT_EQ(host.plugin->parameter(Parameter::bypass).getValue(), 1.0f);
}

TEST(PluginEditor, ComesBackInTheSizeItWasLeftInAlsoFromAChunk) {
    TestHost host, other;
    const auto count = host.plugin->stateVersion();
    openEditor<PluginEditor>(*host.plugin)->setSize(1000, 600);
    EXPECT_EQ(openEditor<PluginEditor>(*host.plugin)->getWidth(), 1000);
    EXPECT_EQ(host.plugin->stateVersion(), count) << "no edit";
    restore(*other.plugin, chunkOf(*host.plugin));
    EXPECT_EQ(openEditor<PluginEditor>(*other.plugin)->getHeight(), 600);
}

bool hasControl(juce::Component& in, const juce::String& title) {
    return below<juce::Component>(in, [&](const auto& c) { return c.getTitle() == title; }) != nullptr;
}

TEST(PluginEditor, HasBeatsWhereThereIsASideChainAndSaysWhereThatIsOff) {
    TestHost host{shakenBox(), 512};
    auto editor = openEditor<PluginEditor>(*host.plugin);
    EXPECT_TRUE(hasControl(*editor, "Beats"));
    editor->refresh();
    EXPECT_FALSE(editor->statusText().contains("side chain")) << "nobody wants any";
    host.setNormal(Parameter::beats, 0.5f);
    editor->refresh();
    EXPECT_TRUE(editor->statusText().contains("no beats and no music: the side chain is off"));
    ASSERT_TRUE(setSideChain(*host.plugin, 2));
    editor->refresh();
    EXPECT_FALSE(editor->statusText().contains("side chain"));
    auto& format = juce::PluginHostType::jucePlugInClientCurrentWrapperType;
    const auto before = std::exchange(format, juce::AudioProcessor::wrapperType_LV2);
    TestHost lv2;
    format = before;
    EXPECT_FALSE(hasControl(*openEditor<PluginEditor>(*lv2.plugin), "Beats"));
    EXPECT_TRUE(hasControl(*openEditor<PluginEditor>(*lv2.plugin), "Tilt"));
}

// Some places of a choice repeat the one before (decision 34).
TEST(PluginEditor, AListHasEachChoiceOnceAndChoosesIt) {
    TestHost host;
    auto editor = openEditor<PluginEditor>(*host.plugin);
    auto& law = *below<juce::ComboBox>(*editor, [](auto& one) { return one.getTitle() == "Panning law"; });
    ASSERT_EQ(law.getNumItems(), static_cast<int>(panningLawNames.size()));
    for (int i = 0; i < law.getNumItems(); ++i) {
        law.setSelectedItemIndex(i, juce::sendNotificationSync);
        EXPECT_EQ(valueText(rowOf(Parameter::law), host.plugin->parameter(Parameter::law).value()),
                  law.getText().toStdString());
    }
}

TEST(PluginEditor, OpensFilesAndSaysWhatIsWrong) {
    TestHost host;
    auto editor = openEditor<PluginEditor>(*host.plugin);
    const auto file = juce::File::createTempFile(".json");
    file.replaceWithText(layoutJson(presetLayout("ring3")));
    EXPECT_TRUE(editor->isInterestedInFileDrag(juce::StringArray{file.getFullPathName()}));
    editor->filesDropped(juce::StringArray{file.getFullPathName()}, 0, 0);
    EXPECT_EQ(host.plugin->state().layout.name, "ring3");
    file.replaceWithText("{}");
    editor->open(file);
    editor->refresh();
    EXPECT_EQ(host.plugin->state().layout.name, "ring3");
    restore(*host.plugin, std::string{"{ \"\xff\": 1 }"});
    editor->refresh();
    EXPECT_TRUE(editor->statusText().endsWith("the host's session keeps it until something is edited here"));
    file.deleteFile();
}

TEST(PluginEditor, EachControlChangesItsSettingAloneAndTheHostIsTold) {
    TestHost host;
    HostNews listener{*host.plugin};
    auto editor = openEditor<PluginEditor>(*host.plugin);
    const auto lines = [&host] {
        return juce::StringArray::fromLines(pluginStateJson(host.plugin->state()));
    };
    int edits = 0;                          // to open it is none
    using Row = std::array<const char*, 3>; // a control, what is typed, chosen or drawn there, what changes
    for (const auto& [name, value, change] :
         {Row{"Steps per second", "123 /s", R"("steps_per_second": 123,)"},
          Row{"Steps per second", "x", R"("steps_per_second": 10,)"},
          Row{"Steps per second", "99999", R"("steps_per_second": 10000,)"},
          Row{"Seed", "7", R"("seed": 7,)"}, Row{"Seed", "9999999999", R"("seed": 4294967295,)"},
          Row{"Restart on play", "", R"("transport": "restart-on-play")"},
          Row{"Tempo", "", R"("transport": "in-tempo")"},
          Row{"Tempo", "", R"("transport": "restart-on-play")"},
          Row{"Restart on play", "", R"("transport": "free")"}, Row{"Direct", "", R"("direct": true)"},
          Row{"Limiter", "", R"("limiter": false)"}, Row{"Gain of B", "-7", R"("gain_db": -7)"},
          Row{"Ceiling of B", "-9", R"("ceiling_db": -9)"},
          Row{"Strip B", "lra-205", R"("actuator": "lra-205")"},
          Row{"Strip B", "no profile", R"("actuator": "none")"}}) {
        const auto before = lines();
        auto* const control = below<juce::Component>(*editor, [name = name](auto& one) {
            const auto* const button = dynamic_cast<juce::Button*>(&one);
            return one.getTitle() == name || (button && button->getButtonText() == name);
        });
        if (auto* const list = dynamic_cast<juce::ComboBox*>(control))
            list->setText(value, juce::sendNotificationSync);
        if (auto* const box = dynamic_cast<juce::TextEditor*>(control))
            box->setText(value), box->onFocusLost();
        if (auto* const slider = dynamic_cast<juce::Slider*>(control))
            slider->setValue(std::atof(value), juce::sendNotificationSync);
        if (auto* const strip = dynamic_cast<MixStrip*>(control)) press(strip->makeActuatorMenu(), value);
        if (auto* const button = dynamic_cast<juce::Button*>(control))
            button->setToggleState(!button->getToggleState(), juce::dontSendNotification), button->onClick();
        editor->refresh();
        auto changed = lines();
        for (const auto& line : before) changed.removeString(line);
        const auto text = changed.joinIntoString(" ");
        EXPECT_EQ(listener.edits, ++edits);
        EXPECT_TRUE(text.contains(change) && changed.size() <= 2) << name << " " << value << ": " << text;
    }
}

TEST(PluginEditor, AnActuatorThatWasMeasuredIsEqualised) { // built-in profiles have no Q
    TestHost host;
    auto editor = openEditor<PluginEditor>(*host.plugin);
    auto& strip = *below<MixStrip>(*editor, [](auto& one) { return one.getTitle() == "Strip B"; });
    const auto file = juce::File::createTempFile(".json");
    const EqualisedActuator equalised{{204.0, 11.0}, {180.0, 230.0}};
    ActuatorProfile mine;
    mine.name = "mine";
    mine.resonanceHz = 204.0, mine.q = 11.0, mine.band = equalised.band, mine.fullScaleG = 1.5;
    for (const auto& text : {actuatorJson(mine), std::string{"{}"}}) {
        file.replaceWithText(text);
        strip.chooseActuator(file.getFullPathName().toStdString());
        editor->refresh();
        EXPECT_EQ(host.plugin->state().layout.actuators[1].actuator, "mine");
        EXPECT_EQ(host.plugin->state().layout.actuators[1].fullScaleG, 1.5);
    }
    EXPECT_TRUE(editor->statusText().startsWith(file.getFullPathName() + ": "));
    for (const auto& expected : {equalised, EqualisedActuator{}}) {
        press(strip.makeActuatorMenu(), "Equalised: flat in its band");
        editor->refresh();
        EXPECT_EQ(host.plugin->state().equalised[1], expected);
    }
    file.deleteFile();
}

/// The list of rules for notes and controllers, with its forms.
struct MidiForms : testing::Test {
    using Answers = std::vector<std::pair<const char*, juce::String>>;

    ScreenForTests screen;
    TestHost host;
    std::unique_ptr<PluginEditor> editor = openEditor<PluginEditor>(*host.plugin);
    juce::ListBoxModel& list = *below<juce::ListBox>(*editor, [](const auto&) { return true; }) -> getModel();

    /// Fills in the form that is open.
    void answer(const Answers& answers, int button = 1) {
        auto* const form = dynamic_cast<juce::AlertWindow*>(juce::Component::getCurrentlyModalComponent());
        ASSERT_NE(form, nullptr);
        for (const auto& [id, text] : answers)
            if (auto* const box = form->getComboBoxComponent(id))
                box->setText(text);
            else
                form->getTextEditor(id)->setText(text);
        form->exitModalState(button);
        ASSERT_TRUE(runUntil([form] { return !form->isVisible(); }));
        editor->refresh();
    }
    void add(const juce::String& what, const Answers& answers, int button = 1) {
        buttonOf(*editor, what)->onClick();
        answer(answers, button);
    }
    juce::String rules() {
        juce::StringArray rows;
        for (int row = 0; row < list.getNumRows(); ++row) rows.add(list.getNameForRow(row));
        return rows.joinIntoString("\n");
    }
};

TEST_F(MidiForms, EachAnswerIsInTheRule) {
    const auto scene = host.plugin->state().scene;
    const juce::String body{scene.bodies.back().name}, material{scene.materials[3].name};
    add("Add a note", {{"note", "61"}, {"material", material}, {"x", "25"}, {"y", "75"}});
    add("Add a note", {{"note", "50"}, {"do", "pushes a body"}, {"object", body}, {"vx", "2"}, {"vy", "3"}});
    const Answers place{{"material", material}, {"x", "10"}, {"y", "20"}, {"vx", "4"}, {"vy", "5"}};
    add("Add a note", place);
    list.returnKeyPressed(1);
    answer({{"note", "127"}, {"do", "spawns a disc at a place"}, {"radius", "0.2"}});
    add("Add a controller", {{"controller", "119"}, {"parameter", "Tilt"}});
    add("Add a controller", {{"controller", "7"}}, 0);
    const juce::String first = "D3 pushes " + body + " by 2.0, 3.0 N s\n";
    const juce::String last = "\nG9 spawns a disc of " + material +
                              " at 10 %, 20 %, radius 0.20 m, 4.0, 5.0 m/s" +
                              "\nCC 119 moves Tilt over its whole range";
    EXPECT_EQ(rules(), first + "C#4 strikes " + material + " at 25 %, 75 %" + last);
    for (const auto& [id, wrong, what] :
         std::vector<std::array<const char*, 3>>{{"note", "128", "strikes a material at a place"},
                                                 {"x", "101", "strikes a material at a place"},
                                                 {"y", "-1", "spawns a disc at a place"},
                                                 {"radius", "0", "spawns a disc at a place"},
                                                 {"vx", "1e10", "pushes a body"}}) {
        const auto before = rules();
        add("Add a note", {{"do", what}, {id, wrong}});
        EXPECT_TRUE(editor->statusText().startsWith("MIDI: ") && rules() == before) << id;
    }
    add("Add a controller", {{"controller", "120"}});
    EXPECT_TRUE(editor->statusText().startsWith("MIDI: ")) << editor->statusText();
    list.returnKeyPressed(1);
    answer({{"note", "60"}, {"x", "30"}});
    list.returnKeyPressed(3);
    answer({{"controller", "1"}, {"parameter", "Gravity"}});
    list.deleteKeyPressed(2);
    editor->refresh();
    EXPECT_EQ(rules(),
              first + "C4 strikes " + material + " at 30 %, 75 %\nCC 1 moves Gravity over its whole range");
    list.deleteKeyPressed(2);
    EXPECT_TRUE(host.plugin->state().controllers.empty());
}

TEST_F(MidiForms, WhatChangesWhileOneIsOpenIsNotMixedUp) {
    auto state = emptyBox();
    const auto show = [&] { host.plugin->edit(state), editor->refresh(); };
    const juce::String material{state.scene.materials[3].name};
    state.notes = {{.note = 40, .material = 3}, {.note = 50, .material = 3}};
    show();
    list.returnKeyPressed(1);
    std::ranges::rotate(state.scene.materials, state.scene.materials.begin() + 1);
    state.notes = {{.note = 30, .material = 2}, {.note = 40, .material = 2}, {.note = 50, .material = 2}};
    show();
    answer({{"note", "51"}});
    const auto row = " strikes " + material + " at 50 %, 50 %";
    EXPECT_EQ(rules(), "F#1" + row + "\nE2" + row + "\nD#3" + row);
    list.returnKeyPressed(0);
    state.scene.materials.resize(1);
    state.notes.clear();
    show();
    answer({});
    EXPECT_EQ(editor->statusText(), "The scene has no material " + material);
}

// Undo, redo, A and B: whole states with their parameters, and SILENCE stays.

using Step = PluginProcessor::Direction;

void seed(PluginProcessor& plugin, std::uint32_t number) {
    auto state = plugin.state();
    state.seed = number;
    ASSERT_TRUE(plugin.edit(state));
    std::this_thread::sleep_for(EditHistory::mergeWindow + std::chrono::milliseconds{20});
}

TEST(EditHistory, GoesBackAndForthAndANewEditForgetsWhatWasUndone) {
    TestHost host;
    auto& plugin = *host.plugin;
    EXPECT_FALSE(plugin.canStep(Step::undo));
    seed(plugin, 5);
    seed(plugin, 6);
    plugin.stepHistory(Step::undo);
    EXPECT_EQ(plugin.state().seed, 5u);
    plugin.stepHistory(Step::undo);
    EXPECT_EQ(plugin.state().seed, 1u);
    EXPECT_FALSE(plugin.canStep(Step::undo));
    plugin.stepHistory(Step::redo);
    EXPECT_EQ(plugin.state().seed, 5u);
    seed(plugin, 7);
    EXPECT_FALSE(plugin.canStep(Step::redo));
}

TEST(EditHistory, AKnobIsAStepAndSilenceIsNone) {
    TestHost host;
    auto &level = host.plugin->parameter(Parameter::level),
         &bypass = host.plugin->parameter(Parameter::bypass);
    const float before = level.getValue();
    for (const auto& [parameter, value] : {std::pair{&level, 0.25f}, {&bypass, 1.0f}}) {
        parameter->beginChangeGesture();
        parameter->setValueNotifyingHost(value);
        parameter->endChangeGesture();
    }
    host.plugin->stepHistory(Step::undo);
    EXPECT_NEAR(level.getValue(), before, 1e-6f);
    EXPECT_EQ(bypass.getValue(), 1.0f) << "nothing but its button lifts it";
    EXPECT_FALSE(host.plugin->canStep(Step::undo));
}

TEST(EditHistory, WhatAutomationMovedStaysWhereItIs) {
    TestHost host;
    auto& plugin = *host.plugin;
    auto& tilt = plugin.parameter(Parameter::tilt);
    seed(plugin, 5);
    tilt.setValue(0.75f); // as a host does it, and a controller
    plugin.stepHistory(Step::undo);
    EXPECT_EQ(plugin.state().seed, 1u);
    EXPECT_EQ(tilt.getValue(), 0.75f);
    tilt.setValue(0.875f);
    plugin.stepHistory(Step::redo);
    EXPECT_EQ(tilt.getValue(), 0.875f);
    plugin.stepHistory(Step::exchange);
    EXPECT_EQ(tilt.getValue(), 0.875f) << "A and B differ in what a hand has moved";
}

TEST(EditHistory, AProgramIsOneStepWithItsParametersWhoeverChoosesIt) {
    const int bass = presetPlace("Bass");
    for (const bool byHost : {true, false}) {
        TestHost host;
        auto& plugin = *host.plugin;
        auto state = plugin.state();
        state.seed = 4;
        ASSERT_TRUE(plugin.edit(state)); // just before: two steps still
        const double level = plugin.parameter(Parameter::strikeLevel).value();
        if (byHost)
            plugin.setCurrentProgram(bass);
        else
            plugin.choosePreset(bass);
        EXPECT_NE(plugin.parameter(Parameter::strikeLevel).value(), level);
        plugin.stepHistory(Step::undo);
        EXPECT_EQ(plugin.state().scene.name, shakenBox().scene.name);
        EXPECT_EQ(plugin.state().seed, 4u);
        EXPECT_NEAR(plugin.parameter(Parameter::strikeLevel).value(), level, 1e-4);
        plugin.stepHistory(Step::redo);
        EXPECT_EQ(plugin.state().scene.name, "Bass");
        plugin.stepHistory(Step::undo);
        plugin.stepHistory(Step::undo);
        EXPECT_EQ(plugin.state().seed, 1u);
        EXPECT_FALSE(plugin.canStep(Step::undo));
    }
}

TEST(EditHistory, AAndBHaveStepsOfTheirOwn) {
    TestHost host;
    auto& plugin = *host.plugin;
    seed(plugin, 5);
    plugin.stepHistory(Step::exchange);
    EXPECT_TRUE(plugin.isAtB());
    EXPECT_EQ(plugin.state().seed, 5u) << "at first the same";
    EXPECT_FALSE(plugin.canStep(Step::undo)) << "nothing was done at B";
    seed(plugin, 6);
    plugin.stepHistory(Step::exchange);
    EXPECT_EQ(plugin.state().seed, 5u);
    plugin.stepHistory(Step::undo);
    EXPECT_EQ(plugin.state().seed, 1u);
    plugin.stepHistory(Step::exchange);
    EXPECT_EQ(plugin.state().seed, 6u);
    plugin.stepHistory(Step::undo);
    EXPECT_EQ(plugin.state().seed, 5u) << "where B began";
}

} // namespace physvib::plugin_editor_test
