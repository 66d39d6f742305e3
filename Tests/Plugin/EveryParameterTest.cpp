// SPDX-License-Identifier: GPL-3.0-or-later
// Every parameter that a host may move is felt, at each end of its range and in between, for itself alone.
#include "Lv2Parts.h"
#include "PluginTesting.h"
#include <map>
#include <set>

namespace physvib::everyParameter {
namespace {

using namespace test;
using Message = juce::MidiMessage;

/// Half a second of a world and two notes, with a bend; one of the parameters stands elsewhere.
Samples played(bool isHeld, Parameter moved, float position) {
    PluginState state = shakenBox();
    state.voice.isHeld = isHeld;
    if (isHeld) state.voice.pitch = NotePitch::note;
    TestHost host{state};
    if (moved != Parameter::count) host.plugin->parameter(moved).setValue(position);
    host.prepare(48000, 480);
    Samples signal(4);
    for (int block = 0; block < 70; ++block) {
        juce::MidiBuffer midi;
        if (block == 2) {
            midi.addEvent(Message::noteOn(1, 60, juce::uint8{90}), 3);
            midi.addEvent(Message::noteOn(1, 43, juce::uint8{50}), 5);
        }
        if (block == 8) midi.addEvent(Message::pitchWheel(1, 11000), 0);
        if (block == 9) midi.addEvent(Message::noteOn(1, 64, juce::uint8{70}), 0);
        if (block == 30)
            for (const int note : {60, 43, 64}) midi.addEvent(Message::noteOff(1, note), 0);
        append(signal, host.block(480, midi));
    }
    return signal;
}

TEST(EveryParameter, IsFeltForItselfAlone) {
    // what needs a side chain, or moves latency alone, has tests of its own
    const std::set<Parameter> others{Parameter::beats, Parameter::music, Parameter::musicSides,
                                     Parameter::timing};
    std::map<bool, Samples> plain;
    for (const bool isHeld : {false, true}) plain[isHeld] = played(isHeld, Parameter::count, 0.0f);
    for (const ParameterRow& row : allParameters()) {
        if (others.contains(row.parameter)) continue;
        const auto usual = static_cast<float>(normalised(row, row.initial));
        bool isFelt = false;
        for (const float position : {1.0f, 0.0f, 0.5f, 0.25f}) {
            if (std::abs(position - usual) < 0.05f) continue;
            for (const bool isHeld : {true, false})
                if (!isFelt) isFelt = played(isHeld, row.parameter, position) != plain[isHeld];
        }
        EXPECT_TRUE(isFelt) << row.id << ": its change changes nothing";
    }
}

} // namespace
TEST(Lv2Controls, WhatTheWindowSetIsWrittenToItsPortUntilTheHostHasIt) {
    TestHost host;
    Lv2Controls controls;
    std::array<float, Lv2Controls::portCount> ports{};
    ports[Lv2Controls::enabled] = 1.0f;
    for (const auto& row : allParameters()) {
        host.setToDefault(row.parameter);
        ports[static_cast<std::size_t>(row.parameter)] = static_cast<float>(row.initial);
    }
    for (std::size_t p = 0; p < ports.size(); ++p) controls.connect(p, &ports[p]);
    const auto write = [&](std::size_t p) { return controls.valueToWrite(p, *host.plugin); };
    EXPECT_FALSE(write(0)) << "before the first block";
    controls.read(*host.plugin);
    for (const auto& row : allParameters()) {
        const auto p = static_cast<std::size_t>(row.parameter);
        EXPECT_FALSE(write(p)) << row.name;
        host.setNormal(row.parameter, row.initial == row.maximum ? 0.0f : 1.0f);
        ASSERT_TRUE(write(p)) << row.name;
        EXPECT_NEAR(ports[p] = *write(p), row.initial == row.maximum ? row.minimum : row.maximum, 1e-4);
    }
    EXPECT_EQ(ports[Lv2Controls::enabled] = *write(Lv2Controls::enabled), 0.0f) << "bypassed";
    controls.read(*host.plugin);
    for (std::size_t p = 0; p < ports.size(); ++p) EXPECT_FALSE(write(p)) << p;
}

} // namespace physvib::everyParameter
