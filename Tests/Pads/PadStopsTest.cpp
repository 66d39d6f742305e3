// SPDX-License-Identifier: MIT
// What a controller does at once, however slow its profile is.
#include "Pads/VirtualPad.h"
#include "Support/FileTesting.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace pads_testing;

class PadStopsInRealTime : public FolderTest {
protected:
    GamePads pads{}; // before any virtual one
};

/// A profile with five commands a second: a stop that waited for the next would come up to 200 ms later. The
/// quickest of some tries counts: another program may hold up any one of them.
TEST_F(PadStopsInRealTime, SilenceAndLevelZeroDoNotWaitForTheNextCommand) {
    PadProfile slow = builtInPads().front();
    slow.name = "pad-slow";
    slow.law.commandsPerSecond = 5.0;
    slow.law.leadSeconds = 0.0;
    put(folder / "slow.json", padJson(slow));
    for (const bool isLevel : {false, true}) {
        VirtualPad pad{"slow"};
        PadOutput output{"slow@" + (folder / "slow.json").string(), phone()};
        ASSERT_EQ(output.awaitReady([] { return true; }), "");
        PacedDevice device;
        device.block();
        output.follow(&device);
        device.block();
        CollisionEvent tone = hit(device.sessionNs(), 60.0, 1.0, 0.5);
        tone.decayPerSecond = 0.0;
        tone.durationNs = 60'000 * ms;
        output.made(tone);
        std::int64_t quickest = INT64_MAX;
        for (int i = 0; i < 5 && quickest > 100 * ms; ++i) {
            ASSERT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); }));
            const std::int64_t saidNs = PacedDevice::now();
            isLevel ? device.setLevel(0.0f) : device.setSilent(true);
            ASSERT_TRUE(soon([&] { return device.block(), pad.isAtRest(); }));
            quickest = std::min(quickest, pad.told().back().steadyNs - saidNs);
            isLevel ? device.setLevel(1.0f) : device.setSilent(false);
        }
        EXPECT_LT(quickest, 100 * ms) << (isLevel ? "level" : "silence");
        output.follow(nullptr);
    }
}

/// A session that begins anew is felt from its own beginning, although the one before went further.
TEST_F(PadStopsInRealTime, ASessionThatBeginsAnewIsFelt) {
    VirtualPad pad{"again"};
    PadOutput output{"again", phone()};
    ASSERT_EQ(output.awaitReady([] { return true; }), "");
    PacedDevice device;
    device.beganNs = PacedDevice::now() - 100'000 * ms; // it has played for long
    device.block();
    output.follow(&device);
    for (const bool isAnew : {false, true}) {
        if (isAnew) device.beganNs = PacedDevice::now();
        for (int i = 0; i < (isAnew ? 140 : 20); ++i) { // the clock looks back for half a second
            device.block();
            std::this_thread::sleep_for(std::chrono::milliseconds{5});
        }
        output.made(hit(device.sessionNs(), 60.0, 1.0, 0.5));
        EXPECT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); })) << (isAnew ? "anew" : "before");
        EXPECT_TRUE(soon([&] { return device.block(), pad.isAtRest(); }));
    }
    output.follow(nullptr);
}

} // namespace
} // namespace physvib
