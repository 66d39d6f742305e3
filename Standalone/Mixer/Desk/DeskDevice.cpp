// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the device, and regularly checks devices that may disappear and return.
#include "Mixer/Desk/DeskDevice.h"
#include "Mixer/Desk/DeskWords.h"
#include <utility>

namespace physvib {

namespace {

constexpr double maintainMs = 1000.0;

} // namespace

std::string DeskDevice::open(const DeviceChoice& choice) {
    AudioOutputSettings settings{
        choice.name,  outputMap(), choice.sampleRateHz, choice.blockFrames, masterGain(mix_),
        mix_.count(), true,        listening_.least()};
    const auto error = rig_.openDevice(settings);
    choice_ = choice;
    listening_.hearWanted();
    return error;
}

std::vector<int> DeskDevice::outputMap() const {
    std::vector<int> map;
    for (const Strip& strip : mix_.strips) map.push_back(strip.output);
    return map;
}

std::string DeskDevice::assign() {
    rig_.output().hear(listening_.least()); // remove monitor outputs first, because an actuator may be
                                            // assigned to one of them
    auto error = rig_.output().assign(outputMap(), mix_.count());
    listening_.hearWanted();
    return error;
}

juce::String DeskDevice::withoutClips() const {
    for (const SinkState& sink : rig_.sinkStates())
        if (!sink.playsClips) return utf8(sink.name);
    return {};
}

void DeskDevice::maintain() {
    const double now = nowMs();
    if (now - maintainedAtMs_ <= maintainMs) return;
    maintainedAtMs_ = now;
    listening_.hearWanted(); // the device may have disappeared or returned
    rig_.maintain();
}

std::vector<RigTrouble> DeskDevice::troubles() const { return rig_.troubles(); }

juce::String DeskDevice::trouble() const {
    const auto all = troubles();
    return all.empty() ? juce::String{} : utf8(all.front().words);
}

} // namespace physvib
