// SPDX-License-Identifier: GPL-3.0-or-later
// What phones and time tags may do at most: no pull beyond a world's limit on either axis, however the phone
// is held, and no clock that goes faster than it may.
#include "Host/Osc/OscReceiver.h"
#include "Scene/SceneLimits.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

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
                EXPECT_NEAR(pull.value->metresPerSecond2.x, std::clamp(wantedX, -most, most), 1e-6 * most);
                EXPECT_NEAR(pull.value->metresPerSecond2.y, std::clamp(wantedY, -most, most), 1e-6 * most);
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
                clock.follow({session, steady, 0}, 0);
                const std::int64_t now = clock.isReady() ? clock.sessionNs(0) : 0;
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

} // namespace
} // namespace physvib
