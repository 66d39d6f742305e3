// SPDX-License-Identifier: GPL-3.0-or-later
// The processor in its hosts' hands: bounces, rates, blocks, suspension, bypass, many instances.
#include "Live/Session/OfflineRender.h"
#include "PluginTesting.h"
#include "Scene/World/Simulation.h"

namespace physvib {
namespace {

using namespace test;

/// What `physvib render` gives of the settings.
Samples rendered(const PluginState& s, int rate, std::int64_t frames) {
    const auto made = runScene(s.scene, {s.seed, s.stepsPerSecond}, frames * 1'000'000'000 / rate + 1);
    Samples signal(static_cast<std::size_t>(enchantersOf(s)));
    RendererSettings settings{rate, enchantersOf(s), pannerOf(s, PanningLaw::linear, 1.0), s.limiterEnabled};
    renderOffline(made.events, {settings, frames, 256}, [&](const float* const* block, int n) {
        for (std::size_t j = 0; j < signal.size(); ++j)
            signal[j].insert(signal[j].end(), block[j], block[j] + n);
        return true;
    });
    return signal;
}

TEST(PluginProcessor, ABounceIsTheRenderedFileAtAnyBlockSizeTwice) {
    const std::int64_t frames = 10 * 48000;
    TestHost host;
    const auto expected = rendered(host.plugin->state(), 48000, frames);
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
    TestHost host;
    host.prepare(48000, 512);
    for (const double rate : {384000.0, 192001.0, 4999.0, 4000.0}) {
        host.prepare(rate, 512);
        EXPECT_EQ(peakOf(host.played(static_cast<std::int64_t>(rate))), 0.0f) << rate;
        EXPECT_EQ(host.plugin->getLatencySamples(), 0) << "none of another rate is told";
        EXPECT_TRUE(host.plugin->trouble().startsWith("the host runs at " +
                                                      juce::String{static_cast<int>(rate)} +
                                                      " Hz; expected 5000 to 192000: silent"))
            << host.plugin->trouble();
    }
    for (const int rate : {5000, 8000, 48000, 192000}) {
        host.prepare(rate, 512);
        EXPECT_EQ(host.plugin->trouble(), "");
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
    TestHost host;
    host.prepare(48000, 480);
    Samples whole, open, after;
    host.play(6 * 48000, whole);
    host.prepare(48000, 480);
    host.play(2 * 48000, open);
    const int latency = host.plugin->getLatencySamples();
    host.plugin->parameter(Parameter::bypass).setValue(1.0f);
    EXPECT_EQ(peakOf(later(host.played(2 * 48000), 480)), 0.0f) << "after the ramp of 10 ms";
    EXPECT_EQ(host.plugin->getLatencySamples(), latency);
    host.plugin->parameter(Parameter::bypass).setValue(0.0f);
    host.play(2 * 48000, after);
    EXPECT_TRUE(later(after, 480) == later(whole, 4 * 48000 + 480)) << "the world went on";
    juce::MidiBuffer none;
    host.plugin->processBlockBypassed(host.buffer, none);
    host.plugin->processBlockBypassed(host.buffer, none);
    EXPECT_EQ(host.buffer.getMagnitude(0, 480), 0.0f);
}

TEST(PluginProcessor, TheDefaultLevelIsTwelveDecibelsDown) {
    TestHost host;
    host.plugin->parameter(Parameter::level)
        .setValue(host.plugin->parameter(Parameter::level).getDefaultValue());
    host.prepare(48000, 480);
    Samples signal = host.played(10 * 48000);
    EXPECT_LT(peakOf(signal), 0.26f);
    EXPECT_GT(peakOf(signal), 0.01f);
}

TEST(PluginProcessor, ASceneThatIsChangedWhileItPlaysFadesAndGoesOn) {
    TestHost host;
    host.prepare(48000, 480);
    Samples signal = host.played(48000);
    for (const int program : {1, 2, 3, 4, 0}) {
        host.plugin->setCurrentProgram(program);
        EXPECT_EQ(host.plugin->getCurrentProgram(), program);
        host.play(48000, signal);
    }
    EXPECT_LE(peakOf(signal), 1.0f);
    EXPECT_EQ(host.plugin->takes().status().take, 6);
}

} // namespace
} // namespace physvib
