// SPDX-License-Identifier: GPL-3.0-or-later
// What phones send: which way things fall, and that they fall there after ten minutes as well.
#include "Host/Osc/OscReceiver.h"
#include "Support/ClosedForm.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

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
    EXPECT_NEAR(found->metresPerSecond2.x, x, 1e-6);
    EXPECT_NEAR(found->metresPerSecond2.y, y, 1e-6);
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

TEST(PhoneSensors, AxesMayComeOneByOne) {
    PhoneSensors phone;
    expectPull(pullOf(phone, "/accelerometer/X", {9.4}), -9.4, 0.0);
    expectPull(pullOf(phone, "/accelerometer/Y", {-2.0}), -9.4, 2.0);
    EXPECT_FALSE(pullOf(phone, "/accelerometer/Z", {1.0}).has_value());
}

TEST(PhoneSensors, APhoneMayBeHeldOnItsSide) {
    PhoneSensors phone{std::numbers::pi / 2};
    expectPull(pullOf(phone, "/accelerometer", {9.81, 0.0, 0.0}), 0.0, -9.81); // its right side is up
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
        ASSERT_LT(std::hypot(now.metresPerSecond2.x + x + tremble, now.metresPerSecond2.y + y),
                  PhoneSensors::leastChange);
    }
    EXPECT_LT(told, 30'000) << "what does not matter is not logged";
    now = *pullOf(phone, "/accelerometer", {0.0, 9.0, 0.0});
    EXPECT_NEAR(now.metresPerSecond2.y, -9.0, 1e-12);
}

} // namespace
} // namespace physvib
