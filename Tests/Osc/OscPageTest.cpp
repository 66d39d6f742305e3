// SPDX-License-Identifier: GPL-3.0-or-later
// Docs/osc.md has the addresses that are taken.
#include "Host/Osc/OscPort.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneFields.h"
#include "TestPlaces.h"
#include <functional>
#include <gtest/gtest.h>
#include <set>

namespace physvib {
namespace {

std::string page() {
    const auto text = readFile(PHYSVIB_SOURCE_DIR "/Docs/osc.md", 1'000'000);
    EXPECT_EQ(text.error, "");
    return text.value;
}

void expectOnThePage(const std::string& table) {
    EXPECT_NE(page().find(table), std::string::npos) << "expected in Docs/osc.md:\n\n" << table;
}

// Every message has an address (OscReceivers.EveryMessageOfTheTableHasAnAddress), and every address of the
// page is one.
TEST(OscPage, ItsAddressesAreTakenOrSent) {
    std::set<std::string, std::less<>> known{"answer", "error", "hit", "silence"};
    for (const auto& message : messageTable) known.emplace(message.name);
    known.insert(actionNames.begin(), actionNames.end());
    for (const auto& control : controlTable) known.emplace(control.name);
    const std::string text = page();
    int addresses = 0;
    for (std::size_t at = text.find(oscPrefix); at != std::string::npos;
         at = text.find(oscPrefix, at + 1), ++addresses) {
        const std::size_t begin = at + oscPrefix.size();
        const std::string name =
            text.substr(begin, text.find_first_not_of("abcdefghijklmnopqrstuvwxyz", begin) - begin);
        EXPECT_TRUE(name.empty() || known.contains(name)) << oscPrefix << name;
    }
    EXPECT_GE(addresses, 10);
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
    for (const auto& format : sensorFormats)
        table += "| `" + std::string(format.address) + "` | " + partOf(format) + " | " +
                 numberText(format.toPull) + " |\n";
    expectOnThePage(table);
}

TEST(OscPage, HasTheFigures) {
    expectOnThePage("`" + std::string(oscThisComputer) + "`");
    expectOnThePage("at most " + std::to_string(deepestBundle) + " deep");
    expectOnThePage(numberText(PhoneSensors::leastChange) + " m/s²");
    expectOnThePage("by more than " + numberText(1e-6 * static_cast<double>(OscClock::slackNs)) + " ms");
    expectOnThePage("at most " + std::to_string(OscClock::maxSlewPpm) + " ppm");
    expectOnThePage("once per cause and " + std::to_string(OscReplies::refusalEveryNs / 1'000'000) + " ms");
    expectOnThePage(std::to_string(OscReplies::freeBytes) + " bytes a second");
    expectOnThePage("at most " + std::to_string(OscReplies::maxSenders) + " senders");
}

} // namespace
} // namespace physvib
