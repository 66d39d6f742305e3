// SPDX-License-Identifier: GPL-3.0-or-later
// State in the host's chunk: round trips, broken ones, any thread, presets, what the host is told.
#include "Io/Text/NameList.h"
#include "PluginTesting.h"
#include "Scene/SceneFile.h"
#include <atomic>
#include <chrono>
#include <functional>
#include <future>

namespace physvib::plugin_state_test {

using namespace test;

TEST(PluginChunk, RoundTripsToTheByteAndToTheSample) {
    TestHost first, second;
    Random random{3};
    for (int i = 0; i < 20; ++i) {
        auto state = first.plugin->state();
        state.scene = builtInScenes()[static_cast<std::size_t>(random.below(5))];
        state.seed = static_cast<std::uint32_t>(random.below(1000));
        state.layout = presetLayout(layoutPresetNames[static_cast<std::size_t>(random.below(8))]);
        state.transport = static_cast<TransportMode>(random.below(3));
        state.limiterEnabled = random.below(2) == 0;
        ASSERT_TRUE(first.plugin->apply(state));
        for (auto* p : first.plugin->getParameters()) p->setValue(static_cast<float>(random.uniform(0, 1)));
        const auto chunk = chunkOf(*first.plugin);
        restore(*second.plugin, chunk);
        ASSERT_EQ(second.plugin->errorText(), "");
        EXPECT_TRUE(chunkOf(*second.plugin) == chunk);
        if (i % 5 > 0) continue;
        first.prepare(48000, 512);
        second.prepare(48000, 512);
        EXPECT_TRUE(first.played(24000) == second.played(24000));
    }
}

TEST(PluginChunk, ABrokenChunkLeavesTheLastGoodStateAndSaysSo) {
    TestHost host;
    host.plugin->setCurrentProgram(2);
    host.setNormal(Parameter::tilt, 0.75f);
    const auto good = chunkOf(*host.plugin);
    const std::string text = good.toString().toStdString();
    Random random{5};
    for (int i = 0; i < 300; ++i) {
        std::string broken = text;
        const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
        if (i % 3 == 0)
            broken.resize(at);
        else
            broken[at] = static_cast<char>(random.below(256));
        restore(*host.plugin, broken);
        if (host.plugin->errorText().isNotEmpty())
            EXPECT_EQ(pluginStateJson(host.plugin->state()), text) << host.plugin->errorText();
        restore(*host.plugin, good);
        ASSERT_EQ(host.plugin->errorText(), "");
    }
    // no UTF-8, which messages quote
    for (const std::string bytes :
         {"{ \"\xff\": 1 }", "\xf0\x9f", "{ \"physvib_plugin_state\": \"\xe2\x82"}) {
        restore(*host.plugin, bytes);
        EXPECT_TRUE(host.plugin->errorText().startsWith("state: "));
        EXPECT_TRUE(juce::CharPointer_UTF8::isValidString(
            host.plugin->errorText().toRawUTF8(),
            static_cast<int>(host.plugin->errorText().getNumBytesAsUTF8())));
    }
    host.plugin->setStateInformation("{}", 2);
    EXPECT_TRUE(host.plugin->errorText().startsWith("state: ")) << host.plugin->errorText();
    host.plugin->setStateInformation(nullptr, 0);
    EXPECT_TRUE(chunkOf(*host.plugin) == good);
}

std::string newerThan(const std::string& text) {
    const std::string from = "\"physvib_plugin_state\": ", now = from + std::to_string(pluginStateVersion);
    return from + "99" + text.substr(text.find(now) + now.size());
}

TEST(PluginChunk, ARefusedChunkIsWhatTheNextSaveGivesBackUntilAHandEdits) {
    TestHost host;
    const auto own = chunkOf(*host.plugin);
    const std::string newer = "{ " + newerThan(own.toString().toStdString());
    auto& level = host.plugin->parameter(Parameter::level);
    const auto refuse = [&] { restore(*host.plugin, newer); };
    const auto saved = [&] { return chunkOf(*host.plugin).toString().toStdString(); };
    const auto gesture = [&](Parameter which) {
        host.plugin->parameter(which).beginChangeGesture();
        host.plugin->parameter(which).endChangeGesture();
    };
    refuse();
    EXPECT_TRUE(host.plugin->errorText().contains("made for a newer PhysVib")) << host.plugin->errorText();
    EXPECT_EQ(saved(), newer);
    level.setValue(0.5f);       // as automation does
    gesture(Parameter::bypass); // silence first, think then
    EXPECT_EQ(saved(), newer);
    gesture(Parameter::level);
    EXPECT_NE(saved(), newer) << "a knob that a hand has moved";
    EXPECT_EQ(host.plugin->errorText(), "");
    refuse();
    host.plugin->edit(host.plugin->state());
    EXPECT_NE(saved(), newer) << "an edit";
    refuse();
    host.plugin->setCurrentProgram(1);
    EXPECT_NE(saved(), newer) << "another program";
    refuse();
    restore(*host.plugin, own);
    EXPECT_TRUE(chunkOf(*host.plugin) == own) << "a chunk that can be read";
}

TEST(PluginChunk, ParametersOfAnotherPhysVibAreRefused) {
    TestHost host;
    auto state = host.plugin->state();
    state.parameters.emplace_back("wobble", 1.0);
    restore(*host.plugin, pluginStateJson(state));
    EXPECT_EQ(host.plugin->errorText(), "state: no parameter \"wobble\"");
}

TEST(PluginChunk, AChoiceIsKeptByItsWord) {
    TestHost host;
    auto& law = host.plugin->parameter(Parameter::law);
    law.setValue(law.getValueForText("log-outer"));
    const auto chunk = chunkOf(*host.plugin).toString();
    EXPECT_TRUE(chunk.contains("\"law\": \"log-outer\""));
    const auto give = [&](const juce::String& value) {
        restore(*host.plugin, chunk.replace("\"law\": \"log-outer\"", "\"law\": " + value).toStdString());
    };
    give("3");
    EXPECT_EQ(law.value(), 3.0) << "as version 1 wrote it";
    give("\"logarithmic\"");
    EXPECT_EQ(host.plugin->errorText().toStdString(), "state: parameters.law: expected one of " +
                                                          nameList(rowOf(Parameter::law).choices) +
                                                          ", found \"logarithmic\"");
    EXPECT_EQ(law.value(), 3.0);
    auto state = host.plugin->state();
    state.parameters = {{"level", "loud"}};
    restore(*host.plugin, pluginStateJson(state));
    EXPECT_EQ(host.plugin->errorText(), "state: parameters.level: expected a number, found \"loud\"");
}

// In the processor too, since sanitizers see no module.
TEST(PluginChunk, ComesAndGoesOnAnyThreadWhileItAndOthersPlay) {
    std::vector<juce::MemoryBlock> chunks;
    for (int program = 0; program < 5; ++program) {
        TestHost host;
        host.plugin->setCurrentProgram(program);
        chunks.push_back(chunkOf(*host.plugin));
    }
    std::vector<std::unique_ptr<TestHost>> hosts;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < 4; ++i) {
        auto& host = *hosts.emplace_back(std::make_unique<TestHost>());
        host.prepare(48000, 256, false);
        threads.emplace_back([&host] {
            for (int b = 0; b < 250; ++b) EXPECT_LE(host.block(256).getMagnitude(0, 256), 1.0f);
        });
        threads.emplace_back([&host, &chunks, i] {
            for (std::size_t n = i; n < i + 20; ++n) {
                restore(*host.plugin, chunks[n % 5]);
                EXPECT_TRUE(chunkOf(*host.plugin) == chunks[n % 5]);
            }
        });
    }
    for (auto& thread : threads) thread.join();
    for (const auto& host : hosts) EXPECT_EQ(host->plugin->errorText(), "");
}

TEST(PluginChunk, FactoryPresetsAreTheBuiltInScenesAndBehindThemInstruments) {
    TestHost host;
    const int worlds = static_cast<int>(builtInScenes().size()), count = host.plugin->getNumPrograms();
    ASSERT_EQ(count, worlds + 12);
    // saved projects know them by their places: new ones come at the end
    ASSERT_EQ(host.plugin->getProgramName(4), "Box study");
    for (int i = 0; i < count; ++i) {
        host.plugin->setCurrentProgram(i);
        EXPECT_EQ(host.plugin->getProgramName(i).toStdString(), displayName(host.plugin->state().scene.name));
        EXPECT_EQ(host.plugin->getTailLengthSeconds() == std::numeric_limits<double>::infinity(), i < worlds)
            << "a world goes on by itself";
    }
    host.plugin->setCurrentProgram(99);
    EXPECT_EQ(host.plugin->getCurrentProgram(), count - 1);
    EXPECT_EQ(host.plugin->getProgramName(99), "");
    host.plugin->apply(strikeAt(0, 4));
    EXPECT_NEAR(host.plugin->getTailLengthSeconds(), 1.35, 0.01)
        << "without a world: the longest ring of its materials";
}

TEST(PluginChunk, TheProgramIsTheSceneThatPlays) {
    TestHost host;
    const HostNews listener{*host.plugin};
    auto state = host.plugin->state();
    const auto editTo = [&](const Scene& scene) {
        state.scene = scene;
        host.plugin->edit(state);
    };
    editTo(builtInScenes()[3]);
    EXPECT_EQ(host.plugin->getCurrentProgram(), 3);
    EXPECT_EQ(listener.programs, 1) << "the host's menu shows it";
    host.plugin->apply(shakenBox());
    EXPECT_EQ(host.plugin->getCurrentProgram(), 0);
    Scene own = builtInScenes()[3];
    own.gravityMetresPerSecond2.y *= 0.5;
    editTo(own);
    EXPECT_EQ(host.plugin->getCurrentProgram(), 3) << "it bears the name";
    host.plugin->setCurrentProgram(3);
    auto builtIn = host.plugin->state(); // on as many actuators
    applyBuiltInPreset(builtIn, 3);
    EXPECT_TRUE(host.plugin->state().scene == builtIn.scene) << "chosen again, it is the built-in one";
    const auto count = host.plugin->stateVersion();
    host.plugin->setCurrentProgram(3);
    EXPECT_EQ(host.plugin->stateVersion(), count) << "hosts repeat themselves: the world does not start anew";
    const auto& decay = host.plugin->parameter(Parameter::decay);
    host.set(Parameter::decay, 4.0);
    host.plugin->setCurrentProgram(3);
    EXPECT_EQ(decay.value(), 1.0) << "with its knobs";
    EXPECT_EQ(host.plugin->stateVersion(), count);
    host.plugin->stepHistory(PluginProcessor::Direction::undo);
    EXPECT_NEAR(decay.value(), 4.0, 1e-5);
    host.plugin->stepHistory(PluginProcessor::Direction::undo);
    EXPECT_TRUE(host.plugin->state().scene == own) << "what changed nothing is no step";
}

TEST(PluginChunk, APresetIsTheSameWhateverWasChosenBefore) {
    const int count = static_cast<int>(presetNames().size());
    const auto chosen = [](PluginState state, int preset) {
        applyBuiltInPreset(state, preset, 4);
        std::ranges::sort(state.parameters, {}, [](const auto& p) { return p.first; });
        return state;
    };
    int same = 0;
    for (int to = 0; to < count; ++to) {
        const std::string at = pluginStateJson(chosen(newPluginState(), to));
        for (int via = 0; via < count; ++via)
            same += pluginStateJson(chosen(chosen(newPluginState(), via), to)) == at;
    }
    std::printf("presets: %d of %d ways to one give the same state\n", same, count * count);
    EXPECT_EQ(same, count * count);
}

// To the other ends of the parameters' ranges, with notes and a controller, while it plays.
TEST(PluginChunk, NothingIsLeftOfTheStateBefore) {
    std::vector<std::function<void(PluginState&)>> changes{
        [](PluginState& s) { applyBuiltInPreset(s, presetPlace("marbles"), 4); },
        [](PluginState& s) { applyBuiltInPreset(s, presetPlace("Drum kit"), 4); },
        [](PluginState& s) { s.seed = 7; },
        [](PluginState& s) { s.stepsPerSecond = 500; },
        [](PluginState& s) { applyLayoutPreset(s, "ring3"); },
        [](PluginState& s) { s.strips[1] = {-7.5, true, true, true, 12.5, -6.0, 1}; },
        [](PluginState& s) {
            s.equalised[2] = {{205.0, 12.0}, {160.0, 260.0}};
        },
        [](PluginState& s) { s.limiterEnabled = false; },
        [](PluginState& s) { s.transport = TransportMode::inTempo; },
        [](PluginState& s) { s.isDirect = true; },
        [](PluginState& s) { s.voice = presetNamed("MPE pad").voice; },
        [](PluginState& s) { s.notes = {{.note = 60, .kind = NoteKind::spawn, .material = 3}}; },
        [](PluginState& s) {
            s.controllers = {{7, "level"}};
        },
        [](PluginState& s) { s.editorWidth = s.editorHeight = 1500; }};
    for (const auto& row : allParameters())
        changes.emplace_back([&row](PluginState& s) {
            setParameter(s, row.parameter, row.initial < row.maximum ? row.maximum : row.minimum);
        });
    const auto play = [](TestHost& host) { // the note when what was owed has rung out
        juce::MidiBuffer midi = oneNote(60);
        midi.addEvent(juce::MidiMessage::controllerEvent(1, 7, 20), 100);
        midi.addEvent(juce::MidiMessage::noteOff(1, 60), 400);
        host.played(48000);
        Samples signal;
        append(signal, host.block(480, midi));
        host.play(9600, signal);
        return signal;
    };
    for (const char* const name : {"Keys", "shake-the-box"}) {
        const auto state = presetNamed(name);
        const auto chunk = pluginStateJson(state);
        TestHost fresh;
        restore(*fresh.plugin, chunk);
        fresh.prepare(48000, 480);
        const auto saved = chunkOf(*fresh.plugin);
        const auto expected = play(fresh);
        EXPECT_GT(peakOf(expected), 0.01f);
        for (std::size_t i = 0; i < changes.size(); ++i) {
            SCOPED_TRACE(name + std::string{", change "} + std::to_string(i));
            auto changed = state;
            changes[i](changed);
            TestHost host;
            restore(*host.plugin, pluginStateJson(changed));
            ASSERT_EQ(host.plugin->errorText(), "");
            EXPECT_FALSE(chunkOf(*host.plugin) == saved);
            host.prepare(48000, 480);
            play(host);
            restore(*host.plugin, chunk);
            EXPECT_TRUE(chunkOf(*host.plugin) == saved);
            EXPECT_EQ(host.plugin->getCurrentProgram(), fresh.plugin->getCurrentProgram());
            EXPECT_EQ(host.plugin->getLatencySamples(), fresh.plugin->getLatencySamples());
            EXPECT_EQ(host.plugin->getTailLengthSeconds(), fresh.plugin->getTailLengthSeconds());
            EXPECT_TRUE(play(host) == expected);
        }
    }
}

TEST(PluginChunk, AStopIsSilentAndNoPartOfIt) {
    TestHost host{shakenBox(), 512};
    const auto before = chunkOf(*host.plugin);
    for (const bool isStopped : {false, true, false}) {
        host.plugin->setStopped(isStopped);
        host.played(24000);
        EXPECT_EQ(peakOf(host.played(96000)) > 0.0f, !isStopped);
        EXPECT_EQ(chunkOf(*host.plugin), before);
    }
}

TEST(PluginChunk, AStateThatIsTakenIsNoEdit) {
    TestHost host{shakenBox(), 512};
    const auto chunk = chunkOf(*host.plugin);
    const HostNews listener{*host.plugin};
    restore(*host.plugin, chunk);
    runFor(0.1);
    EXPECT_EQ(listener.parameters, 0) << "what the host knows";
    host.setNormal(Parameter::tilt, 0.75f);
    restore(*host.plugin, chunk);
    EXPECT_EQ(listener.parameters, 1) << "the one that it does not";
    EXPECT_EQ(listener.edits, 0);
    EXPECT_EQ(listener.latencies, 0);
}

/// Whatever it is told of, it has somebody else look at the plug-in, and waits for that.
struct Curious final : juce::AudioProcessorListener {
    explicit Curious(PluginProcessor& about)
        : plugin{about} {}
    void look() {
        if (isLooking.exchange(true)) return;
        ++looks;
        const auto done = std::async(std::launch::async, [this] {
            plugin.state();
            plugin.errorText();
            plugin.runs().drainLog();
            std::vector<BodyPose> poses;
            plugin.runs().readPoses(poses);
            plugin.apply(plugin.state());
        });
        const bool isFree = done.wait_for(std::chrono::seconds{20}) == std::future_status::ready;
        EXPECT_TRUE(isFree) << "a lock is held while the host is told";
        if (!isFree) std::abort(); // it would wait for ever
        isLooking = false;
    }
    void audioProcessorParameterChanged(juce::AudioProcessor*, int, float) override { look(); }
    void audioProcessorChanged(juce::AudioProcessor*, const ChangeDetails&) override { look(); }
    PluginProcessor& plugin;
    int looks = 0;
    std::atomic<bool> isLooking{false};
};

TEST(PluginChunk, NoLockIsHeldWhileTheHostIsTold) {
    TestHost host{{BusPlan::Kind::manyBuses}};
    host.prepare(48000, 512, false);
    const auto chunk = chunkOf(*host.plugin);
    Curious curious{*host.plugin};
    host.plugin->addListener(&curious);
    auto state = host.plugin->state();
    state.stepsPerSecond = 500;
    host.plugin->edit(state); // a latency, an edit
    host.setNormal(Parameter::tilt, 0.75f);
    // a latency, a parameter
    restore(*host.plugin, chunk);
    host.plugin->parameter(Parameter::level).setByController(0.5f);
    for (int i = 0; i < 100 && curious.looks < 5; ++i) runFor(0.05); // the timer tells of the controller
    EXPECT_EQ(curious.looks, 5);
    host.plugin->removeListener(&curious);
}

TEST(PluginChunk, TheHostIsToldOfALatencyThatChanges) {
    TestHost host{shakenBox(), 512};
    const int before = host.plugin->getLatencySamples();
    EXPECT_EQ(before, 512 + 480 + 960 + 47) << "a block, 10 ms of gap, two steps, the limiter";
    const HostNews listener{*host.plugin};
    auto state = host.plugin->state();
    state.stepsPerSecond = 1000;
    host.plugin->apply(state);
    EXPECT_LT(host.plugin->getLatencySamples(), before);
    EXPECT_EQ(listener.latencies, 1);
}

} // namespace physvib::plugin_state_test
