// SPDX-License-Identifier: MIT
// Creates the events and panners of pattern and phantom stimuli, and layouts whose actuators are independent.
#include "Stimuli/Stimulus.h"
#include "Core/PortableMath.h"
#include <numbers>

namespace physvib {
namespace {

std::int64_t nanoseconds(double seconds) noexcept { return std::llround(seconds * 1e9); }

CollisionEvent burstEvent(double fromSeconds, double seconds, const ActuatorPlace& point,
                          const Carrier& carrier) noexcept {
    return {.timeNs = nanoseconds(fromSeconds),
            .frequencyHz = carrier.frequencyHz,
            .amplitude = carrier.levelG,
            .x = point.xMetres,
            .y = point.yMetres,
            .durationNs = nanoseconds(seconds),
            .source = {}};
}

PhantomPanner makePanner(const ActuatorLayout& layout, PanningLaw law, double exponent) noexcept {
    return {layout, law, exponent, layout.extentWidthMetres, layout.extentHeightMetres};
}

} // namespace

ActuatorLayout separatedLayout(int count) noexcept {
    ActuatorLayout layout;
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

Stimulus patternStimulus(const PulsePattern& pattern, int actuatorCount, const Carrier& carrier,
                         double gapSeconds) {
    const ActuatorLayout layout = separatedLayout(actuatorCount);
    Stimulus stimulus{{}, makePanner(layout, PanningLaw::linear, 1.0), 0.0};
    for (int k = 0; k < pattern.count; ++k) {
        const auto& place =
            layout.places[static_cast<std::size_t>(pattern.actuators[static_cast<std::size_t>(k)])];
        stimulus.events.push_back(
            burstEvent(k * (pattern.pulseSeconds + gapSeconds), pattern.pulseSeconds, place, carrier));
    }
    stimulus.seconds = pattern.count * pattern.pulseSeconds + (pattern.count - 1) * gapSeconds;
    return stimulus;
}

Stimulus phantomStimulus(const FieldPlace& place, const ActuatorLayout& layout, PanningLaw law,
                         double exponent, const Carrier& carrier, double seconds) {
    const ActuatorPlace point{place.x * layout.extentWidthMetres,
                              (1.0 - place.y) * layout.extentHeightMetres};
    return {{burstEvent(0.0, seconds, point, carrier)}, makePanner(layout, law, exponent), seconds};
}

} // namespace physvib
