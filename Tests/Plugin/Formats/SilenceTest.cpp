// SPDX-License-Identifier: GPL-3.0-or-later
// SILENCE by every door, in every format, whatever the host does: at most one block and the ramp of 10 ms
// until nothing moves, and it stays so. In the wrappers themselves: what they do to a bypass is not ours.
#include "Plugin/Formats/Player.h"

namespace physvib::silence_test {

using namespace test;

struct Door {
    const char* name;
    void (*shut)(Player&, bool isShut); ///< or opens it
};
const std::vector<Door> doors{
    {"automation", [](Player& p, bool isShut) { p.bypass().setValue(isShut ? 1.0f : 0.0f); }},
    {"the host's bypass",
     [](Player& p, bool isShut) {
         (p.kind == Kind::processor ? p.bypass() : p.hostsBypass()).setValue(isShut ? 1.0f : 0.0f);
     }},
    {"a controller",
     [](Player& p, bool isShut) {
         p.next.addEvent(juce::MidiMessage::controllerEvent(1, panicController, isShut ? 127 : 0), 0);
     }},
    {"a session", [](Player& p, bool isShut) { p.load(playing(isShut)); }},
};

struct HostState {
    const char* name;
    bool isOffline, rolls;
};
constexpr HostState hostStates[]{{"bounces", true, true}, {"plays", false, true}, {"stands", true, false}};

constexpr const char* kindNames[]{"processor", "VST3", "LV2"};

TEST(Silence, ByEveryDoorInEveryFormatAndHostState) {
    for (const auto kind : {Kind::processor, Kind::vst3, Kind::lv2})
        for (const auto& host : hostStates)
            for (const auto& door : doors) {
                SCOPED_TRACE(std::string{kindNames[static_cast<int>(kind)]} + ", the host " + host.name +
                             ", " + door.name);
                Player player{kind};
                player.load(playing());
                player.prepare(host.isOffline);
                player.playHead.isPlaying = host.rolls;
                EXPECT_TRUE(player.isFelt());
                door.shut(player, true);
                EXPECT_EQ(player.peakOf(8, block + ramp), 0.0f);
                door.shut(player, false);
                EXPECT_TRUE(player.isFelt()) << "it comes back";
            }
}

// In LV2 these are two ports; in the others one parameter.
TEST(Silence, OfTheHostAndOursAreOneAndTheLastChangeCounts) {
    for (const auto kind : {Kind::vst3, Kind::lv2}) {
        Player player{kind};
        player.load(playing());
        player.prepare(true);
        EXPECT_TRUE(player.isFelt());
        player.hostsBypass().setValue(1.0f);
        EXPECT_EQ(player.peakOf(40, 10 * block), 0.0f);
        player.hostsBypass().setValue(0.0f);
        EXPECT_TRUE(player.isFelt());
        player.bypass().setValue(1.0f);
        EXPECT_EQ(player.peakOf(40, 10 * block), 0.0f)
            << "and the host's switch, which stands as it stood, changes nothing";
        player.bypass().setValue(0.0f);
        EXPECT_TRUE(player.isFelt());
    }
}

} // namespace physvib::silence_test
