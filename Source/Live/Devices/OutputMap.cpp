// SPDX-License-Identifier: MIT
// Checks the assignment of outputs, and fades an actuator over from one output to another.
#include "Live/Devices/OutputMap.h"
#include <algorithm>
#include <numeric>

namespace physvib {

namespace {

constexpr int nowhere = -1, unsaid = -2;

// Noise in a motor would be felt; a motor's signal in headphones would be far too loud.
std::string heardFault(const std::vector<int>& felt, const HeardOutputs& heard) {
    for (const Heard source : {Heard::noise, Heard::contacts}) {
        const auto& outputs = heard[static_cast<std::size_t>(source)];
        if (outputs.size() > OutputMap::mostHeard)
            return "expected at most " + std::to_string(OutputMap::mostHeard) +
                   " outputs to listen to, found " + std::to_string(outputs.size());
        for (const int output : outputs)
            if (output >= 0 && std::ranges::find(felt, output) != felt.end())
                return "output " + std::to_string(output + 1) +
                       " is an actuator's; expected another one to listen to";
    }
    return {};
}

// Marks are pulses at full scale for a measuring device, so they may share no output.
std::string marksFault(const std::vector<int>& felt, const HeardOutputs& heard) {
    const auto& marks = heard[static_cast<std::size_t>(Heard::marks)];
    const auto has = [](const std::vector<int>& outputs, int output) {
        return std::ranges::find(outputs, output) != outputs.end();
    };
    if (marks.size() > OutputMap::mostHeard)
        return "expected at most " + std::to_string(OutputMap::mostHeard) + " outputs for marks, found " +
               std::to_string(marks.size());
    for (const int output : marks) {
        const bool isFelt = output >= 0 && has(felt, output),
                   isHeard = has(heard[static_cast<std::size_t>(Heard::noise)], output) ||
                             has(heard[static_cast<std::size_t>(Heard::contacts)], output);
        if (isFelt || isHeard)
            return "output " + std::to_string(output + 1) + " is " +
                   (isFelt ? "an actuator's" : "listened to") + "; expected another one for marks";
    }
    return {};
}

} // namespace

std::string OutputMap::want(int enchanters, const std::vector<int>& wanted, int felt,
                            const HeardOutputs& heard) {
    std::vector<int> outputs(static_cast<std::size_t>(enchanters), unsaid);
    if (wanted.empty())
        std::iota(outputs.begin(), outputs.end(), 0);
    else
        std::copy_n(wanted.begin(), std::min(wanted.size(), outputs.size()), outputs.begin());
    for (const int output : outputs)
        if (output >= 0 && std::count(outputs.begin(), outputs.end(), output) > 1)
            return "output " + std::to_string(output + 1) + " is given to two actuators; expected one each";
    if (auto fault = heardFault(outputs, heard); !fault.empty()) return fault;
    if (auto fault = marksFault(outputs, heard); !fault.empty()) return fault;
    wanted_ = std::move(outputs);
    heard_ = heard;
    felt_ = felt > 0 ? std::min(felt, enchanters) : enchanters;
    return {};
}

ChannelSet OutputMap::outputs(int offered) const {
    ChannelSet set;
    for (const int output : wanted_)
        if (output >= 0 && output < offered) set.insert(output);
    for (const auto& source : heard_)
        for (const int output : source)
            if (output < offered) set.insert(output);
    return set;
}

int OutputMap::highestHeard() const noexcept {
    int highest = -1;
    for (const auto& source : heard_)
        for (const int output : source) highest = std::max(highest, output);
    return highest;
}

void OutputMap::place(const ChannelSet& active) {
    const auto packed = [&](int output) {
        const auto there = active.find(output);
        return there == active.end() ? -1 : static_cast<int>(std::distance(active.begin(), there));
    };
    for (std::size_t j = 0; j < wanted_.size(); ++j)
        at_[j].store(packed(wanted_[j]), std::memory_order_relaxed);
    for (std::size_t s = 0; s < heard_.size(); ++s)
        for (std::size_t i = 0; i < heardAt_[s].size(); ++i)
            heardAt_[s][i].store(i < heard_[s].size() ? packed(heard_[s][i]) : -1, std::memory_order_relaxed);
}

void OutputMap::settle(int sampleRateHz) noexcept {
    for (std::size_t j = 0; j < playing_.size(); ++j) {
        playing_[j] = at_[j];
        ramps_[j].prepare(sampleRateHz, limits::channelRampSeconds, playing_[j] < 0 ? 0.0f : 1.0f);
    }
}

int OutputMap::play(int enchanter, float* samples, int frames) noexcept {
    const auto j = static_cast<std::size_t>(enchanter);
    const int wanted = at(enchanter);
    if (playing_[j] < 0 && wanted >= 0 &&
        std::find(playing_.begin(), playing_.end(), wanted) == playing_.end())
        playing_[j] = wanted;
    const int here = playing_[j];
    if (here < 0) return -1;
    ramps_[j].moveTo(here == wanted ? 1.0f : 0.0f);
    ramps_[j].apply(&samples, 1, frames);
    if (here != wanted && ramps_[j].isResting()) playing_[j] = -1;
    return here;
}

int OutputMap::unfelt() const noexcept {
    int count = 0;
    for (int j = 0; j < enchanters(); ++j)
        if (wanted_[static_cast<std::size_t>(j)] != nowhere && at(j) < 0) ++count;
    return count;
}

} // namespace physvib
