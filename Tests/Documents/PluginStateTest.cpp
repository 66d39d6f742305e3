// SPDX-License-Identifier: MIT
// The plug-in's state: round trips, what is refused and where, and version 1's states stay readable.
#include "Live/Documents/PluginState.h"
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneFile.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace physvib::plugin_state_test {

NoteRule strike(int note, int material, double x, double y) {
    NoteRule rule;
    rule.note = note;
    rule.material = material;
    rule.x = x;
    rule.y = y;
    return rule;
}

PluginState sampleState(const char* scene = "fruit-basket") {
    PluginState s;
    s.scene = *findBuiltInScene(scene);
    s.scene.variables.clear();
    ActuatorLayout ring;
    layoutPreset("ring3", ring);
    s.layout = describeLayout("ring3", ring);
    s.strips.resize(3);
    s.strips[0] = {-7.5, true, false, true, 12.5, -6.0, 0};
    s.strips[1] = {minStripDb, false, true, false, 0.0, 0.0, 1};
    s.strips[2].output = 2;
    s.equalised[1] = {{205.0, 12.0}, {160.0, 260.0}};
    s.seed = 4294967295u;
    s.stepsPerSecond = 500;
    s.limiterEnabled = false;
    s.transport = TransportMode::restartOnPlay;
    s.isDirect = true;
    s.notes = {strike(60, 1, 0.1, 1.0), strike(127, 0, 0.0, 0.25)};
    NoteRule push, spawn;
    push.note = 1;
    push.kind = NoteKind::push;
    push.object = s.scene.bodies.front().name;
    push.atFullVelocity = {1.5, -2.0};
    spawn = strike(2, 0, 0.5, 0.9);
    spawn.kind = NoteKind::spawn;
    spawn.atFullVelocity = {0.0, -3.0};
    spawn.radiusMetres = 0.25;
    s.notes.push_back(push);
    s.notes.push_back(spawn);
    s.controllers = {{1, "tilt"}};
    s.editorWidth = 1500;
    s.editorHeight = 900;
    s.parameters = {{"bypass", "off"}, {"level", -7.123456789}};
    return s;
}

void expectSame(const PluginState& a, const PluginState& b) {
    EXPECT_TRUE(a.scene == b.scene);
    EXPECT_EQ(layoutJson(a.layout), layoutJson(b.layout));
    EXPECT_EQ(a.strips, b.strips);
    EXPECT_EQ(a.equalised, b.equalised);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.stepsPerSecond, b.stepsPerSecond);
    EXPECT_EQ(a.limiterEnabled, b.limiterEnabled);
    EXPECT_EQ(a.transport, b.transport);
    EXPECT_EQ(a.isDirect, b.isDirect);
    EXPECT_EQ(a.notes, b.notes);
    EXPECT_EQ(a.controllers, b.controllers);
    EXPECT_EQ(a.editorWidth, b.editorWidth);
    EXPECT_EQ(a.editorHeight, b.editorHeight);
    EXPECT_EQ(a.parameters, b.parameters);
}

TEST(PluginState, GrainsAreHeldAndOlderStatesAreSmooth) {
    auto state = sampleState();
    const std::string older = pluginStateJson(state);
    EXPECT_EQ(older.find("grain"), std::string::npos) << "as it was written before there were any";
    const auto smooth = readPluginState(older, "f");
    ASSERT_TRUE(smooth) << smooth.error;
    for (const Material& m : smooth.value.scene.materials) EXPECT_FALSE(m.texture().isRough());
    state.scene.materials[0].setTexture({0.004, 2.5, GrainPattern::regular, 0.75});
    const auto rough = readPluginState(pluginStateJson(state), "f");
    ASSERT_TRUE(rough) << rough.error;
    expectSame(rough.value, state);
    std::string wrong = pluginStateJson(state);
    wrong.replace(wrong.find("\"roughness\": 2.5"), 16, "\"roughness\": -2 ");
    EXPECT_EQ(readPluginState(wrong, "f").error,
              "f: scene: materials[0].roughness: expected 0 to 1000, found -2");
}

TEST(PluginState, EverySceneComesBackBitForBit) {
    for (const Scene& scene : builtInScenes()) {
        const auto state = sampleState(scene.name.c_str());
        const std::string text = pluginStateJson(state);
        const auto read = readPluginState(text, "f");
        ASSERT_TRUE(read) << read.error;
        expectSame(read.value, state);
        EXPECT_EQ(pluginStateJson(read.value), text);
    }
}

std::string refusal(std::string text, const std::string& found, const std::string& replacement) {
    const auto at = text.find(found);
    EXPECT_NE(at, std::string::npos) << found;
    if (at != std::string::npos) text.replace(at, found.size(), replacement);
    const auto read = readPluginState(text, "f");
    EXPECT_FALSE(read);
    EXPECT_TRUE(read.value.scene == Scene{}) << "half-loaded";
    return read.error;
}

std::string asVersion(int version, std::string text) {
    const std::string field = "\"physvib_plugin_state\": ";
    return text.replace(text.find(field), field.size() + 1, field + std::to_string(version));
}

TEST(PluginState, OneThatKnowsNothingOfDirectStrikesHasNone) {
    std::string older = pluginStateJson(sampleState());
    const std::string direct = "\"direct\": true,";
    ASSERT_NE(older.find(direct), std::string::npos);
    older.replace(older.find(direct), direct.size(), "");
    const auto read = readPluginState(asVersion(2, older), "f");
    ASSERT_TRUE(read) << read.error;
    EXPECT_FALSE(read.value.isDirect);
}

TEST(PluginState, WhatIsWrongIsNamed) {
    const std::string text = pluginStateJson(sampleState());
    EXPECT_EQ(refusal(text, "\"physvib_plugin_state\": 5", "\"physvib_plugin_state\": 6"),
              "f: physvib_plugin_state: made for a newer PhysVib: expected a version up to 5, found 6");
    EXPECT_EQ(refusal(text, "\"x\": 0.1", "\"x\": 2"),
              "f: notes[0].x: expected a number from 0 to 1, found 2");
    EXPECT_EQ(refusal(text, "\"note\": 60", "\"note\": 128"),
              "f: notes[0].note: expected 0 to 127, found 128");
    EXPECT_EQ(refusal(text,
                      "\"do\": \"push\", \"object\": \"" + sampleState().scene.bodies.front().name + "\"",
                      "\"do\": \"push\", \"object\": \"nobody\""),
              "f: notes[2].object: expected the name of a body that the scene starts with, found \"nobody\"");
    EXPECT_EQ(refusal(text, "\"radius_m\": 0.25", "\"radius_m\": 0"),
              "f: notes[3].radius_m: expected at least 0.01");
    EXPECT_EQ(refusal(text, "\"ceiling_db\": -6", "\"ceiling_db\": 6"),
              "f: strips[0].ceiling_db: expected -60 to 0, found 6");
    EXPECT_EQ(refusal(text, "\"q\": 12", "\"q\": -1"), "f: equalised[1].q: expected 0.05 to 1000, found -1");
    EXPECT_EQ(refusal(text, "\"strips\": [", "\"strips\": [ { \"gain_db\": 0 },"),
              "f: strips: expected one strip per actuator, 3");
    EXPECT_EQ(refusal(text, "\"controller\": 1", "\"controller\": 120"),
              "f: controllers[0].controller: expected 0 to 119, found 120");
    EXPECT_EQ(refusal(text, "restart-on-play", "sometimes"),
              "f: transport: expected one of free, restart-on-play, in-tempo, found \"sometimes\"");
    EXPECT_EQ(refusal(text, "\"steps_per_second\": 500", "\"steps_per_second\": 1"),
              "f: steps_per_second: expected 10 to 10000, found 1");
    EXPECT_EQ(refusal(text, "\"seed\": 4294967295", "\"seed\": 1.5"),
              "f: seed: expected a whole number, found 1.5");
    EXPECT_EQ(refusal(text, "\"level\": -7.123456789", "\"level\": true"),
              "f: parameters.level: expected a number, found a boolean");
    EXPECT_NE(refusal(text, "\"extent_m\"", "\"extent\"").find("f: layout: "), std::string::npos);
    EXPECT_NE(refusal(text, "\"limiter\"", "\"limit\"").find("unknown field \"limit\""), std::string::npos);
    EXPECT_NE(refusal(text, "\"bodies\"", "\"bodys\"").find("f: scene: "), std::string::npos);
    EXPECT_NE(refusal(text, "{", "").find("f: line 2"), std::string::npos);
}

// But for those of the scene, which has tests of its own, and the window's size: whole pixels, or the
// default.
TEST(PluginState, WhateverAValueIsReplacedByIsRefusedOrComesBack) {
    using nlohmann::json;
    const json root = json::parse(pluginStateJson(sampleState("drop")));
    const json flat = root.flatten();
    int refused = 0, taken = 0;
    for (const auto& [place, value] : flat.items()) {
        if (place.starts_with("/scene/") || place.starts_with("/editor_px/")) continue;
        for (const json& other : {json(-1e300), json(1e300), json(-1), json(0.5), json("x"), json(true),
                                  json(nullptr), json::array(), json::object()}) {
            json changed = root;
            changed[json::json_pointer{place}] = other;
            const auto read = readPluginState(changed.dump(), "f");
            ++(read ? taken : refused);
            if (read)
                EXPECT_EQ(json::parse(pluginStateJson(read.value)), changed) << place << ' ' << other;
            else
                EXPECT_TRUE(read.error.starts_with("f: ")) << read.error;
        }
    }
    std::printf("a state's values: %d others refused, %d taken\n", refused, taken);
    EXPECT_GT(taken, 50);
    EXPECT_GT(refused, 500);
}

TEST(PluginState, ItsListsHaveBounds) {
    for (const int more : {0, 1}) {
        auto notes = sampleState(), controllers = notes, parameters = notes;
        notes.notes.assign(static_cast<std::size_t>(128 + more), strike(60, 1, 0.1, 1.0));
        controllers.controllers.assign(static_cast<std::size_t>(120 + more), {1, "tilt"});
        for (int i = 2; i < 1000 + more; ++i)
            parameters.parameters.emplace_back("p" + std::to_string(i), 0.5);
        const std::array<std::pair<PluginState, std::string>, 3> rows{
            {{notes, "f: notes: expected at most 128 items, found 129"},
             {controllers, "f: controllers: expected at most 120 items, found 121"},
             {parameters, "f: parameters: expected at most 1000 parameters"}}};
        for (const auto& [state, error] : rows)
            EXPECT_EQ(readPluginState(pluginStateJson(state), "f").error, more > 0 ? error : "");
    }
}

TEST(PluginState, AStateOfVersionOneStaysReadable) { // hosts keep such states for years
    const auto text = readFile(PHYSVIB_SOURCE_DIR "/Tests/Documents/plugin-state-1.json", 1'000'000);
    ASSERT_TRUE(text) << text.error;
    const auto read = readPluginState(text.value, "f");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.scene.name, "drop");
    EXPECT_EQ(read.value.layout.actuators.size(), 3u);
    EXPECT_EQ(read.value.notes, (std::vector<NoteRule>{strike(60, 1, 0.1, 1.0), strike(127, 0, 0.0, 0.25)}));
    EXPECT_EQ(read.value.parameters.size(), 2u);
    for (const Strip& s : read.value.strips)
        EXPECT_EQ(s.gainDb + s.delayMs + s.ceilingDb + (s.isMuted || s.isSolo || s.isInverted ? 1.0 : 0.0),
                  0.0)
            << "no mix";
    EXPECT_EQ(read.value.strips.size(), 3u);
    EXPECT_EQ(read.value.equalised, EqualisedActuators{});
    EXPECT_EQ(read.value.controllers, (std::vector<ControllerRule>{{1, "tilt"}})) << "somebody's own";
}

TEST(PluginState, TheControllersThatVersionOneGaveEveryInstanceAreLeftOut) {
    auto state = sampleState();
    state.controllers = {{1, "tilt"}, {7, "level"}, {16, "gravity"}, {17, "exponent"}};
    const std::string text = pluginStateJson(state);
    const auto chosen = readPluginState(text, "f");
    EXPECT_EQ(chosen.value.controllers.size(), 4u) << "since version 2 they are a choice";
    const auto read = readPluginState(asVersion(1, text), "f");
    ASSERT_TRUE(read) << read.error;
    EXPECT_TRUE(read.value.controllers.empty());
}

} // namespace physvib::plugin_state_test
