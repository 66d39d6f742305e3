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

void giveFreeOutputs(Desk& desk, const std::vector<std::size_t>& strips) {
    const DeviceChoice& choice = desk.device().choice();
    const int outputs = desk.device().outputs() > 0 ? desk.device().outputs() : mostStripOutputs;
    desk.change("Free outputs", [&](Mix& mix) {
        const auto isFree = [&](int output) {
            return std::ranges::find(mix.strips, output, &Strip::output) == mix.strips.end() &&
                   std::ranges::find(choice.monitor, output) == choice.monitor.end() &&
                   output != choice.marker;
        };
        for (const std::size_t j : strips)
            for (int output = 0; isWithout(mix, j) && output < outputs; ++output)
                if (isFree(output)) mix.strips[j].output = output;
    });
    if (std::ranges::any_of(strips, [&](std::size_t j) { return isWithout(desk.mix(), j); }))
        desk.report("The device has no other free output");
}

} // namespace

void takeOutputs(const std::vector<int>& played, std::span<Strip> strips) {
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].output = j < played.size() ? played[j] : -1;
}

void reportWithout(Desk& desk, const std::vector<std::size_t>& strips) {
    if (strips.empty()) return;
    juce::StringArray labels;
    for (const std::size_t j : strips) labels.add(utf8(desk.mix().layout.enchanters[j].label));
    const bool isOne = strips.size() == 1;
    desk.messages().add(
        {labels.joinIntoString(", ") + (isOne ? " has no output: another actuator has it"
                                              : " have no outputs: other actuators have them"),
         false,
         {isOne ? "Give a free output" : "Give free outputs",
          [&desk, strips] { giveFreeOutputs(desk, strips); }},
         "outputs"});
}

} // namespace physvib
