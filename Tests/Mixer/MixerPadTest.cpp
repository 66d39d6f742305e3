// SPDX-License-Identifier: GPL-3.0-or-later
// A game controller that is chosen in the mixer plays, is unplugged and plugged in again: each is seen.
#include "Mixer/MixerTesting.h"
#include "Mixer/Window/MixerWindow.h"
#include "Pads/VirtualPad.h"

namespace physvib {
namespace {

using namespace test;

TEST(MixerPad, IsChosenInTheOutputTabPlaysAndIsFollowedWhenItGoes) {
    GamePads pads; // before the virtual one
    ASSERT_EQ(pads.fault(), "");
    VirtualPad pad{"mixed"};
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    const double before = window.model().device().outputLatencySeconds();
    window.view().tabs().choose("Output");
    auto* list = dynamic_cast<juce::ComboBox*>(find(window.view(), "Game controller"));
    ASSERT_NE(list, nullptr);
    ASSERT_EQ(list->getNumItems(), 3) << "none, the first there, and this one";
    EXPECT_EQ(list->getItemText(2), "mixed");
    list->setSelectedItemIndex(2);
    ASSERT_TRUE(runUntil([&] {
        return window.model().device().choice().sinks == std::vector<SinkName>{{"PAD", "mixed"}};
    }));
    EXPECT_NEAR(window.model().device().outputLatencySeconds(), before + 0.03, 0.006)
        << "its lead, in the limiter's place";
    ASSERT_TRUE(runUntil([&] { return !pad.told().empty(); })) << "shake the box shakes it";
    window.model().setSilent(true);
    ASSERT_TRUE(runUntil([&] { return pad.isAtRest(); }));
    window.model().setSilent(false);

    pad.detach();
    ASSERT_TRUE(runUntil([&] {
        return window.model().trouble().contains("mixed is gone; it is looked for");
    })) << window.model().trouble();
    pad.attach();
    ASSERT_TRUE(runUntil([&] { return window.model().trouble().isEmpty(); })) << window.model().trouble();
}

} // namespace
} // namespace physvib
