// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses channel sets whose order a plug-in format preserves, and maps actuators to the host's channels.
#include "BusPlan.h"
#include "Scene/LayoutFile.h"
#include <algorithm>

namespace physvib {

namespace {

using Processor = juce::AudioProcessor;
using Set = juce::AudioChannelSet;

// Up to this type JUCE numbers the speakers as VST3 does, so any choice of them keeps its order on the wire.
constexpr auto lastInSpeakerOrder = Set::rightSurroundSide;

bool keepsItsOrder(const Set& set) {
    return set == channelsInOrder(set.size(), Processor::wrapperType_VST3) || set == Set::mono() ||
           set.getChannelTypes().getLast() <= lastInSpeakerOrder;
}

bool isAcceptedAsOne(Processor::WrapperType format, const Set& set) {
    if (set.size() < 1 || set.size() > BusPlan::maxBusChannels) return false;
    return format != Processor::wrapperType_VST3 || keepsItsOrder(set);
}

juce::String label(int actuator) {
    return juce::String{describeLayout({}, {1.0, 1.0, actuator + 1, {}}).actuators.back().label};
}

bool isAcceptedAsOneOfMany(const Set& set) {
    return set.isDisabled() || set == Set::mono() || set == Set::stereo();
}

bool isSideChain(const juce::Array<Set>& inputs) {
    return inputs.isEmpty() || (inputs.size() == 1 && isAcceptedAsOneOfMany(inputs[0]));
}

} // namespace

juce::AudioChannelSet channelsInOrder(int channels, Processor::WrapperType format) {
    if (channels == 1) return Set::mono();
    if (channels == 2) return Set::stereo();
    if (format != Processor::wrapperType_VST3) return Set::discreteChannels(channels);
    Set set;
    for (int type = 1; type <= channels; ++type) set.addChannel(static_cast<Set::ChannelType>(type));
    return set;
}

std::vector<OutputBus> newBuses(const BusPlan& plan, Processor::WrapperType format) {
    if (plan.kind == BusPlan::Kind::oneBus)
        return {{"Actuators", channelsInOrder(plan.channels, format), true}};
    std::vector<OutputBus> buses;
    for (int b = 0; b < BusPlan::busCount; ++b)
        buses.push_back(
            {label(2 * b) + ", " + label(2 * b + 1), Set::stereo(), b < BusPlan::initialBusCount});
    return buses;
}

bool hasSideChain(const BusPlan& plan, Processor::WrapperType format) noexcept {
    return plan.hasMusicPorts || format != Processor::wrapperType_LV2;
}

bool isAccepted(const BusPlan& plan, Processor::WrapperType format, const Processor::BusesLayout& layout) {
    if (!isSideChain(layout.inputBuses)) return false;
    const auto& sets = layout.outputBuses;
    if (plan.kind == BusPlan::Kind::oneBus) return sets.size() == 1 && isAcceptedAsOne(format, sets[0]);
    return std::all_of(sets.begin(), sets.end(), isAcceptedAsOneOfMany) && !sets[0].isDisabled();
}

BusMap::BusMap(const Processor& processor)
    : BusMap{} {
    std::size_t actuator = 0;
    for (int b = 0; b < processor.getBusCount(false); ++b) {
        const auto& bus = *processor.getBus(false, b);
        const int places = bus.getLastEnabledLayout().size();
        for (int c = 0; c < places && actuator < channels.size(); ++c, ++actuator)
            channels[actuator] =
                bus.isEnabled() ? processor.getChannelIndexInProcessBlockBuffer(false, b, c) : -1;
    }
}

int BusMap::connectedCount(int actuators) const noexcept {
    return static_cast<int>(
        std::count_if(channels.begin(), channels.begin() + actuators, [](int c) { return c >= 0; }));
}

int BusMap::leadingConnected() const noexcept {
    return static_cast<int>(std::ranges::find(channels, -1) - channels.begin());
}

} // namespace physvib
