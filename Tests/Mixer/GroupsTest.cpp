// SPDX-License-Identifier: GPL-3.0-or-later
// Groups at the desk and in its window: what they do to strips, how they are named, shown and taken back.
#include "Live/Documents/Mix.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;
using Kind = RenderControl::Kind;

float lastGain(Desk& desk, int channel) {
    float gain = 1.0f;
    for (const auto& c : desk.saved().log.channels)
        if (c.kind == Kind::gain && c.channel == channel) gain = c.value;
    return gain;
}

void group(Desk& desk) {
    desk.change("Group",
                [](Mix& mix) { mix.strips[0].group = mix.strips[1].group = addGroup(mix, "Left hand"); });
}

TEST(Groups, AFaderAndAMuteOfAGroupReachTheSessionAndAreTakenBack) {
    Desk desk{onlyNoDevice(), noDevice};
    group(desk);
    desk.change("Gain", [](Mix& mix) { mix.groups[0].gainDb = -20.0; });
    EXPECT_FLOAT_EQ(lastGain(desk, 0), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(desk, 1), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(desk, 2), 1.0f);
    desk.change("Mute", [](Mix& mix) { mix.groups[0].isMuted = true; });
    std::vector<int> muted;
    for (const auto& c : desk.saved().log.channels)
        if (c.kind == Kind::mute && c.value != 0.0f) muted.push_back(c.channel);
    EXPECT_EQ(muted, (std::vector<int>{0, 1}));
    desk.undoManager().undo();
    desk.undoManager().undo();
    EXPECT_FLOAT_EQ(lastGain(desk, 0), 1.0f);
    const auto again = readSession(sessionJson(desk.saved()), "s.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_EQ(mixOf(again.value).groups, desk.mix().groups);
    desk.detach(0);
    EXPECT_EQ(desk.mix().strips[0].group, 0) << "a strip takes its group along";
}

TEST(Groups, AreMadeRenamedMutedAndTakenApartInTheWindow) {
    Desk desk{onlyNoDevice(), noDevice};
    MixerView view{desk};
    group(desk);
    desk.dispatchPendingMessages();
    auto* mute = dynamic_cast<juce::Button*>(find(view, "Mute the group Left hand"));
    ASSERT_NE(mute, nullptr);
    mute->triggerClick();
    ASSERT_TRUE(runUntil([&] { return desk.mix().groups[0].isMuted; }));
    auto* name = dynamic_cast<juce::Label*>(find(view, "Name of Left hand"));
    ASSERT_NE(name, nullptr);
    name->setText("Palm", juce::sendNotificationSync);
    EXPECT_EQ(desk.mix().groups[0].name, "Palm");
    desk.dispatchPendingMessages();
    auto* ungroup = dynamic_cast<juce::Button*>(find(view, "Ungroup Palm"));
    ASSERT_NE(ungroup, nullptr) << "its controls have its new name";
    ungroup->triggerClick();
    ASSERT_TRUE(runUntil([&] { return desk.mix().groups.empty(); }));
    EXPECT_TRUE(desk.mix().strips[1].isMuted) << "felt as before";
    desk.dispatchPendingMessages();
    EXPECT_EQ(find(view, "Ungroup Palm"), nullptr);
}

TEST(Groups, AMuteIsTakenBackByTheNextClick) {
    Desk desk{onlyNoDevice(), noDevice};
    MixerView view{desk};
    group(desk);
    desk.dispatchPendingMessages();
    auto* mute = dynamic_cast<juce::Button*>(find(view, "Mute the group Left hand"));
    ASSERT_NE(mute, nullptr);
    for (const bool isMuted : {true, false}) {
        mute->triggerClick();
        ASSERT_TRUE(runUntil([&] { return desk.mix().groups[0].isMuted == isMuted; }));
    }
}

TEST(Groups, ShowTheNameAndTheGainThatTheyHave) {
    Desk desk{onlyNoDevice(), noDevice};
    MixerView view{desk};
    group(desk);
    desk.dispatchPendingMessages();
    auto* shown = find(view, "Group Left hand");
    auto* name = dynamic_cast<juce::Label*>(find(view, "Name of Left hand"));
    ASSERT_NE(name, nullptr);
    for (const auto& bad : {juce::String{"  "}, juce::String::repeatedString("x", 2000)}) {
        name->setText(bad, juce::sendNotificationSync);
        ASSERT_EQ(desk.mix().groups[0].name, "Left hand");
        EXPECT_EQ(name->getText(), "Left hand");
    }
    juce::Slider* fader = nullptr;
    for (auto* child : shown->getChildren())
        if (auto* slider = dynamic_cast<juce::Slider*>(child)) fader = slider;
    ASSERT_NE(fader, nullptr);
    fader->setValue(-12.0, juce::sendNotificationSync);
    EXPECT_EQ(desk.mix().groups[0].gainDb, -12.0);
    desk.undoManager().undo();
    desk.dispatchPendingMessages();
    EXPECT_EQ(fader->getValue(), 0.0) << "after it was undone, too";
}

} // namespace
} // namespace physvib
