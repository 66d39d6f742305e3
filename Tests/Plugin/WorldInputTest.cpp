// SPDX-License-Identifier: GPL-3.0-or-later
// What automation and notes do to the world: gravity, tilt, materials, pushes, discs; each felt, repeatable.
#include "PluginTesting.h"
#include "Scene/SceneFile.h"
#include <set>

namespace physvib::world_input_test {

using namespace test;

/// What is played in three seconds, of which the first second is left alone.
template <class Change>
std::vector<CollisionEvent> after(Change change, int block = 480, const PluginState& state = shakenBox()) {
    TestHost host{state, block};
    host.played(48000);
    change(host);
    host.played(96000 + host.plugin->getLatencySamples());
    host.plugin->releaseResources();
    std::vector<CollisionEvent> events;
    for (const auto& e : host.plugin->runs().drainLog()) events.push_back(e.played.event);
    std::erase_if(events, [](const auto& e) { return e.timeNs >= 3'000'000'000; });
    return events;
}

constexpr auto nothing = [](TestHost&) {};
auto set(Parameter which, float normal) {
    return [=](TestHost& host) { host.setNormal(which, normal); };
}
auto play(int note, int velocity = 127) {
    return [=](TestHost& host) { host.block(host.largest, oneNote(note, velocity)); };
}

TEST(WorldInput, GravityTiltAndMaterialAreFeltAndRepeat) {
    auto state = shakenBox();
    state.scene.script.clear(); // which sets gravity itself
    state.scene.scriptPeriodSeconds = 0.0;
    const auto undisturbed = after(nothing, 480, state);
    for (const auto& [which, normal] :
         {std::pair{Parameter::gravity, 0.9f}, {Parameter::tilt, 0.75f}, {Parameter::material, 0.5f}}) {
        const auto moved = after(set(which, normal), 480, state);
        EXPECT_FALSE(moved == undisturbed) << rowOf(which).id;
        EXPECT_TRUE(moved == after(set(which, normal), 480, state)) << rowOf(which).id;
        EXPECT_TRUE(moved == after(set(which, normal), 64, state))
            << rowOf(which).id << " at another block size";
        const auto first = [](const auto& events) {
            return std::count_if(events.begin(), events.end(),
                                 [](const auto& e) { return e.timeNs < 1'000'000'000; });
        };
        EXPECT_EQ(first(moved), first(undisturbed)) << "nothing before it";
    }
}

TEST(WorldInput, GravityAndTiltActOnWhatAScriptSets) {
    auto scripted = shakenBox();
    scripted.scene.script = {{1.5, 1, 0.0, GravityAction{{9.0, 9.0}}}};
    scripted.scene.scriptPeriodSeconds = 0.0;
    auto plain = scripted;
    plain.scene.script.clear();
    EXPECT_FALSE(after(nothing, 480, scripted) == after(nothing, 480, plain));
    const auto without = set(Parameter::gravity, 0.0f); // nothing times whatever the script says
    EXPECT_TRUE(after(without, 480, scripted) == after(without, 480, plain));
    const auto turned = set(Parameter::tilt, 0.75f);
    EXPECT_FALSE(after(turned, 480, scripted) == after(turned, 480, plain));
}

TEST(WorldInput, ThePresentGravityIsNoInput) {
    EXPECT_TRUE(after(set(Parameter::gravity, 0.25f)) == after(nothing));
}

TEST(WorldInput, AMaterialIsHeardInEverythingThatIsFelt) {
    const auto scene = shakenBox().scene;
    const auto events = after(set(Parameter::material, 4.0f / 8.0f)); // the fourth: concrete wall
    std::set<double> later;
    for (const auto& e : events)
        if (e.timeNs > 1'100'000'000) later.insert(e.frequencyHz);
    EXPECT_EQ(later, (std::set<double>{scene.materials[3].frequencyHz}));
}

TEST(WorldInput, APushMovesABodyByItsVelocity) {
    auto state = shakenBox();
    const auto body = std::ranges::find_if(state.scene.bodies,
                                           [](const auto& b) { return b.type == BodyType::dynamicBody; });
    ASSERT_NE(body, state.scene.bodies.end());
    state.notes = {
        {.note = 60, .kind = NoteKind::push, .object = body->name, .atFullVelocity = {100000.0, 0.0}}};
    const auto hard = after(play(60), 480, state), soft = after(play(60, 1), 480, state);
    EXPECT_FALSE(hard == soft);
    EXPECT_TRUE(hard == after(play(60), 480, state));
}

TEST(WorldInput, SpawnedDiscsAreFeltAndTheOldestMakeRoom) {
    auto state = shakenBox();
    state.notes = {{.note = 61, .kind = NoteKind::spawn, .material = 1, .atFullVelocity = {0.0, -5.0}}};
    TestHost host{state, 480};
    std::vector<BodyPose> poses;
    host.block(480);
    host.plugin->runs().readPoses(poses);
    const auto before = std::ranges::count_if(poses, &BodyPose::isPresent);
    for (int i = 0; i < 100; ++i) play(61)(host);
    for (int i = 0; i < 10; ++i) host.block(480);
    host.plugin->runs().readPoses(poses);
    EXPECT_EQ(std::ranges::count_if(poses, &BodyPose::isPresent), before + 64);
    EXPECT_FALSE(after(play(61), 480, state) == after(nothing, 480, state));
}

TEST(WorldInput, RulesThatTheSceneDoesNotBearAreRefused) {
    TestHost host;
    auto state = host.plugin->state();
    state.notes = {{.note = 60, .kind = NoteKind::push, .object = "nobody"}};
    EXPECT_FALSE(host.plugin->apply(state));
    EXPECT_NE(host.plugin->errorText(), "");
    EXPECT_TRUE(host.plugin->state().notes.empty());
}

} // namespace physvib::world_input_test
