// SPDX-License-Identifier: GPL-3.0-or-later
// Docs/osc.md has the addresses that are taken.
#include "Files/Disk/ReadFile.h"
#include "Files/Text/NumberText.h"
#include "Host/Osc/OscPort.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

void expectOnThePage(const std::string& table) {
    const auto page = readFile(PHYSVIB_SOURCE_DIR "/Docs/osc.md", 1'000'000);
    ASSERT_EQ(page.error, "");
    EXPECT_NE(page.value.find(table), std::string::npos) << "expected in Docs/osc.md:\n\n" << table;
}

TEST(OscPage, HasTheAddressesOfTheTable) {
    std::string table = "| address | is |\n| --- | --- |\n";
    for (const auto& message : messageTable) table += "| `" + std::string(oscPrefix) + std::string(message.name) + "` | " + std::string(message.meaning) + " |\n";
    expectOnThePage(table);
}

std::string partOf(const SensorFormat& format) {
    switch (format.part) {
    case SensorFormat::Part::pull: return "x, y, z: all of it";
    case SensorFormat::Part::gravity: return "x, y, z: gravity alone";
    case SensorFormat::Part::motion: return "x, y, z: the hand's motion alone";
    case SensorFormat::Part::x: return "x";
    case SensorFormat::Part::y: return "y";
    default: return "not used";
    }
}

TEST(OscPage, HasTheSensorPrograms) {
    std::string table = "| address | numbers | times |\n| --- | --- | --- |\n";
    for (const auto& format : sensorFormats) table += "| `" + std::string(format.address) + "` | " + partOf(format) + " | " + numberText(format.toPull) + " |\n";
    expectOnThePage(table);
}

TEST(OscPage, HasTheFigures) {
    expectOnThePage("`" + std::string(oscThisComputer) + "`");
    expectOnThePage("at most " + std::to_string(deepestBundle) + " deep");
    expectOnThePage(numberText(PhoneSensors::leastChange) + " m/s²");
    expectOnThePage("by more than " + numberText(1e-6 * static_cast<double>(OscClock::slackNs)) + " ms");
    expectOnThePage("at most " + std::to_string(OscClock::mostSlewPpm) + " ppm");
    expectOnThePage("once per cause and " + std::to_string(OscReplies::refusalEveryNs / 1'000'000) + " ms");
    expectOnThePage(std::to_string(OscReplies::freeBytes) + " bytes a second");
    expectOnThePage("at most\n" + std::to_string(OscReplies::mostSenders) + " of them");
}

} // namespace
} // namespace physvib
