// SPDX-License-Identifier: GPL-3.0-or-later
// Groups at the model and in its window: what they do to strips, how they are named, shown and taken back.
#include "Live/Documents/Mix.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;
using Kind = RenderControl::Kind;

float lastGain(MixerModel& model, int channel) {
    float gain = 1.0f;
    for (const auto& c : model.saved().log.channels)
        if (c.kind == Kind::gain && c.channel == channel) gain = c.value;
    return gain;
}

void group(MixerModel& model) {
    model.change("Group",
                 [](Mix& mix) { mix.strips[0].group = mix.strips[1].group = addGroup(mix, "Left hand"); });
}

TEST(Groups, AFaderAndAMuteOfAGroupReachTheSessionAndAreTakenBack) {
    MixerModel model{onlyNoDevice(), noDevice};
    group(model);
    model.change("Gain", [](Mix& mix) { mix.groups[0].gainDb = -20.0; });
    EXPECT_FLOAT_EQ(lastGain(model, 0), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(model, 1), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(model, 2), 1.0f);
    model.change("Mute", [](Mix& mix) { mix.groups[0].isMuted = true; });
    std::vector<int> muted;
    for (const auto& c : model.saved().log.channels)
        if (c.kind == Kind::mute && c.value != 0.0f) muted.push_back(c.channel);
    EXPECT_EQ(muted, (std::vector<int>{0, 1}));
    model.undoManager().undo();
    model.undoManager().undo();
    EXPECT_FLOAT_EQ(lastGain(model, 0), 1.0f);
    const auto again = readSession(sessionJson(model.saved()), "s.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_EQ(mixOf(again.value).groups, model.mix().groups);
    model.detach(0);
    EXPECT_EQ(model.mix().strips[0].group, 0) << "a strip takes its group along";
}

TEST(Groups, AreMadeRenamedMutedAndTakenApartInTheWindow) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    group(model);
    model.dispatchPendingMessages();
    auto* mute = dynamic_cast<juce::Button*>(find(view, "Mute the group Left hand"));
    ASSERT_NE(mute, nullptr);
    for (const bool isMuted : {true, false, true}) { // a mute is taken back by the next click
        mute->triggerClick();
        ASSERT_TRUE(runUntil([&] { return model.mix().groups[0].isMuted == isMuted; }));
    }
    auto* name = dynamic_cast<juce::Label*>(find(view, "Name of Left hand"));
    ASSERT_NE(name, nullptr);
    name->setText("Palm", juce::sendNotificationSync);
    EXPECT_EQ(model.mix().groups[0].name, "Palm");
    model.dispatchPendingMessages();
    auto* ungroup = dynamic_cast<juce::Button*>(find(view, "Ungroup Palm"));
    ASSERT_NE(ungroup, nullptr) << "its controls have its new name";
    ungroup->triggerClick();
    ASSERT_TRUE(runUntil([&] { return model.mix().groups.empty(); }));
    EXPECT_TRUE(model.mix().strips[1].isMuted) << "felt as before";
    model.dispatchPendingMessages();
    EXPECT_EQ(find(view, "Ungroup Palm"), nullptr);
}

TEST(Groups, ShowTheNameAndTheGainThatTheyHave) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    group(model);
    model.dispatchPendingMessages();
    auto* shown = find(view, "Group Left hand");
    auto* name = dynamic_cast<juce::Label*>(find(view, "Name of Left hand"));
    ASSERT_NE(name, nullptr);
    for (const auto& bad : {juce::String{"  "}, juce::String::repeatedString("x", 2000)}) {
        name->setText(bad, juce::sendNotificationSync);
        ASSERT_EQ(model.mix().groups[0].name, "Left hand");
        EXPECT_EQ(name->getText(), "Left hand");
    }
    juce::Slider* fader = nullptr;
    for (auto* child : shown->getChildren())
        if (auto* slider = dynamic_cast<juce::Slider*>(child)) fader = slider;
    ASSERT_NE(fader, nullptr);
    fader->setValue(-12.0, juce::sendNotificationSync);
    EXPECT_EQ(model.mix().groups[0].gainDb, -12.0);
    model.undoManager().undo();
    model.dispatchPendingMessages();
    EXPECT_EQ(fader->getValue(), 0.0) << "after it was undone, too";
}

} // namespace
} // namespace physvib
