// SPDX-License-Identifier: GPL-3.0-or-later
// Packets: what is written is read, bundles are taken apart, and what is not OSC is nothing at all.
#include "Host/Osc/OscPacket.h"
#include "Host/Osc/OscPort.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneFields.h"
#include "TestPlaces.h"
#include <functional>
#include <gtest/gtest.h>
#include <set>

namespace physvib::osc_packet_test {

using namespace std::string_literals;

Result<std::vector<OscMessage>> read(const std::string& bytes) {
    return readOscPacket({bytes.data(), bytes.size()});
}

const std::string strike = "/physvib/strike\0,sfsN\0\0\0"s;

std::string words(const std::string& address, const std::string& name, const std::string& word) {
    const auto bytes = oscPacket(address, {"", {{name, word}}});
    return {bytes.begin(), bytes.end()};
}

std::string element(const std::string& bytes) {
    return {std::string{0, 0, 0, static_cast<char>(bytes.size())} + bytes};
}
std::string bundle(const std::string& tag, const std::string& elements) {
    return "#bundle\0"s + tag + elements;
}

TEST(OscPackets, WhatIsWrittenIsRead) {
    const PlainMessage message{"x",
                               {{"word", std::string("A")},
                                {"number", 0.25},
                                {"list", std::vector{1.0, 2.0, 0.5}},
                                {"session_s", 1234.5}}};
    const auto bytes = oscPacket("/physvib/x", message);
    EXPECT_EQ(bytes.size() % 4, 0U);
    const auto all = readOscPacket(bytes);
    ASSERT_EQ(all.error, "");
    ASSERT_EQ(all.value.size(), 1U);
    EXPECT_EQ(all.value[0].address, "/physvib/x");
    EXPECT_EQ(all.value[0].tag, oscNow);
    const auto plain = parseOscValues("x", all.value[0].values);
    EXPECT_EQ(plain.error, "");
    EXPECT_EQ(plain.value, message);
}

TEST(OscPackets, EveryNumberAndWordIsTaken) {
    const auto all = read("/n\0\0,ifhdTFsS\0\0\0"s + "\0\0\0\7"s + "\x3f\0\0\0"s + "\0\0\0\0\0\0\0\x9"s +
                          "\x3f\xe0\0\0\0\0\0\0"s + "A\0\0\0B\0\0\0"s);
    ASSERT_EQ(all.error, "");
    EXPECT_EQ(all.value[0].values, (std::vector<OscValue>{7.0, 0.5, 9.0, 0.5, 1.0, 0.0, "A"s, "B"s}));
}

TEST(OscPackets, TheInnermostTagCounts) {
    const std::string one = words("/a", "n", "w"), later = "\0\0\0\2\x80\0\0\0"s, first = "\0\0\0\1\0\0\0\0"s;
    const auto all = read(bundle(first, element(one) + element(bundle(later, element(one))) + element(one)));
    ASSERT_EQ(all.error, "");
    ASSERT_EQ(all.value.size(), 3U);
    EXPECT_EQ(all.value[0].tag, OscTag{1} << 32);
    EXPECT_EQ(all.value[1].tag, (OscTag{2} << 32) + 0x8000'0000u);
    EXPECT_EQ(all.value[2].tag, OscTag{1} << 32);
    const auto own = oscBundle("/a", {"", {}}, 0x1234'5678'9abc'def0u);
    EXPECT_EQ(readOscPacket(own).value.at(0).tag, 0x1234'5678'9abc'def0u);
}

TEST(OscPackets, WhatIsWrongIsNothing) {
    const std::string now = "\0\0\0\0\0\0\0\1"s, one = words("/a", "n", "w");
    std::string deep = element(one);
    for (int i = 0; i <= maxBundleDepth; ++i)
        deep = "\0\0"s +
               std::string{static_cast<char>(bundle(now, deep).size() >> 8),
                           static_cast<char>(bundle(now, deep).size())} +
               bundle(now, deep);
    for (const std::string& bytes :
         {""s, "abc"s, "abcd"s, "/a\0\0"s, "/a\0\0,f\0\0"s, "/a\0\0,f\0\0\0\0"s, "/a\0\0,f\0\0\x7f\xc0\0\0"s,
          "/a\0\0,f\0\0\xff\x80\0\0"s, "/a\0\0,q\0\0\0\0\0\0"s, "/a\0\0,b\0\0\0\0\0\0"s, strike, "#bundle\0"s,
          "#bundle\0\0\0\0\1"s, bundle(now, "\0\0\0\x7f"s + one), bundle(now, "\0\0\0\3abc"s),
          bundle(now, element(one) + element("/b\0\0"s)), bundle(now, "\xff\xff\xff\xfc"s + one),
          deep.substr(4)}) {
        const auto all = read(bytes);
        EXPECT_FALSE(all) << bytes;
        EXPECT_TRUE(all.value.empty());
    }
}

TEST(OscPackets, EveryCutOfAPacketIsNothing) {
    const std::string one = words("/physvib/strike", "material", "wood"),
                      all = bundle("\0\0\0\0\0\0\0\1"s, element(one) + element(one));
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (n == 16 || n == 20 + one.size()) continue; // a bundle of none, or of one
        EXPECT_FALSE(read(all.substr(0, n))) << n;
    }
}

TEST(OscPackets, ValuesHaveNames) {
    EXPECT_EQ(
        parseOscValues("path", {"places"s, 0.0, 0.5, 2.0, 0.5, "law"s, "energy"s, "seconds"s, 1.0}).value,
        (PlainMessage{"path",
                      {{"places", std::vector{0.0, 0.5, 2.0, 0.5}}, {"law", "energy"s}, {"seconds", 1.0}}}));
    EXPECT_EQ(parseOscValues("strike", {0.5}).error, "strike: expected a name before 0.5");
    EXPECT_EQ(parseOscValues("strike", {"level"s}).error, "strike: level: expected a value");
}

TEST(OscPackets, PatternsAreThoseOfTheStandard) {
    constexpr std::string_view address = "/physvib/silence";
    for (const char* pattern :
         {"/physvib/silence", "*", "/*", "/*/*", "/physvib/sil*", "/physvib/*e", "/physvib/*silence*",
          "/physvib/?ilence", "/physvib/[a-z]ilence", "/physvib/[xs]ilence", "/physvib/[!a-r]ilence",
          "/physvib/{silence}", "/physvib/{stop,silence}", "/physvib/{sil,si}ence", "/{a,phys}vib/s*n*e",
          "/physvib/silence*", "/physvib/silence{,s}"})
        EXPECT_TRUE(matchesOscPattern(pattern, address)) << pattern;
    for (const char* pattern :
         {"", "/", "/physvib/silenc", "/physvib/silences", "/physvib/?silence", "/physvib/silence?",
          "/physvib/[t-z]ilence", "/physvib/[!s]ilence", "/physvib/{stop,strike}", "/physvib/str*", "*x*",
          "/physvib/[]silence", "/physvib/sil[", "/physvib/{silence,", "/physvib/{}", "/physvib/sil{ence,}s"})
        EXPECT_FALSE(matchesOscPattern(pattern, address)) << pattern;
    EXPECT_FALSE(matchesOscPattern(std::string(60'000, '*') + "!", address)) << "and soon";
    EXPECT_TRUE(matchesOscPattern("", ""));
}

// Docs/osc.md has the addresses that are taken.

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
                 numberText(format.metresPerSecond2PerUnit) + " |\n";
    expectOnThePage(table);
}

TEST(OscPage, HasTheFigures) {
    expectOnThePage("`" + std::string(oscLoopbackAddress) + "`");
    expectOnThePage("at most " + std::to_string(maxBundleDepth) + " deep");
    expectOnThePage(numberText(PhoneSensors::minChangeMetresPerSecond2) + " m/s²");
    expectOnThePage("by more than " + numberText(1e-6 * static_cast<double>(OscClock::slackNs)) + " ms");
    expectOnThePage("at most " + std::to_string(OscClock::maxSlewPpm) + " ppm");
    expectOnThePage("once per cause and " + std::to_string(OscReplyLimiter::refusalIntervalNs / 1'000'000) +
                    " ms");
    expectOnThePage(std::to_string(OscReplyLimiter::freeBytes) + " bytes a second");
    expectOnThePage("at most " + std::to_string(OscReplyLimiter::maxSenders) + " senders");
}

} // namespace physvib::osc_packet_test
