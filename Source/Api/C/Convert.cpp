// SPDX-License-Identifier: MIT
// Checks the structures of physvib.h, and converts them to and from the types of the engine (see Calls.h).
#include "Api/C/Calls.h"
#include <algorithm>
#include <cmath>

namespace physvib::api {

namespace {

constexpr std::string_view sizeError =
    "size: expected that of the structure, as its _init sets it, and a library that is as new as the header";

std::string_view eventError(const physvib_event& event) noexcept {
    if (!isPlayable(toCollisionEvent(event)))
        return "event: expected 0 to 20000 Hz, a decay of 0 to 2000 per second or a duration, below 5 Hz a "
               "decay of at least 1 per second, numbers, a time from 0 on";
    if (event.kind < PHYSVIB_HIT || event.kind > PHYSVIB_SLIDE)
        return "kind: expected PHYSVIB_HIT, PHYSVIB_ROLL or PHYSVIB_SLIDE";
    if (!std::isfinite(event.impulse_n_s) || !std::isfinite(event.mass_kg) || event.mass_kg < 0.0)
        return "impulse, mass: expected numbers, a mass from 0 on";
    return event.part < 0 ? "part: expected 0, or a number of physvib_part()" : std::string_view{};
}

} // namespace

std::string_view convert(const physvib_layout& callerLayout, ActuatorLayout& to) noexcept {
    const std::size_t bytes = validSize<physvib_layout>(&callerLayout);
    if (bytes == 0) return sizeError;
    auto from = zeroed<physvib_layout>();
    std::memcpy(&from, &callerLayout, bytes);
    if (from.count < 1 || from.count > limits::maxActuators) return "layout: expected 1 to 64 enchanters";
    ActuatorLayout layout;
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

int writeLayout(const ActuatorLayout& from, physvib_layout& callerLayout) noexcept {
    const std::size_t bytes = validSize<physvib_layout>(&callerLayout);
    if (bytes == 0) return argumentError(sizeError);
    auto to = zeroed<physvib_layout>();
    to.size = callerLayout.size;
    to.extent_width_m = from.extentWidthMetres;
    to.extent_height_m = from.extentHeightMetres;
    to.count = from.count;
    for (int j = 0; j < from.count; ++j) {
        to.x_m[j] = from.places[static_cast<std::size_t>(j)].xMetres;
        to.y_m[j] = from.places[static_cast<std::size_t>(j)].yMetres;
        to.z_m[j] = from.places[static_cast<std::size_t>(j)].zMetres;
        to.part[j] = from.places[static_cast<std::size_t>(j)].part;
    }
    std::memcpy(&callerLayout, &to, bytes);
    return PHYSVIB_OK;
}

std::string_view convert(const physvib_renderer_settings& from, RendererSettings& to) noexcept {
    constexpr auto isSize = [](double metres) { return metres >= 0.0 && metres <= 1.0e9; }; // not NaN
    ActuatorLayout layout;
    if (const std::string_view error = convert(from.layout, layout); !error.empty()) return error;
    if (!isSampleRate(from.rate_hz)) return "rate: expected 5000 to 192000 Hz";
    if (from.channels != 0 && (from.channels < layout.count || from.channels > limits::maxActuators))
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
    // Linear was the default law before 0.2, and panned grains by energy.
    if (from.law == PHYSVIB_LAW_LINEAR && from.exponent == 1.0) to.panner.setGrains(grainSpread);
    return {};
}

bool readRenderer(const physvib_renderer_settings* from, RendererSettings& to) noexcept {
    physvib_renderer_settings copy;
    if (!readStruct(from, copy, physvib_renderer_settings_init)) return false;
    const std::string_view error = convert(copy, to);
    return error.empty() || (argumentError(error), false);
}

std::string_view readEvent(const physvib_event& from, CollisionEvent& to) noexcept {
    const std::size_t bytes = validSize<physvib_event>(&from);
    if (bytes == 0) return sizeError;
    physvib_event filled = defaultEvent(); // members that an older program's event lacks keep their defaults
    std::memcpy(&filled, &from, bytes);
    const std::string_view error = eventError(filled);
    if (error.empty()) to = toCollisionEvent(filled);
    return error;
}

std::string_view readEvents(const physvib_event* from, std::int64_t count, std::vector<CollisionEvent>& to) {
    std::vector<CollisionEvent> events(static_cast<std::size_t>(count));
    const std::size_t bytes = count > 0 ? validSize<physvib_event>(from) : 0;
    const auto* raw = reinterpret_cast<const std::byte*>(from);
    for (CollisionEvent& event : events) {
        if (validSize<physvib_event>(raw) != bytes) return "events: expected all of one size";
        if (const auto error = readEvent(*reinterpret_cast<const physvib_event*>(raw), event); !error.empty())
            return error;
        raw += bytes;
    }
    to = std::move(events);
    return {};
}

std::string_view readSorted(const physvib_event* from, std::int64_t count, std::vector<CollisionEvent>& to) {
    std::vector<CollisionEvent> events;
    if (const auto error = readEvents(from, count, events); !error.empty()) return error;
    if (!std::ranges::is_sorted(events, {}, &CollisionEvent::timeNs))
        return "events: expected in the order of their times";
    to = std::move(events);
    return {};
}

std::int64_t writeEvents(std::span<const CollisionEvent> from, physvib_event* to,
                         std::int64_t capacity) noexcept {
    if (capacity == 0) return 0;
    const std::size_t bytes = validSize<physvib_event>(to);
    if (bytes == 0) return argumentError(sizeError);
    const auto count = std::min<std::int64_t>(capacity, std::ssize(from));
    auto* raw = reinterpret_cast<std::byte*>(to);
    for (const CollisionEvent& event : from.first(static_cast<std::size_t>(count))) {
        physvib_event filled = toPhysvibEvent(event);
        filled.size = bytes;
        std::memcpy(raw, &filled, bytes);
        raw += bytes;
    }
    return count;
}

} // namespace physvib::api
