// SPDX-License-Identifier: MIT
// Checks C structures and converts them to the engine's types.
#include "Api/C/Calls.h"
#include <algorithm>

namespace physvib::api {

std::string_view convert(const physvib_layout& from, EnchanterLayout& to) noexcept {
    if (from.count < 1 || from.count > limits::maxEnchanters) return "layout: expected 1 to 64 enchanters";
    EnchanterLayout layout;
    layout.extentWidthMetres = from.extent_width_m;
    layout.extentHeightMetres = from.extent_height_m;
    layout.count = from.count;
    for (int j = 0; j < from.count; ++j)
        layout.places[static_cast<std::size_t>(j)] = {from.x_m[j], from.y_m[j], from.z_m[j], from.part[j]};
    if (!isValid(layout))
        return "layout: expected an extent above 0 m, places that are numbers and parts from 0 on";
    to = layout;
    return {};
}

physvib_layout layoutOf(const EnchanterLayout& from) noexcept {
    auto to = zeroed<physvib_layout>();
    to.extent_width_m = from.extentWidthMetres;
    to.extent_height_m = from.extentHeightMetres;
    to.count = from.count;
    for (int j = 0; j < from.count; ++j) {
        to.x_m[j] = from.places[static_cast<std::size_t>(j)].xMetres;
        to.y_m[j] = from.places[static_cast<std::size_t>(j)].yMetres;
        to.z_m[j] = from.places[static_cast<std::size_t>(j)].zMetres;
        to.part[j] = from.places[static_cast<std::size_t>(j)].part;
    }
    return to;
}

std::string_view convert(const physvib_renderer_settings& from, RendererSettings& to) noexcept {
    constexpr auto isSize = [](double metres) { return metres >= 0.0 && metres <= 1.0e9; }; // not NaN
    EnchanterLayout layout;
    if (const std::string_view fault = convert(from.layout, layout); !fault.empty()) return fault;
    if (!isSampleRate(from.rate_hz)) return "rate: expected 5000 to 192000 Hz";
    if (from.channels != 0 && (from.channels < layout.count || from.channels > limits::maxEnchanters))
        return "channels: expected 0, or as many as the layout has enchanters to 64";
    if (from.law < 0 || from.law >= static_cast<int>(panningLaws.size()))
        return "law: expected one of PHYSVIB_LAW_...";
    if (!(from.exponent > 0.0 && from.exponent <= 1000.0)) return "exponent: expected more than 0, to 1000";
    if (!isSize(from.field_width_m) || !isSize(from.field_height_m)) return "field: expected 0 to 10^9 m";
    const double width = from.field_width_m > 0.0 ? from.field_width_m : layout.extentWidthMetres;
    const double height = from.field_height_m > 0.0 ? from.field_height_m : layout.extentHeightMetres;
    to.sampleRateHz = from.rate_hz;
    to.channels = from.channels;
    to.limiterEnabled = from.limiter != 0;
    to.panner = {layout, panningLaws[static_cast<std::size_t>(from.law)].law, from.exponent, width, height};
    // the default law of before 0.2: grains are panned by energy
    if (from.law == PHYSVIB_LAW_LINEAR && from.exponent == 1.0) to.panner.setGrains(grainSpread);
    return {};
}

std::string_view faultOf(std::span<const physvib_event> events) noexcept {
    const auto isOut = [](const physvib_event& e) { return !isPlayable(eventOf(e)); };
    if (std::ranges::any_of(events, isOut))
        return "event: expected 0 to 20000 Hz, a decay of 0 to 2000 per second or a duration, below 5 Hz a "
               "decay of at least 1 per second, numbers, a time from 0 on";
    if (std::ranges::any_of(
            events, [](int kind) { return kind < PHYSVIB_HIT || kind > PHYSVIB_SLIDE; },
            &physvib_event::kind))
        return "kind: expected PHYSVIB_HIT, PHYSVIB_ROLL or PHYSVIB_SLIDE";
    if (std::ranges::any_of(
            events, [](int part) { return part < 0; }, &physvib_event::part))
        return "part: expected 0, or a number of physvib_part()";
    if (!std::ranges::is_sorted(events, {}, &physvib_event::time_ns))
        return "events: expected in the order of their times";
    return {};
}

} // namespace physvib::api
