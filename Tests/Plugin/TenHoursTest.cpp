// SPDX-License-Identifier: GPL-3.0-or-later
// A host that plays notes and automation for hours, in blocks that are not realtime: what the plug-in holds
// does not grow. The ten hours are for Tests/ten-hours.sh.
#include "PluginTesting.h"
#include "Support/Growth.h"

namespace physvib {
namespace {

using namespace test;

PluginState spawningState() {
    PluginState state = shakenBox();
    NoteRule spawn;
    spawn.note = 62;
    spawn.kind = NoteKind::spawn;
    spawn.material = 1;
    state.notes = {spawn};
    return state;
}

struct Player {
    explicit Player(int rate) {
        EXPECT_TRUE(host.plugin->apply(spawningState())) << host.plugin->trouble();
        host.prepare(rate, 480);
    }
    void step(std::int64_t i) {
        host.plugin->parameter(Parameter::tilt).setValue(static_cast<float>(i % 1000) / 1000.0f);
        juce::MidiBuffer midi;
        if (i % 20 == 0)
            midi.addEvent(juce::MidiMessage::noteOn(1, 62, static_cast<juce::uint8>(1 + i % 127)),
                          static_cast<int>(i % 480));
        host.block(480, midi);
    }
    void look() {
        host.plugin->takes().drainLog();
        host.plugin->takes().poses(poses);
    }
    TestHost host;
    std::vector<BodyPose> poses;
};

void playHours(double hours, int rate, Player& one, Player& other, Growth& growth) {
    const auto blocks = static_cast<std::int64_t>(hours * 3600 * rate / 480);
    for (std::int64_t i = 0; i < blocks; ++i) {
        growth.step(
            static_cast<double>(i) * 480 / rate, [&] { one.step(i); }, [&] { other.step(i); });
        if (i % 100 == 0) one.look(), other.look();
    }
    EXPECT_LT(one.poses.size(), one.host.plugin->state().scene.bodies.size() + 64 + 8)
        << "what is there, and what has just gone";
}

TEST(PluginForHours, DISABLED_HoldsNoMoreAndGetsNoSlower) {
    Growth growth{"a plug-in with tilt in every block and notes"};
    Player one{48000}, other{48000};
    playHours(hoursWanted(), 48000, one, other, growth);
    growth.expectFlat();
}

TEST(PluginForHours, AMinuteLeavesNothingBehindThatGrows) {
    Growth growth{""};
    Player one{8000}, other{8000};
    playHours(1.0 / 60, 8000, one, other, growth);
}

} // namespace
} // namespace physvib
