// SPDX-License-Identifier: GPL-3.0-or-later
// Heals mixer states in which two strips have one output, as files may have them.
#include "Mixer/Desk/DeskRouting.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Desk/DeskWords.h"
#include <algorithm>

namespace physvib {
namespace {

bool isWithout(const Mix& mix, std::size_t strip) {
    return strip < mix.strips.size() && mix.strips[strip].output < 0;
}

juce::String labelsOf(const Desk& desk, const std::vector<std::size_t>& strips) {
    juce::StringArray labels;
    for (const std::size_t j : strips) labels.add(utf8(desk.mix().layout.enchanters[j].label));
    return labels.joinIntoString(", ");
}

void giveFreeOutputs(Desk& desk, const std::vector<std::size_t>& strips) {
    const auto inUse = desk.device().choice().inUse();
    const int outputs = desk.device().outputs() > 0 ? desk.device().outputs() : mostStripOutputs;
    desk.change("Free outputs", [&](Mix& mix) {
        for (const std::size_t j : strips)
            if (isWithout(mix, j)) mix.strips[j].output = freeOutput(mix.strips, inUse, outputs);
    });
    if (std::ranges::any_of(strips, [&](std::size_t j) { return isWithout(desk.mix(), j); }))
        desk.report("The device has no other free output");
}

} // namespace

void takeOutputs(const std::vector<int>& played, std::span<Strip> strips) {
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].output = j < played.size() ? played[j] : -1;
}

std::vector<std::size_t> placeNew(const DeviceChoice& choice, std::span<Strip> strips, std::size_t first) {
    std::vector<std::size_t> without;
    const auto inUse = choice.inUse();
    const int outputs = choice.isHeadphones ? DeviceChoice::ears : mostStripOutputs;
    for (std::size_t j = first; j < strips.size(); ++j) {
        int& output = strips[j].output;
        if (output < 0 || (output < outputs && std::ranges::find(inUse, output) == inUse.end())) continue;
        output = freeOutput(strips, inUse, outputs);
        if (output < 0) without.push_back(j);
    }
    return without;
}

void reportNoEar(Desk& desk, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    desk.messages().add({labelsOf(desk, strips) +
                             (strips.size() == 1 ? " has no output: " : " have no output: ") +
                             "headphones have two, L and R",
                         false,
                         {},
                         "ears"});
}

std::string useHeadphones(Desk& desk, DeviceChoice choice) {
    choice.isHeadphones = true;
    choice.monitor.clear();
    if (choice.marker < DeviceChoice::ears) choice.marker = -1;
    std::vector<std::size_t> others;
    desk.change("Headphones", [&](Mix& mix) {
        for (std::size_t j = 0; j < mix.strips.size(); ++j) {
            const bool hasEar = j < DeviceChoice::ears;
            mix.strips[j].output = hasEar ? static_cast<int>(j) : -1;
            if (!hasEar) others.push_back(j);
        }
        mix.levelDb = std::min(mix.levelDb, safeContactDb);
    });
    auto error = desk.open(choice);
    reportNoEar(desk, others);
    return error;
}

void reportWithout(Desk& desk, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    const bool isOne = strips.size() == 1;
    desk.messages().add({labelsOf(desk, strips) + (isOne ? " has no output: another actuator has it"
                                                         : " have no outputs: other actuators have them"),
                         false,
                         {isOne ? "Give a free output" : "Give free outputs",
                          [&desk, strips] { giveFreeOutputs(desk, strips); }},
                         "outputs"});
}

} // namespace physvib
