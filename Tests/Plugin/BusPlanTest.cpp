// SPDX-License-Identifier: GPL-3.0-or-later
// Which layouts are taken, and that channel j is enchanter j on each.
#include "PluginTesting.h"

namespace physvib {
namespace {

using namespace test;
using Set = juce::AudioChannelSet;
constexpr auto vst3 = juce::AudioProcessor::wrapperType_VST3, lv2 = juce::AudioProcessor::wrapperType_LV2;

juce::AudioProcessor::BusesLayout outputs(std::initializer_list<Set> sets) {
    juce::AudioProcessor::BusesLayout layout;
    for (const auto& set : sets) layout.outputBuses.add(set);
    return layout;
}

TEST(BusPlan, OneBusTakesOneToSixteenChannelsInOrder) {
    for (int n = 1; n <= 16; ++n) {
        EXPECT_TRUE(isAccepted({}, vst3, outputs({channelsInOrder(n, vst3)}))) << n;
        EXPECT_TRUE(isAccepted({}, lv2, outputs({Set::discreteChannels(n)}))) << n;
    }
    EXPECT_FALSE(isAccepted({}, vst3, outputs({channelsInOrder(17, vst3)})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set{}})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::stereo(), Set::stereo()})));
}

TEST(BusPlan, Vst3RefusesWhatItWouldPermute) {
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::discreteChannels(8)})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::create7point1()})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::ambisonic(2)})));
    for (const auto& set :
         {Set::mono(), Set::stereo(), Set::quadraphonic(), Set::create5point1(), Set::create7point1SDDS()})
        EXPECT_TRUE(isAccepted({}, vst3, outputs({set}))) << set.getDescription();
}

TEST(BusPlan, ManyBusesTakeMonoStereoAndNothing) {
    const BusPlan many{BusPlan::Kind::manyBuses};
    EXPECT_TRUE(
        isAccepted(many, vst3, outputs({Set::stereo(), Set::mono(), Set::disabled(), Set::stereo()})));
    EXPECT_FALSE(isAccepted(many, vst3, outputs({Set::disabled(), Set::stereo()})));
    EXPECT_FALSE(isAccepted(many, vst3, outputs({Set::quadraphonic()})));
}

/// Channel j of the buffer that carries each enchanter; -1: none.
std::vector<int> channelsOfEnchanters(TestHost& host, int enchanters) {
    std::vector<int> found;
    host.plugin->parameter(Parameter::exponent).setValue(1.0f); // neighbours get less than half
    for (int j = 0; j < enchanters; ++j) {
        EXPECT_TRUE(host.plugin->apply(strikeAt(j, enchanters)));
        host.prepare(48000, 512);
        host.block(512, oneNote(60));
        int loudest = -1;
        float peak = 0.35f; // a strike is 0.5 where it is
        for (int done = 0; done < 24000; done += 512) {
            const auto& out = host.block(512);
            for (int c = 0; c < out.getNumChannels(); ++c)
                if (out.getMagnitude(c, 0, 512) > peak) peak = out.getMagnitude(loudest = c, 0, 512);
        }
        found.push_back(loudest);
    }
    return found;
}

TEST(BusPlan, BusesOfPairsBearTheLabelsOfTheirEnchanters) {
    const auto buses = busesOf({BusPlan::Kind::manyBuses}, vst3);
    EXPECT_EQ(buses[0].name, "A, B");
    EXPECT_EQ(buses[1].name, "C, D");
    EXPECT_EQ(buses[12].name, "Y, Z");
    for (std::size_t b = 13; b < buses.size(); ++b) EXPECT_NE(buses[b].name, buses[b - 1].name);
}

TEST(BusPlan, ChannelJIsEnchanterJOnOneBus) {
    for (const int n : {1, 2, 3, 4, 8, 16}) {
        TestHost host{{BusPlan::Kind::oneBus, n}};
        ASSERT_EQ(host.plugin->getTotalNumOutputChannels(), n);
        const auto found = channelsOfEnchanters(host, n);
        for (int j = 0; j < n; ++j) EXPECT_EQ(found[static_cast<std::size_t>(j)], j) << "of " << n;
    }
}

TEST(BusPlan, FourEnchantersOnAStereoTrackSurvive) {
    TestHost host{{BusPlan::Kind::oneBus, 2}};
    EXPECT_EQ(channelsOfEnchanters(host, 4), (std::vector<int>{0, 1, -1, -1}));
    const auto meters = host.plugin->meters();
    EXPECT_EQ(meters.enchanters, 4);
    EXPECT_EQ(meters.connected, 2);
}

TEST(BusPlan, ABusThatIsOffKeepsThePlacesOfItsEnchanters) {
    TestHost host{{BusPlan::Kind::manyBuses}};
    auto layout = host.plugin->getBusesLayout();
    layout.outputBuses.getReference(1) = Set::disabled();
    layout.outputBuses.getReference(2) = Set::stereo();
    ASSERT_TRUE(host.plugin->setBusesLayout(layout));
    EXPECT_EQ(channelsOfEnchanters(host, 6), (std::vector<int>{0, 1, -1, -1, 2, 3}));
}

TEST(BusPlan, ManyBusesCarryMoreThanSixteenEnchanters) {
    TestHost host{{BusPlan::Kind::manyBuses}};
    auto layout = host.plugin->getBusesLayout();
    for (auto& set : layout.outputBuses) set = Set::stereo();
    ASSERT_TRUE(host.plugin->setBusesLayout(layout));
    const auto found = channelsOfEnchanters(host, 20);
    for (int j = 0; j < 20; ++j) EXPECT_EQ(found[static_cast<std::size_t>(j)], j);
}

} // namespace
} // namespace physvib
