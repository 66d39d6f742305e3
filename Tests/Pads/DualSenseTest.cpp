// SPDX-License-Identifier: MIT
// The report that gives a DualSense's coils to sound, against what SDL, the Linux driver and public
// descriptions say of its bytes.
#include "Live/Pads/PadReports.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(DualSense, TheReportForSoundEmulatesNoMotorsAndChangesNothingElse) {
    constexpr auto report = dualsense::coilsToSound();
    EXPECT_EQ(report.size(), 47u) << "output report 0x02 over USB has 48 bytes with its number";
    EXPECT_EQ(report[dualsense::flagsByte] & (dualsense::emulatesMotors | dualsense::keepsSoundFromCoils), 0);
    EXPECT_EQ(report[dualsense::leftMotorByte] + report[dualsense::rightMotorByte], 0);
    for (const std::size_t flags : {0u, 1u, 38u})
        EXPECT_EQ(report[flags], 0) << "no light, trigger, volume or improved rumble is touched";
}

TEST(DualSense, ItsSoundDeviceIsKnownByItsName) {
    EXPECT_TRUE(dualsense::isDevice(
        "DualSense Wireless Controller, USB Audio; Direct hardware device without any conversions"));
    EXPECT_TRUE(dualsense::isDevice("dualsense"));
    EXPECT_TRUE(dualsense::isDevice("DualSense Edge Wireless Controller Pro"));
    EXPECT_FALSE(dualsense::isDevice("Wireless Controller"))
        << "so does a DualShock 4 call itself, which has no coils";
    EXPECT_FALSE(dualsense::isDevice("JACK:system"));
}

} // namespace
} // namespace physvib
