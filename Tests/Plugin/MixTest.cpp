// SPDX-License-Identifier: GPL-3.0-or-later
// The plug-in's mix, from trims to equalisers, in a bounce, live, and while it plays.
#include "Io/Disk/ReadFile.h"
#include "Live/Session/OfflineRender.h"
#include "PluginTesting.h"
#include "Scene/ActuatorFile.h"
#include "Scene/World/Simulation.h"
#include "TestPlaces.h"

namespace physvib::mix_test {

using namespace test;

/// A new instance with something of everything.
PluginState mixedState() {
    PluginState s = shakenBox();
    // C and D are struck first
    s.strips = {{.isMuted = true},
                {.gainDb = 6.0, .ceilingDb = -12.0},
                {.gainDb = -3.0, .isInverted = true, .delayMs = 2.5},
                {.gainDb = 6.0, .delayMs = 50.0, .ceilingDb = -30.0}};
    const auto actuator = findActuator("lra-205");
    s.equalised[2] = {actuator.value.resonator(), *actuator.value.band};
    return s;
}

/// The same by the offline renderer, as of `physvib render`, with the mix from time 0 on.
Samples renderedMix(const PluginState& s, std::int64_t frames) {
    const auto made = simulateScene(s.scene, {s.seed, s.stepsPerSecond}, frames * 1'000'000'000 / 48000 + 1);
    std::vector<RenderControl> controls;
    std::array<SentStrip, limits::maxActuators> told{};
    sendStrips(told, s.strips, [&controls](const RenderControl& c) { return controls.push_back(c), true; });
    const RendererSettings settings{.sampleRateHz = 48000,
                                    .channels = actuatorCount(s),
                                    .panner = makePanner(s, PanningLaw::linear, 1.0),
                                    .limiterEnabled = s.limiterEnabled,
                                    .equalised = s.equalised};
    Samples signal(static_cast<std::size_t>(actuatorCount(s)));
    renderOffline(made.events, {settings, frames, 256, controls},
                  [&signal](const float* const* block, int n) {
                      for (std::size_t j = 0; j < signal.size(); ++j)
                          signal[j].insert(signal[j].end(), block[j], block[j] + n);
                      return true;
                  });
    return signal;
}

float loudest(const std::vector<float>& channel) { return peakOf(Samples{channel}); }

TEST(PluginMix, ABounceIsTheRenderedMixInEveryTake) {
    TestHost host;
    auto state = mixedState();
    state.transport = TransportMode::restartOnPlay;
    ASSERT_TRUE(host.plugin->apply(state));
    host.setNormal(Parameter::level, 1.0f);
    const auto expected = renderedMix(state, 48000);
    host.prepare(48000, 512);
    host.playHead.isThere = true;
    for (int take = 0; take < 4; ++take) { // the third is the first one's session again
        host.playHead.isPlaying = true;
        EXPECT_TRUE(host.felt(48000) == expected) << take;
        host.playHead.isPlaying = false;
        host.played(24000);
    }
    EXPECT_EQ(loudest(expected[0]), 0.0f) << "muted";
    EXPECT_LE(loudest(expected[3]), std::pow(10.0f, -30.0f / 20.0f) * 1.0001f) << "its ceiling";
    EXPECT_GT(loudest(expected[2]) * loudest(expected[3]), 0.0f);
}

TEST(PluginMix, AFaderIsFeltLLaterAndTheTakeGoesOn) {
    TestHost still, moved;
    for (auto* host : {&still, &moved}) host->prepare(48000, 512);
    const int latency = still.plugin->getLatencySamples();
    constexpr std::int64_t before = 94 * 512, after = 48000;
    Samples a = still.played(before + after), b = moved.played(before);
    auto state = moved.plugin->state();
    state.strips[0].gainDb = minStripDb;
    state.strips[3].isInverted = true;
    moved.plugin->edit(state);
    moved.play(after, b);
    EXPECT_EQ(moved.plugin->runs().status().runNumber, 1) << "the world goes on";
    EXPECT_TRUE(a[1] == b[1] && a[2] == b[2]);
    const auto felt = static_cast<std::size_t>(before + latency), ramped = felt + 2 * 480 + 64;
    for (std::size_t n = 0; n < a[0].size(); ++n) {
        if (n < felt - 64) ASSERT_TRUE(a[0][n] == b[0][n] && a[3][n] == b[3][n]) << n;
        if (n > ramped) ASSERT_TRUE(b[0][n] == 0.0f && b[3][n] == -a[3][n]) << n;
    }
}

TEST(PluginMix, ASoloSilencesTheOthersAlsoInTheTakesThatFollow) {
    TestHost host{shakenBox(), 512};
    auto state = host.plugin->state();
    state.strips[1].isSolo = true;
    host.plugin->edit(state);
    for (const bool again : {false, true}) {
        if (again) host.prepare(48000, 512);
        Samples signal = host.played(96000);
        EXPECT_GT(loudest(signal[1]), 0.0f);
        for (const std::size_t j : {0u, 2u, 3u}) EXPECT_EQ(loudest(signal[j]), 0.0f) << j;
    }
}

TEST(PluginMix, TheLevelStandsOnTopOfTheTrims) {
    auto state = mixedState();
    state.limiterEnabled = false;
    TestHost host{state};
    // the least is silence
    for (const auto& [level, shift] : {std::pair{1.0f, 0.0}, {0.9f, -6.0}, {0.0f, 2.0 * minStripDb}}) {
        auto& parameter = host.plugin->parameter(Parameter::level);
        parameter.setValue(level);
        EXPECT_NEAR(std::max(parameter.value(), minStripDb), std::max(shift, minStripDb), 0.01);
        host.prepare(48000, 512);
        const auto played = host.felt(48000), expected = renderedMix(state, 48000);
        const double gain = gainFromLevelDb(parameter.value());
        for (std::size_t j = 0; j < expected.size(); ++j)
            for (std::size_t n = 0; n < expected[j].size(); ++n)
                ASSERT_NEAR(played[j][n], gain * expected[j][n], 1e-6) << j << ' ' << n;
    }
}

TEST(PluginMix, EnchantersThatComeGetTheLowestCeiling) {
    TestHost host;
    auto state = mixedState();
    state.layout = presetLayout("phone2");
    ASSERT_TRUE(host.plugin->apply(state));
    state = host.plugin->state();
    EXPECT_EQ(state.strips.size(), 2u);
    state.layout = presetLayout("phone4");
    ASSERT_TRUE(host.plugin->apply(state));
    const auto strips = host.plugin->state().strips;
    ASSERT_EQ(strips.size(), 4u);
    EXPECT_EQ(strips[3].ceilingDb, -12.0);
    EXPECT_EQ(strips[3].gainDb, 0.0);
}

TEST(PluginMix, ANewInstanceAndAChunkOfVersion1SoundAsWithoutAMix) {
    const auto text = readFile(PHYSVIB_SOURCE_DIR "/Tests/Documents/plugin-state-1.json", 1'000'000);
    ASSERT_TRUE(text) << text.error;
    TestHost host;
    restore(*host.plugin, text.value);
    ASSERT_EQ(host.plugin->errorText(), "");
    host.setNormal(Parameter::level, 1.0f);
    auto old = host.plugin->state(), fresh = shakenBox();
    old.transport = TransportMode::free;
    for (auto& state : {old, fresh}) {
        ASSERT_TRUE(host.plugin->apply(state));
        host.prepare(48000, 512);
        auto plain = state;
        plain.strips.clear();
        plain.equalised = {};
        auto played = host.felt(96000);
        played.resize(static_cast<std::size_t>(actuatorCount(state)));
        EXPECT_TRUE(played == renderedMix(plain, 96000)) << state.scene.name;
        EXPECT_GT(peakOf(played), 0.01f);
    }
}

// The processor in its hosts' hands: bounces, rates, blocks, suspension, bypass, many instances.

TEST(PluginProcessor, ABounceIsTheRenderedFileAtAnyBlockSizeTwice) {
    const std::int64_t frames = 10 * 48000;
    TestHost host;
    const auto expected = renderedMix(shakenBox(), frames);
    for (const int block : {64, 1024, 64, 8192}) {
        host.prepare(48000, block);
        EXPECT_TRUE(host.felt(frames) == expected) << block;
    }
}

TEST(PluginProcessor, HostsSeeTheParametersInTheOrderOfTheTableAndInGroups) {
    TestHost host;
    const auto& parameters = host.plugin->getParameters();
    ASSERT_EQ(parameters.size(), static_cast<int>(parameterCount));
    for (int i = 0; i < parameters.size(); ++i)
        EXPECT_EQ(parameters[i], &host.plugin->parameter(static_cast<Parameter>(i)));
    juce::StringArray groups;
    for (const auto* group : host.plugin->getParameterTree().getSubgroups(false))
        groups.add(group->getName());
    EXPECT_EQ(groups.joinIntoString(", "), "Panning, World, Strikes by notes, Side chain, Time, Instrument");
}

TEST(PluginProcessor, HostsShowAUnitOnceAndNoMinusZero) {
    TestHost host;
    int twice = 0;
    for (const auto& row : allParameters()) {
        const auto& parameter = host.plugin->parameter(row.parameter);
        const auto shown = parameter.getText(parameter.getDefaultValue(), 0);
        twice += parameter.getLabel().isNotEmpty() && shown.endsWith(parameter.getLabel());
    }
    const auto zero = valueText(rowOf(Parameter::strikeLevel), -1.43e-6);
    std::printf("hosts show: %d units twice, \"%s\"\n", twice, zero.c_str());
    EXPECT_EQ(twice, 0);
    EXPECT_EQ(zero, "0.0 dB");
}

TEST(PluginProcessor, ARateThatCannotBeRenderedIsSaidAndSilent) {
    TestHost host{shakenBox(), 512};
    for (const double rate : {384000.0, 192001.0, 4999.0, 4000.0}) {
        host.prepare(rate, 512);
        EXPECT_EQ(peakOf(host.played(static_cast<std::int64_t>(rate))), 0.0f) << rate;
        EXPECT_EQ(host.plugin->getLatencySamples(), 0) << "none of another rate is told";
        EXPECT_TRUE(host.plugin->errorText().startsWith("the host runs at " +
                                                        juce::String{static_cast<int>(rate)} +
                                                        " Hz; expected 5000 to 192000: silent"))
            << host.plugin->errorText();
    }
    for (const int rate : {5000, 8000, 48000, 192000}) {
        host.prepare(rate, 512);
        EXPECT_EQ(host.plugin->errorText(), "");
        EXPECT_GT(peakOf(host.played(2 * rate)), 0.01f) << rate;
    }
}

TEST(PluginProcessor, WithoutPrepareAndAfterReleaseThereIsSilence) {
    TestHost host;
    host.buffer.setSize(4, 64);
    host.buffer.setSample(0, 0, 1.0f);
    EXPECT_EQ(host.block(64).getMagnitude(0, 64), 0.0f);
    host.prepare(48000, 64);
    Samples signal = host.played(96000);
    EXPECT_GT(peakOf(signal), 0.01f);
    host.plugin->releaseResources();
    EXPECT_EQ(host.block(64).getMagnitude(0, 64), 0.0f);
    host.plugin->releaseResources(); // hosts do
    host.prepare(48000, 64);
    EXPECT_TRUE(host.played(96000) == signal);
    EXPECT_EQ(host.block(0).getNumSamples(), 0);
}

TEST(PluginProcessor, BypassIsSilentAndKeepsTheTime) {
    TestHost host{shakenBox(), 480};
    Samples whole, open, after;
    host.play(6 * 48000, whole);
    host.prepare(48000, 480);
    host.play(2 * 48000, open);
    const int latency = host.plugin->getLatencySamples();
    host.setNormal(Parameter::bypass, 1.0f);
    EXPECT_EQ(peakOf(later(host.played(2 * 48000), 480)), 0.0f) << "after the ramp of 10 ms";
    EXPECT_EQ(host.plugin->getLatencySamples(), latency);
    host.setNormal(Parameter::bypass, 0.0f);
    host.play(2 * 48000, after);
    EXPECT_TRUE(later(after, 480) == later(whole, 4 * 48000 + 480)) << "the world went on";
    juce::MidiBuffer none;
    host.plugin->processBlockBypassed(host.buffer, none);
    host.plugin->processBlockBypassed(host.buffer, none);
    EXPECT_EQ(host.buffer.getMagnitude(0, 480), 0.0f);
}

TEST(PluginProcessor, ASceneThatIsChangedWhileItPlaysFadesAndGoesOn) {
    TestHost host{shakenBox(), 480};
    Samples signal = host.played(48000);
    for (const int program : {1, 2, 3, 4, 0}) {
        host.plugin->setCurrentProgram(program);
        EXPECT_EQ(host.plugin->getCurrentProgram(), program);
        host.play(48000, signal);
    }
    EXPECT_LE(peakOf(signal), 1.0f);
    EXPECT_EQ(host.plugin->runs().status().runNumber, 6);
}

} // namespace physvib::mix_test
