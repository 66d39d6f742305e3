// SPDX-License-Identifier: MIT
// What a controller does at once, however slow its profile is.
#include "Live/Pads/PadOutput.h"
#include "Pads/VirtualPad.h"
#include "Support/FileTesting.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr std::int64_t ms = 1'000'000;

std::int64_t now() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

PhantomPanner phone() {
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    return {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
}

class Device final : public OutputClock {
public:
    Device() { setLevel(1.0f); }
    std::int64_t sessionNs() const { return now() - beganNs; }
    void block() { tell({sessionNs(), now(), 10 * ms, 48000}); }
    std::int64_t beganNs = now();
};

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
        Device device;
        device.block();
        output.follow(&device);
        device.block();
        CollisionEvent tone;
        tone.timeNs = device.sessionNs();
        tone.frequencyHz = 60.0;
        tone.amplitude = 1.0;
        tone.durationNs = 60'000 * ms;
        tone.x = tone.y = 0.5;
        output.made(tone);
        std::int64_t quickest = INT64_MAX;
        for (int i = 0; i < 5 && quickest > 100 * ms; ++i) {
            ASSERT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); }));
            const std::int64_t saidNs = now();
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
    Device device;
    device.beganNs = now() - 100'000 * ms; // it has played for long
    device.block();
    output.follow(&device);
    for (const bool isAnew : {false, true}) {
        if (isAnew) device.beganNs = now();
        for (int i = 0; i < (isAnew ? 140 : 20); ++i) { // the clock looks back for half a second
            device.block();
            std::this_thread::sleep_for(std::chrono::milliseconds{5});
        }
        CollisionEvent hit;
        hit.timeNs = device.sessionNs();
        hit.frequencyHz = 60.0;
        hit.decayPerSecond = 20.0;
        hit.amplitude = 1.0;
        hit.x = hit.y = 0.5;
        output.made(hit);
        EXPECT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); })) << (isAnew ? "anew" : "before");
        EXPECT_TRUE(soon([&] { return device.block(), pad.isAtRest(); }));
    }
    output.follow(nullptr);
}

} // namespace
} // namespace physvib
