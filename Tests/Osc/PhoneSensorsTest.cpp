// SPDX-License-Identifier: GPL-3.0-or-later
// What phones send: which way things fall, and that they fall there after ten minutes as well.
#include "Host/Osc/OscReceiver.h"
#include "Scene/SceneLimits.h"
#include "Support/ClosedForm.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::phone_sensors_test {

std::optional<GravityAction> pullOf(PhoneSensors& phone, const std::string& address,
                                    std::vector<OscValue> values) {
    const auto* format = sensorFormat(address);
    if (format == nullptr) return std::nullopt;
    const auto read = phone.read(*format, {address, std::move(values), oscNow});
    EXPECT_EQ(read.error, "");
    return read.value;
}

void expectPull(const std::optional<GravityAction>& found, double x, double y) {
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->gravityMetresPerSecond2.x, x, 1e-6);
    EXPECT_NEAR(found->gravityMetresPerSecond2.y, y, 1e-6);
}

TEST(PhoneSensors, UprightPhonesOfBothKindsPullDown) {
    PhoneSensors android, iPhone, zigSim, gyrosc;
    expectPull(pullOf(android, "/accelerometer", {0.0, 9.81, 0.1}), 0.0, -9.81);
    expectPull(pullOf(iPhone, "/accxyz", {0.0, -1.0, 0.1}), 0.0, -standardGravity);
    expectPull(pullOf(zigSim, "/my-phone/gravity", {0.0, -1.0, 0.1}), 0.0, -standardGravity);
    expectPull(pullOf(gyrosc, "/gyrosc/grav", {0.0, -1.0, 0.1}), 0.0, -standardGravity);
}

// Held upright and pushed to the right: things in it are left behind.
TEST(PhoneSensors, AShakeIsFelt) {
    PhoneSensors android, iPhone;
    expectPull(pullOf(android, "/accelerometer", {3.0, 9.81, 0.0}), -3.0, -9.81);
    expectPull(pullOf(iPhone, "/gyrosc/grav", {0.0, -1.0, 0.0}), 0.0, -standardGravity);
    expectPull(pullOf(iPhone, "/gyrosc/accel", {-0.5, 0.0, 0.0}), -0.5 * standardGravity, -standardGravity);
}

// The last shake of one program is not felt for ever beside what another tells, which is all of it.
TEST(PhoneSensors, AReadingOfAllForgetsTheMotionBefore) {
    for (const auto& [address, sign] : {std::pair{"/accxyz", -1.0}, {"/accelerometer", 1.0}}) {
        PhoneSensors phone;
        pullOf(phone, "/gyrosc/grav", {0.0, -1.0, 0.0});
        expectPull(pullOf(phone, "/gyrosc/accel", {-0.5, 0.25, 0.0}), -0.5 * standardGravity,
                   -0.75 * standardGravity);
        const double unit = sign < 0.0 ? standardGravity : 1.0;
        expectPull(pullOf(phone, address, {0.0, sign, 0.0}), 0.0, -unit);
        expectPull(pullOf(phone, "/gyrosc/grav", {1.0, 0.0, 0.0}), standardGravity, 0.0);
    }
}

TEST(PhoneSensors, AxesMayComeOneByOne) {
    PhoneSensors phone;
    expectPull(pullOf(phone, "/accelerometer/X", {9.4}), -9.4, 0.0);
    expectPull(pullOf(phone, "/accelerometer/Y", {-2.0}), -9.4, 2.0);
    EXPECT_FALSE(pullOf(phone, "/accelerometer/Z", {1.0}).has_value());
}

TEST(PhoneSensors, OthersAreNoSensors) {
    for (const char* address : {"/physvib/strike", "/gravity", "/a/b/gravity", "/gyrosc/quat", "", "/"})
        EXPECT_EQ(sensorFormat(address), nullptr) << address;
    PhoneSensors phone;
    for (const auto& values : {std::vector<OscValue>{},
                               {1.0, 2.0},
                               {1.0, std::string("a"), 2.0},
                               {1.0, NAN, 2.0},
                               {INFINITY, 1.0, 1.0}})
        EXPECT_EQ(phone.read(*sensorFormat("/accelerometer"), {"/accelerometer", values, oscNow}).error,
                  "/accelerometer: expected 3 numbers");
}

// 100 readings a second, turned slowly with a trembling hand, and back again.
TEST(PhoneSensors, TenMinutesDoNotDrift) {
    PhoneSensors phone;
    test::Random random{7};
    GravityAction now{};
    int told = 0;
    for (int k = 0; k < 60'000; ++k) {
        const double angle = 1.2 * std::sin(2 * std::numbers::pi * k / 6000.0), x = 9.81 * std::sin(angle),
                     y = 9.81 * std::cos(angle);
        const double tremble = 1e-4 * (random.below(201) - 100);
        if (const auto pull = pullOf(phone, "/accelerometer", {x + tremble, y, 0.0})) now = *pull, ++told;
        ASSERT_LT(std::hypot(now.gravityMetresPerSecond2.x + x + tremble, now.gravityMetresPerSecond2.y + y),
                  PhoneSensors::minChangeMetresPerSecond2);
    }
    EXPECT_LT(told, 30'000) << "what does not matter is not logged";
    now = *pullOf(phone, "/accelerometer", {0.0, 9.0, 0.0});
    EXPECT_NEAR(now.gravityMetresPerSecond2.y, -9.0, 1e-12);
}

// What phones and time tags may do at most: no pull beyond a world's limit on either axis, however the phone
// is held, and no clock that goes faster than it may.

TEST(BoundedInputs, NoPhonePullsBeyondTheWorldsLimitOnAnyAxis) {
    constexpr double most = sceneLimits::maxAccelerationMetresPerSecond2;
    for (const double turn : {0.0, 0.5, std::numbers::pi / 2, std::numbers::pi, -2.0})
        for (const double size : {0.5, 0.999, 1.001, 10.0, 1.0e6})
            for (int k = 0; k < 8; ++k) {
                const double angle = std::numbers::pi / 4 * k, x = size * most * std::cos(angle),
                             y = size * most * std::sin(angle);
                PhoneSensors phone{turn};
                const auto pull =
                    phone.read(*sensorFormat("/accelerometer"), {"/accelerometer", {x, y, 0.0}, oscNow});
                ASSERT_TRUE(pull.value.has_value()) << pull.error;
                // a phone tells what holds it: the pull is the other way
                const double wantedX = -(std::cos(turn) * x - std::sin(turn) * y),
                             wantedY = -(std::sin(turn) * x + std::cos(turn) * y);
                EXPECT_NEAR(pull.value->gravityMetresPerSecond2.x, std::clamp(wantedX, -most, most),
                            1e-6 * most);
                EXPECT_NEAR(pull.value->gravityMetresPerSecond2.y, std::clamp(wantedY, -most, most),
                            1e-6 * most);
            }
}

/// After it has settled the clock follows a device at most as fast as it says, whatever the device does.
TEST(BoundedInputs, TheClockNeverGoesFasterThanItMay) {
    constexpr std::int64_t blockNs = 10'000'000, second = 1'000'000'000;
    for (const double ppm : {0.0, 50.0, -50.0, 150.0, -150.0, 400.0, -400.0}) {
        for (const std::int64_t stepNs :
             {std::int64_t{0}, std::int64_t{3'000'000}, std::int64_t{-3'000'000}}) {
            OscClock clock;
            std::int64_t before = 0, last = 0;
            for (std::int64_t block = 1; block * blockNs < 30 * second; ++block) {
                const std::int64_t session = block * blockNs;
                std::int64_t steady =
                    7 * second + std::llround(static_cast<double>(session) * (1.0 + 1e-6 * ppm));
                if (session > 5 * second) steady += stepNs; // as after a pause of the driver
                clock.update({session, steady, 0}, 0);
                const std::int64_t now = clock.isReady() ? clock.sessionNsFromUnix(0) : 0;
                if (session > 3 * second && before != 0) {
                    const std::int64_t most = (steady - last) * OscClock::maxSlewPpm / 1'000'000;
                    EXPECT_LE(std::abs(now - before), most + 1)
                        << ppm << " ppm, " << stepNs << " ns, at " << session;
                }
                before = now;
                last = steady;
            }
        }
    }
}

// Time tags: what they say, and that two of them lie as far apart in the session as with their sender.

constexpr std::int64_t unixAhead = 1'700'000'000'000'000'000, blockNs = 10'666'667,
                       outputLatencyNs = 50'000'000, deviceNs = 21'333'333;

/// The block that begins at session time `sessionNs`, asked for `delayNs` after `steadyNs`.
OutputMoment blockAt(std::int64_t sessionNs, std::int64_t steadyNs, std::int64_t delayNs) {
    return {sessionNs - outputLatencyNs, steadyNs + delayNs + deviceNs, outputLatencyNs + deviceNs};
}

/// Blocks for `seconds` of a device that runs `ppm` too slow, each asked for up to `mostDelayNs` late.
struct Device {
    OscClock clock;
    test::Random random{5};
    std::int64_t block = 1000;
    void play(double seconds, double ppm, int mostDelayNs) {
        for (const std::int64_t end = block + static_cast<std::int64_t>(seconds * 1e9) / blockNs; block < end;
             ++block)
            clock.update(
                blockAt(block * blockNs,
                        7'000'000'000 + std::llround(static_cast<double>(block * blockNs) * (1 + 1e-6 * ppm)),
                        random.below(mostDelayNs + 1)),
                unixAhead);
    }
};

TEST(OscClocks, TagsAreSecondsSince1900) {
    EXPECT_EQ(unixNsFromTag(OscTag{static_cast<std::uint64_t>(oscEpochSeconds)} << 32), 0);
    EXPECT_EQ(unixNsFromTag((OscTag{static_cast<std::uint64_t>(oscEpochSeconds)} << 32) + 0x8000'0000u),
              500'000'000);
    // the last is behind 2036
    for (const std::int64_t ns : {std::int64_t{0}, std::int64_t{1}, unixAhead + 123'456'789,
                                  std::int64_t{999'999'999}, std::int64_t{2'500'000'000'999'999'999}})
        EXPECT_EQ(unixNsFromTag(tagFromUnixNs(ns)), ns);
}

TEST(OscClocks, WhatIsTaggedIsMeantForThePresentAndFeltLater) {
    Device device;
    device.play(3.0, 0.0, 0);
    const std::int64_t present = 5'000'000'000, unix = unixAhead + 7'000'000'000 + present;
    EXPECT_EQ(device.clock.sessionNsFromUnix(unix), present);
    EXPECT_EQ(device.clock.unixNsFromSession(present), unix);
    EXPECT_EQ(device.clock.outputUnixNs(present), unix + outputLatencyNs + deviceNs);
}

TEST(OscClocks, TheMomentIsHeldWhileBlocksComeLate) {
    Device device;
    device.play(3.0, 0.0, 3'000'000);
    const std::int64_t before = device.clock.sessionNsFromUnix(unixAhead);
    EXPECT_LT(std::abs(before + 7'000'000'000), 400'000) << "the earliest block of a second";
    device.play(60.0, 0.0, 3'000'000);
    EXPECT_EQ(device.clock.sessionNsFromUnix(unixAhead), before) << "to the nanosecond";
}

TEST(OscClocks, ADriftingDeviceIsFollowed) {
    Device device;
    device.play(600.0, 80.0, 100'000);
    const auto now = static_cast<double>(device.block * blockNs);
    EXPECT_NEAR(static_cast<double>(device.clock.unixNsFromSession(device.block * blockNs) - unixAhead -
                                    7'000'000'000),
                now * (1 + 80e-6), 1'200'000);
}

TEST(OscClocks, AnotherDeviceIsAnotherBeginning) {
    Device device;
    device.play(3.0, 0.0, 0);
    device.clock.update(blockAt(0, 90'000'000'000, 0), unixAhead);
    EXPECT_EQ(device.clock.sessionNsFromUnix(unixAhead + 90'000'000'000), 0);
}

TEST(OscClocks, TheSystemsClockIsReadAgainTheSame) {
    EXPECT_LT(std::abs(unixMinusSteadyNs() - unixMinusSteadyNs()), 100'000'000);
}

} // namespace physvib::phone_sensors_test
