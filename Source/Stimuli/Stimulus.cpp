// SPDX-License-Identifier: MIT
// Creates the events of pattern and phantom stimuli.
#include "Stimuli/Stimulus.h"
#include "Core/PortableMath.h"
#include <numbers>

namespace physvib {
namespace {

std::int64_t nanoseconds(double seconds) noexcept { return std::llround(seconds * 1e9); }

CollisionEvent burst(double fromSeconds, double seconds, const EnchanterPlace& at,
                     const Carrier& carrier) noexcept {
    return {.timeNs = nanoseconds(fromSeconds),
            .frequencyHz = carrier.frequencyHz,
            .amplitude = carrier.levelG,
            .x = at.xMetres,
            .y = at.yMetres,
            .durationNs = nanoseconds(seconds),
            .source = {}};
}

PhantomPanner pannerOver(const EnchanterLayout& layout, PanningLaw law, double exponent) noexcept {
    return {layout, law, exponent, layout.extentWidthMetres, layout.extentHeightMetres};
}

} // namespace

EnchanterLayout isolatingLayout(int count) noexcept {
    EnchanterLayout layout;
    if (count >= 1 && count <= 4) {
        constexpr std::string_view presets[] = {"phone1", "phone2", "phone3", "phone4"};
        layoutPreset(presets[count - 1], layout);
        return layout;
    }
    layout.extentWidthMetres = layout.extentHeightMetres = 1.0;
    layout.count = count;
    for (int j = 0; j < count; ++j) { // on a circle: the panner treats five and more as scattered
        const double angle = 2.0 * std::numbers::pi * j / count;
        layout.places[static_cast<std::size_t>(j)] = {0.5 + 0.5 * portable::cos(angle),
                                                      0.5 + 0.5 * portable::sin(angle)};
    }
    return layout;
}

Stimulus patternStimulus(const PulsePattern& pattern, int enchanters, const Carrier& carrier,
                         double gapSeconds) {
    const EnchanterLayout layout = isolatingLayout(enchanters);
    Stimulus stimulus{{}, pannerOver(layout, PanningLaw::linear, 1.0), 0.0};
    for (int k = 0; k < pattern.count; ++k) {
        const auto& place =
            layout.places[static_cast<std::size_t>(pattern.enchanters[static_cast<std::size_t>(k)])];
        stimulus.events.push_back(
            burst(k * (pattern.pulseSeconds + gapSeconds), pattern.pulseSeconds, place, carrier));
    }
    stimulus.seconds = pattern.count * pattern.pulseSeconds + (pattern.count - 1) * gapSeconds;
    return stimulus;
}

Stimulus phantomStimulus(const FieldPlace& place, const EnchanterLayout& layout, PanningLaw law,
                         double exponent, const Carrier& carrier, double seconds) {
    const EnchanterPlace at{place.x * layout.extentWidthMetres, (1.0 - place.y) * layout.extentHeightMetres};
    return {{burst(0.0, seconds, at, carrier)}, pannerOver(layout, law, exponent), seconds};
}

} // namespace physvib
