// SPDX-License-Identifier: GPL-3.0-or-later
// A host that plays notes and automation for hours, in blocks that are not realtime: what the plug-in holds does not grow.
// The ten hours are for Tests/ten-hours.sh.
#include "PluginTesting.h"
#include "Support/Growth.h"

namespace physvib {
namespace {

using namespace test;

PluginState spawningState() {
    PluginState state = newPluginState();
    NoteRule spawn;
    spawn.note = 62;
    spawn.kind = NoteKind::spawn;
    spawn.material = 1;
    state.notes = {spawn};
    return state;
}

void playHours(double hours, int rate, Growth& growth) {
    TestHost host;
    ASSERT_TRUE(host.plugin->apply(spawningState())) << host.plugin->trouble();
    host.prepare(rate, 480);
    const auto blocks = static_cast<std::int64_t>(hours * 3600 * rate / 480);
    std::vector<BodyPose> poses;
    for (std::int64_t i = 0; i < blocks; ++i) {
        host.plugin->parameter(Parameter::tilt).setValue(static_cast<float>(i % 1000) / 1000.0f);
        juce::MidiBuffer midi;
        if (i % 20 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, 62, static_cast<juce::uint8>(1 + i % 127)), static_cast<int>(i % 480));
        growth.step(static_cast<double>(i) * 480 / rate, [&] { host.block(480, midi); });
        if (i % 100 == 0) {
            host.plugin->takes().takeLog();
            host.plugin->takes().poses(poses);
        }
    }
    EXPECT_LT(poses.size(), host.plugin->state().scene.bodies.size() + 64 + 8) << "what is there, and what has just gone";
    host.plugin->releaseResources();
}

TEST(PluginForHours, DISABLED_HoldsNoMoreAndGetsNoSlower) {
    Growth growth{"a plug-in with tilt in every block and notes"};
    playHours(hoursWanted(), 48000, growth);
    growth.expectFlat();
}

TEST(PluginForHours, AMinuteLeavesNothingBehindThatGrows) {
    Growth growth{""};
    playHours(1.0 / 60, 8000, growth);
}

} // namespace
} // namespace physvib
