// SPDX-License-Identifier: MIT
// Checks the assignment of outputs, and fades an actuator over from one output to another.
#include "Live/Devices/OutputMap.h"
#include <algorithm>
#include <numeric>

namespace physvib {

namespace {

constexpr int noOutput = -1, unspecified = -2;

// Noise in a motor would be felt; a motor's signal in headphones would be far too loud.
std::string listeningOutputsError(const std::vector<int>& driven, const ListeningOutputs& listening) {
    for (const ListeningSource source : {ListeningSource::noise, ListeningSource::contacts}) {
        const auto& outputs = listening[static_cast<std::size_t>(source)];
        if (outputs.size() > OutputMap::maxListeningOutputs)
            return "expected at most " + std::to_string(OutputMap::maxListeningOutputs) +
                   " outputs to listen to, found " + std::to_string(outputs.size());
        for (const int output : outputs)
            if (output >= 0 && std::ranges::find(driven, output) != driven.end())
                return "output " + std::to_string(output + 1) +
                       " is an actuator's; expected another one to listen to";
    }
    return {};
}

// Marks are pulses at full scale for a measuring device, so they may share no output.
std::string marksError(const std::vector<int>& driven, const ListeningOutputs& listening) {
    const auto& marks = listening[static_cast<std::size_t>(ListeningSource::marks)];
    const auto has = [](const std::vector<int>& outputs, int output) {
        return std::ranges::find(outputs, output) != outputs.end();
    };
    if (marks.size() > OutputMap::maxListeningOutputs)
        return "expected at most " + std::to_string(OutputMap::maxListeningOutputs) +
               " outputs for marks, found " + std::to_string(marks.size());
    for (const int output : marks) {
        const bool isActuator = output >= 0 && has(driven, output),
                   isListenedTo = has(listening[static_cast<std::size_t>(ListeningSource::noise)], output) ||
                                  has(listening[static_cast<std::size_t>(ListeningSource::contacts)], output);
        if (isActuator || isListenedTo)
            return "output " + std::to_string(output + 1) + " is " +
                   (isActuator ? "an actuator's" : "listened to") + "; expected another one for marks";
    }
    return {};
}

} // namespace

std::string OutputMap::request(int actuatorCount, const std::vector<int>& channelMap, int drivenCount,
                               const ListeningOutputs& listening) {
    std::vector<int> outputs(static_cast<std::size_t>(actuatorCount), unspecified);
    if (channelMap.empty())
        std::iota(outputs.begin(), outputs.end(), 0);
    else
        std::copy_n(channelMap.begin(), std::min(channelMap.size(), outputs.size()), outputs.begin());
    for (const int output : outputs)
        if (output >= 0 && std::count(outputs.begin(), outputs.end(), output) > 1)
            return "output " + std::to_string(output + 1) + " is given to two actuators; expected one each";
    if (auto error = listeningOutputsError(outputs, listening); !error.empty()) return error;
    if (auto error = marksError(outputs, listening); !error.empty()) return error;
    requestedOutputs_ = std::move(outputs);
    listening_ = listening;
    drivenCount_ = drivenCount > 0 ? std::min(drivenCount, actuatorCount) : actuatorCount;
    return {};
}

ChannelSet OutputMap::outputs(int deviceOutputs) const {
    ChannelSet set;
    for (const int output : requestedOutputs_)
        if (output >= 0 && output < deviceOutputs) set.insert(output);
    for (const auto& source : listening_)
        for (const int output : source)
            if (output < deviceOutputs) set.insert(output);
    return set;
}

int OutputMap::highestListeningOutput() const noexcept {
    int highest = -1;
    for (const auto& source : listening_)
        for (const int output : source) highest = std::max(highest, output);
    return highest;
}

void OutputMap::applyRequest(const ChannelSet& active) {
    const auto callbackChannel = [&](int output) {
        const auto position = active.find(output);
        return position == active.end() ? -1 : static_cast<int>(std::distance(active.begin(), position));
    };
    for (std::size_t j = 0; j < requestedOutputs_.size(); ++j)
        channels_[j].store(callbackChannel(requestedOutputs_[j]), std::memory_order_relaxed);
    for (std::size_t s = 0; s < listening_.size(); ++s)
        for (std::size_t i = 0; i < listeningChannels_[s].size(); ++i)
            listeningChannels_[s][i].store(i < listening_[s].size() ? callbackChannel(listening_[s][i]) : -1,
                                           std::memory_order_relaxed);
}

void OutputMap::finishFades(int sampleRateHz) noexcept {
    for (std::size_t j = 0; j < playingChannels_.size(); ++j) {
        playingChannels_[j] = channels_[j];
        ramps_[j].prepare(sampleRateHz, limits::channelRampSeconds, playingChannels_[j] < 0 ? 0.0f : 1.0f);
    }
}

int OutputMap::play(int actuator, float* samples, int frames) noexcept {
    const auto j = static_cast<std::size_t>(actuator);
    const int target = channelOf(actuator);
    if (playingChannels_[j] < 0 && target >= 0 &&
        std::find(playingChannels_.begin(), playingChannels_.end(), target) == playingChannels_.end())
        playingChannels_[j] = target;
    const int channel = playingChannels_[j];
    if (channel < 0) return -1;
    ramps_[j].moveTo(channel == target ? 1.0f : 0.0f);
    ramps_[j].apply(&samples, 1, frames);
    if (channel != target && ramps_[j].isResting()) playingChannels_[j] = -1;
    return channel;
}

int OutputMap::unassignedActuators() const noexcept {
    int count = 0;
    for (int j = 0; j < drivenActuators(); ++j)
        if (requestedOutputs_[static_cast<std::size_t>(j)] != noOutput && channelOf(j) < 0) ++count;
    return count;
}

} // namespace physvib
