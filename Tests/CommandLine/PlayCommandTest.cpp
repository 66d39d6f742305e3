// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib play` where there is no device: what it refuses before hands could feel it.
#include "Calls.h"

namespace physvib {
namespace {

using PlayCommand = test::CommandLine;

TEST_F(PlayCommand, ADeviceThatIsNotThereIsAFailureAndNothingElseIsPlayedOn) {
    refuses("play drop --device Nowhere --record a.wav", 1,
            "Nowhere: no such device (see physvib devices); nothing else is played on");
}

TEST_F(PlayCommand, WithoutADeviceItSaysWhatThereIsAndWhatToType) {
    const auto left = call("play drop"), listed = call("devices");
    EXPECT_EQ(left.exitCode, 2);
    EXPECT_EQ(left.err, "physvib: play: expected --device, --board or --pad\n");
    const auto begin = left.out.find("physvib play drop --device \"");
    ASSERT_NE(begin, std::string::npos) << left.out;
    EXPECT_EQ(listed.out.rfind(left.out.substr(0, left.out.rfind('\n', begin) + 1), 0), 0u)
        << "the devices as `devices` lists them: " << left.out;
    const std::string typed = left.out.substr(begin + 8, left.out.find('\n', begin) - begin - 8);
    // it is a call, whether or not the device can be opened
    EXPECT_NE(call(typed + " --seconds 0.1").exitCode, 2) << typed;
}

TEST_F(PlayCommand, ThereHasToBeSomethingToPlayOn) {
    refuses("play drop --device Nowhere --board /dev/nowhere", 1, "/dev/nowhere: no such serial port");
    std::string five = R"({"name": "five", "extent_m": [1, 1], "enchanters": [)";
    for (int j = 0; j < 5; ++j)
        five += std::string{j > 0 ? ", " : ""} + R"({"label": ")" +
                std::string(1, static_cast<char>('A' + j)) + R"(", "x_m": 0.)" + std::to_string(j) +
                R"(, "y_m": 0})";
    write("five.json", five + "]}");
    refuses("play drop --device Nowhere --board /dev/nowhere --layout five.json", 2,
            "--board: the board has four channels, this layout 5", 1);
}

TEST_F(PlayCommand, CeilingsAreOneForAllOrOneForEach) {
    const std::string found =
        "--ceiling: expected one number of dB from -60 to 0, or one per actuator (4), found ";
    for (const char* ceilings :
         {"3", "-61", "-6,-6,-6", "-6,-6,-6,-6,-6", "-6,,-6,-6", "-6dB", "-6,-6,-6,", "nan", "-inf"})
        refuses(std::string{"play drop --device Nowhere --ceiling="} + ceilings, 2,
                found + "\"" + ceilings + "\"");
    for (const char* ceilings : {"-6", "-6,-12,0,-60", "-0.5"})
        refuses(std::string{"play drop --device Nowhere --ceiling "} + ceilings, 1, "no such device");
}

// The number of ceilings tells the layout before any device is opened.
TEST_F(PlayCommand, ANamedPicoBringsItsLayoutUnlessOneIsGiven) {
    const auto play = [&](const char* device, const char* layout, const char* actuators) {
        refuses("play drop --device '" + std::string{device} + "'" + layout + " --ceiling=-1,-2,-3", 2,
                std::string{"one per actuator ("} + actuators + ")");
    };
    play("ALSA:PhysVib pico8, USB Audio; Direct hardware device", "", "8");
    play("PhysVib pico4", "", "4");
    play("PhysVib pico8", " --layout phone2", "2");
    play("speakers", "", "4");
}

TEST_F(PlayCommand, AMapNamesEachOutputOnce) {
    for (const char* map : {"0,1", "1,2,", "1:2", "a"})
        refuses(std::string{"play drop --device Nowhere --map "} + map, 2,
                "--map: expected outputs like 1,2,3,4");
    refuses("play drop --device Nowhere --map 1,2,2", 1,
            "output 2 is given to two actuators; expected one each");
}

} // namespace
} // namespace physvib
