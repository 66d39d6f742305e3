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
    EXPECT_EQ(chooseIn(window.view(), "Device", "Game controller"), "Game controller: mixed");
    ASSERT_TRUE(runUntil([&] {
        return window.model().device().choice().sinks == std::vector<SinkName>{{"PAD", "mixed"}};
    }));
    ASSERT_TRUE(runUntil([&] {
        return std::abs(window.model().device().outputLatencySeconds() - before - 0.03) < 0.006;
    })) << "its lead, in the limiter's place";
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

TEST(MixerPad, OneThatIsNotPluggedInSaysSoAndDelaysNothingUntilItComes) {
    GamePads pads; // before the virtual one
    ASSERT_EQ(pads.fault(), "");
    TestFolder folder;
    MixerWindow window{onlyNoDevice(), "None:no device", {}, folder("config")};
    const auto latency = [&] { return window.model().device().outputLatencySeconds(); };
    const auto list = [&] { return dynamic_cast<juce::ComboBox*>(find(window.view(), "Device")); };
    const auto has = [&](const juce::String& words) {
        for (int k = 0; k < list()->getNumItems(); ++k)
            if (list()->getItemText(k) == words) return true;
        return false;
    };
    const double before = latency();
    window.view().tabs().choose("Output");
    chooseIn(window.view(), "Device", "Game controller: none is plugged in");
    auto& model = window.model();
    EXPECT_TRUE(model.trouble().contains("Its two motors follow all hits")) << model.trouble();
    ASSERT_EQ(model.messages().shown().act.name, "Use it once it is there");
    EXPECT_TRUE(model.device().choice().sinks.empty());
    model.messages().shown().act.run();
    ASSERT_TRUE(runUntil([&] { return window.model().device().choice().sinks.size() == 1; }));
    ASSERT_TRUE(runUntil([&] {
        return find(window.view(), "Board state")->getDescription().contains("No controller");
    })) << find(window.view(), "Board state")->getDescription();
    EXPECT_EQ(list()->getText(), "No device + Game controller");
    EXPECT_TRUE(has("Game controller: none there yet, in use"));
    EXPECT_DOUBLE_EQ(latency(), before);
    VirtualPad pad{"late"};
    ASSERT_TRUE(runUntil([&] { return latency() > before; })) << "it needs its events early";
    EXPECT_NEAR(latency(), before + 0.03, 0.006);
    ASSERT_TRUE(runUntil([&] { return has("Game controller: late, in use"); }));
    ASSERT_TRUE(runUntil([&] { return !pad.told().empty(); })) << "and plays";
    chooseIn(window.view(), "Device", "Game controller: late, in use");
    ASSERT_TRUE(runUntil([&] { return window.model().device().choice().sinks.empty(); })) << "and is left";
}

} // namespace
} // namespace physvib
