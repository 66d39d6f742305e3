// SPDX-License-Identifier: GPL-3.0-or-later
// The instrument's knobs: what each does to notes, that it is at its frame, moved by a controller, kept in
// the state, and that a state without them sounds as it did.
#include "PluginEditor.h"
#include "PluginTesting.h"

namespace physvib::knobs_test {

using namespace test;
using Message = juce::MidiMessage;

PluginState knobPreset(std::string_view name) {
    auto state = presetNamed(name);
    state.limiterEnabled = false;
    return state;
}

struct KnobHost : TestHost {
    explicit KnobHost(const PluginState& state)
        : TestHost{state, 480} {}
    void turn(Parameter which, std::string_view to) { set(which, valueFromText(rowOf(which), to)); }
    /// What is struck by that, as the log has it.
    std::vector<CollisionEvent> struck(std::initializer_list<Message> messages) {
        juce::MidiBuffer midi;
        for (const auto& message : messages) midi.addEvent(message, 0);
        block(480, midi);
        for (int b = 1; b < 20; ++b) block(480);
        std::vector<CollisionEvent> events;
        for (const auto& event : plugin->runs().drainLog()) events.push_back(event.played.event);
        return events;
    }
};

Message struckAt(int note, int velocity = 127) {
    return Message::noteOn(1, note, static_cast<juce::uint8>(velocity));
}

TEST(Knobs, DecayReleaseAndVelocityAreTimesThePresets) {
    KnobHost host{knobPreset("Keys")};
    host.turn(Parameter::decay, "4");
    EXPECT_NEAR(host.struck({struckAt(60)}).at(0).decayPerSecond, 3.0, 1e-5);
    const double full = host.struck({struckAt(60)}).at(0).amplitude;
    host.turn(Parameter::velocityCurve, "2");
    EXPECT_NEAR(host.struck({struckAt(60, 64)}).at(0).amplitude / full, std::pow(64.0 / 127.0, 2.0), 1e-5);
    KnobHost strings{knobPreset("Strings")};
    strings.turn(Parameter::release, "0.25");
    const auto parts = strings.struck({struckAt(60), Message::noteOff(1, 60)});
    EXPECT_NEAR(parts.back().decayPerSecond, std::log(1000.0) / 0.1, 1e-3);
    KnobHost drums{knobPreset("Drum kit")};
    drums.turn(Parameter::decay, "0.5");
    EXPECT_NEAR(drums.struck({struckAt(36)}).at(0).decayPerSecond, 28.0, 1e-4) << "rules too";
}

TEST(Knobs, HoldPlacementBendAndMaterialReplaceThePresets) {
    KnobHost host{knobPreset("Keys")};
    const double width = host.plugin->state().scene.fieldWidthMetres;
    EXPECT_EQ(host.struck({struckAt(60)}).size(), 1u);
    host.turn(Parameter::hold, "on");
    EXPECT_GT(host.struck({struckAt(60)}).size(), 10u) << "a row of strikes while its key is down";
    host.struck({Message::noteOff(1, 60)});
    host.turn(Parameter::hold, "off");
    EXPECT_NEAR(host.struck({struckAt(60)}).at(0).x, 0.0, 1e-9);
    host.turn(Parameter::placement, "middle");
    EXPECT_NEAR(host.struck({struckAt(60)}).at(0).x, 0.5 * width, 1e-9);
    host.turn(Parameter::bendRange, "12 semitones");
    const double pitch = host.struck({Message::pitchWheel(1, 8192), struckAt(60)}).at(0).frequencyHz;
    EXPECT_NEAR(host.struck({Message::pitchWheel(1, 16383), struckAt(60)}).at(0).frequencyHz / pitch, 2.0,
                1e-3);
    host.turn(Parameter::bendRange, "moves the place");
    EXPECT_NEAR(host.struck({struckAt(60)}).at(0).x, width, 1e-3);
    host.struck({Message::pitchWheel(1, 8192)});
    const auto& material = host.plugin->state().scene.materials[3];
    ASSERT_GT(material.frequencyHz, 0.0);
    host.turn(Parameter::noteMaterial, "4");
    const auto strike = host.struck({struckAt(60)}).at(0);
    EXPECT_NEAR(strike.frequencyHz, material.frequencyHz, 1e-3);
    EXPECT_NEAR(strike.decayPerSecond, material.decayPerSecond, 1e-3);
    auto full = knobPreset("Keys");
    full.scene.materials.resize(9, material);
    for (std::size_t m = 1; m <= 8; ++m) {
        full.scene.materials[m - 1].frequencyHz = 60.0 + static_cast<double>(m);
        const NoteKnobs knobs{.material = static_cast<int>(m)};
        EXPECT_EQ(MidiTable{full}.strikeOf(60, knobs, full.layout.geometry).frequencyHz,
                  full.scene.materials[m - 1].frequencyHz)
            << m;
    }
    KnobHost strings{knobPreset("Strings")};
    strings.turn(Parameter::hold, "off");
    EXPECT_EQ(strings.struck({struckAt(60)}).size(), 1u);
}

TEST(Knobs, AControllerMovesThemFromItsFrameOn) {
    auto state = knobPreset("Keys");
    state.controllers = {{20, "decay"}};
    KnobHost host{state};
    juce::MidiBuffer midi;
    midi.addEvent(struckAt(60), 10);
    midi.addEvent(Message::controllerEvent(1, 20, 127), 20);
    midi.addEvent(struckAt(62), 30);
    host.block(480, midi);
    for (int b = 0; b < 20; ++b) host.block(480);
    const auto log = host.plugin->runs().drainLog();
    ASSERT_EQ(log.size(), 2u);
    EXPECT_NEAR(log[0].played.event.decayPerSecond, 12.0, 1e-5);
    EXPECT_NEAR(log[1].played.event.decayPerSecond, 1.5, 1e-5);
}

/// Samples of a chord with bends, of a state as text.
Samples knobChord(const std::string& text) {
    TestHost host;
    for (const auto which : parameterTable::instrumentGroup) host.setNormal(which, 0.9f);
    restore(*host.plugin, text);
    EXPECT_EQ(host.plugin->errorText(), "");
    host.prepare(48000, 480);
    juce::MidiBuffer midi;
    for (const int note : {36, 43, 52, 60}) midi.addEvent(struckAt(note, 50 + note), note);
    midi.addEvent(Message::pitchWheel(1, 12000), 300);
    midi.addEvent(struckAt(67, 40), 400);
    Samples signal;
    host.block(480, midi);
    host.play(24000, signal);
    return signal;
}

TEST(Knobs, StatesWithoutThemSoundAsThePresetWhateverTheyWereBefore) {
    for (const char* const name : {"Keys", "Drum kit", "Strings", "MPE pad"}) {
        auto state = TestHost{}.plugin->state(); // parameters of today
        const auto preset = knobPreset(name);
        state.scene = preset.scene;
        state.voice = preset.voice;
        state.notes = preset.notes;
        const auto now = knobChord(pluginStateJson(state));
        std::erase_if(state.parameters, [](const auto& p) {
            return rowOf(static_cast<Parameter>(findParameter(p.first))).version >= 5;
        });
        EXPECT_EQ(state.parameters.size(), 14u);
        EXPECT_TRUE(knobChord(pluginStateJson(state)) == now) << name;
        EXPECT_GT(peakOf(now), 0.01f) << name;
    }
}

TEST(Knobs, AsThePresetEveryKeyIsWhatItsStateSays) {
    for (const auto& name : presetNames()) {
        const auto state = knobPreset(name);
        const MidiTable table{state};
        for (int note = 0; note < 128; ++note) {
            const auto &plain = table.strikeOf(note), now = table.strikeOf(note, {}, state.layout.geometry);
            EXPECT_TRUE(now.frequencyHz == plain.frequencyHz && now.decayPerSecond == plain.decayPerSecond &&
                        now.amplitude == plain.amplitude)
                << name << note;
            if (plain.frequencyHz > 0.0) EXPECT_TRUE(now.x == plain.x && now.y == plain.y) << name << note;
            EXPECT_EQ(table.isHeld(note, {}), table.isHeld(note)) << name << note;
            EXPECT_EQ(table.velocityAmplitude(note, {}), note / 127.0) << name;
        }
        EXPECT_EQ(table.bendSemitones({}), state.voice.bendSemitones);
        EXPECT_EQ(table.releasePerSecond({}), std::log(1000.0) / state.voice.releaseSeconds);
    }
}

// The layout's extent lies on the whole field, whatever the shapes of both.
TEST(Knobs, APlacementIsThatPlaceOfTheFieldInEveryLayout) {
    bool hasAnOblong = false;
    for (const auto name : layoutPresetNames)
        for (const auto placement : {NotePlacement::octave, NotePlacement::actuators, NotePlacement::middle})
            for (const bool isByKnob : {false, true}) {
                auto state = knobPreset("Keys");
                state.layout = presetLayout(name);
                if (!isByKnob) state.voice.placement = placement;
                const auto& layout = state.layout.geometry;
                const NoteKnobs knobs{.placement = isByKnob ? 1 + static_cast<int>(placement) : 0};
                const MidiTable table{state};
                for (int note = 0; note < 128; ++note) {
                    const auto& on = layout.places[static_cast<std::size_t>(note % layout.count)];
                    hasAnOblong = hasAnOblong ||
                                  (on.yMetres > 0.0 && layout.extentWidthMetres != layout.extentHeightMetres);
                    double x = 0.5, y = 0.5;
                    if (placement == NotePlacement::octave) x = note % 12 / 11.0;
                    if (placement == NotePlacement::actuators)
                        x = on.xMetres / layout.extentWidthMetres, y = on.yMetres / layout.extentHeightMetres;
                    const auto strike = table.strikeOf(note, knobs, layout);
                    ASSERT_NEAR(strike.x, x * state.scene.fieldWidthMetres, 1e-9) << name << ' ' << note;
                    ASSERT_NEAR(strike.y, y * state.scene.fieldHeightMetres, 1e-9) << name << ' ' << note;
                }
            }
    EXPECT_TRUE(hasAnOblong) << "where width and height are alike, no mistake of them is seen";
}

TEST(Knobs, AreKeptInAStateAndSetBackByAPreset) {
    KnobHost host{knobPreset("Keys")}, other{knobPreset("Bass")};
    host.turn(Parameter::decay, "4");
    host.turn(Parameter::placement, "actuators");
    restore(*other.plugin, chunkOf(*host.plugin));
    EXPECT_EQ(other.plugin->noteKnobs(), host.plugin->noteKnobs());
    EXPECT_NE(other.plugin->noteKnobs(), NoteKnobs{});
    other.plugin->setCurrentProgram(static_cast<int>(builtInScenes().size()) + 2);
    EXPECT_EQ(other.plugin->noteKnobs(), NoteKnobs{});
}

TEST(Knobs, ATailIsAsLongAsTheyMakeIt) {
    const auto state = knobPreset("Keys");
    const double usual = tailSeconds(state);
    EXPECT_NEAR(tailSeconds(state, {.decay = 4.0}), 4.0 * usual, 1e-9);
    EXPECT_GT(tailSeconds(state, {.release = 16.0, .hold = 2}), 3.0);
}

TEST(Knobs, TheWindowShowsThoseThatThePresetUses) {
    TestHost host;
    const auto shows = [&](PluginEditor& editor, const char* name) {
        const auto* knob =
            below<juce::Component>(editor, [&](const auto& c) { return c.getTitle() == name; });
        for (; knob != nullptr && knob != &editor && knob->isVisible();) knob = knob->getParentComponent();
        return knob == &editor;
    };
    host.plugin->choosePreset(presetPlace("Keys"));
    const auto editor = openEditor<PluginEditor>(*host.plugin);
    for (const char* const name :
         {"Decay", "Velocity curve", "Hold", "Placement", "Bend range", "Note material"})
        EXPECT_TRUE(shows(*editor, name)) << name;
    for (const char* const name : {"Release", "Gravity", "Tilt", "Material", "Timing"})
        EXPECT_FALSE(shows(*editor, name)) << name;
    host.set(Parameter::hold, valueFromText(rowOf(Parameter::hold), "on"));
    editor->refresh();
    EXPECT_TRUE(shows(*editor, "Release")) << "as soon as notes are held";
    EXPECT_FALSE(shows(*editor, "Decay"));
    host.plugin->choosePreset(presetPlace("Drum kit"));
    host.set(Parameter::hold, valueFromText(rowOf(Parameter::hold), "on"));
    editor->refresh();
    EXPECT_TRUE(shows(*editor, "Release") && shows(*editor, "Decay")) << "what has a rule strikes";
    host.plugin->choosePreset(presetPlace("marbles"));
    editor->refresh();
    for (const char* const name : {"Gravity", "Tilt", "Material", "Timing"})
        EXPECT_TRUE(shows(*editor, name)) << name;
}

} // namespace physvib::knobs_test
