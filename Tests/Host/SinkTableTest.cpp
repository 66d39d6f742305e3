// SPDX-License-Identifier: GPL-3.0-or-later
// How what is played beside a device is named.
#include "Live/Devices/SinkTable.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::string words(const OutputNames& names) {
    std::string all = names.device;
    for (const SinkName& sink : names.sinks) all += " | " + sink.kind + " " + sink.where;
    return all;
}

TEST(SinkTable, ADeviceAndAnyNumberOfSinksAreNamedInOneLine) {
    const struct {
        const char *text, *read;
    } cases[]{
        {"", ""},
        {"JACK:system", "JACK:system"},
        {"BOARD:auto", "None:no device | BOARD auto"},
        {"JACK:system+BOARD:/dev/ttyACM0", "JACK:system | BOARD /dev/ttyACM0"},
        {"ALSA:a+b+BOARD:auto", "ALSA:a+b | BOARD auto"},
        {"JACK:system+BOARD:/dev/a+b+BOARD:auto", "JACK:system | BOARD /dev/a+b | BOARD auto"},
        {"BOARD:one+BOARD:two", "None:no device | BOARD one | BOARD two"},
        {"JACK:system+BOARD:", "JACK:system"},
        {"JACK:system+PLANK:auto", "JACK:system+PLANK:auto"},
    };
    for (const auto& one : cases) EXPECT_EQ(words(OutputNames{one.text}), one.read) << one.text;
}

TEST(SinkTable, MoreEnchantersThanASinkHasAreRefused) {
    const OutputNames names{"BOARD:auto"};
    EXPECT_EQ(channelFault(names.sinks, 4), "");
    EXPECT_EQ(channelFault(names.sinks, 5), "board: expected at most four actuators");
    EXPECT_EQ(channelFault({}, 64), "");
}

TEST(SinkTable, MoreSinksThanFindRoomAreRefusedAndNoneIsOpened) {
    const std::vector<SinkName> nine(mostNamedSinks + 1, {"BOARD", "nowhere"});
    Sinks opened;
    EXPECT_EQ(openSinks(
                  nine, {}, [] { return false; }, opened),
              "expected at most 8 outputs beside the device, found 9");
    EXPECT_TRUE(opened.empty());
}

} // namespace
} // namespace physvib
