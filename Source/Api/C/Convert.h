// SPDX-License-Identifier: MIT
// Conversions between the structures of physvib.h and the types of the engine.
#pragma once
#include "Api/C/Calls.h"
#include "Core/CollisionEvent.h"
#include "Core/HapticRenderer.h"
#include <optional>
#include <span>
#include <string_view>

namespace physvib::api {

inline CollisionEvent eventOf(const physvib_event& e) noexcept {
    const ContactKind kind = e.kind == PHYSVIB_ROLL    ? ContactKind::roll
                             : e.kind == PHYSVIB_SLIDE ? ContactKind::slide
                                                       : ContactKind::hit;
    return {e.time_ns,
            e.frequency_hz,
            e.decay_per_s,
            e.amplitude,
            e.x_m,
            e.y_m,
            e.duration_ns,
            {e.fixture, e.other, e.impulse_n_s, e.mass_kg, kind, e.part},
            {},
            Spread::layout,
            e.sound,
            e.z_m};
}
static_assert(PHYSVIB_HIT == static_cast<int>(ContactKind::hit) &&
              PHYSVIB_ROLL == static_cast<int>(ContactKind::roll) &&
              PHYSVIB_SLIDE == static_cast<int>(ContactKind::slide));

inline physvib_event eventOf(const CollisionEvent& e) noexcept {
    return {e.timeNs,
            e.durationNs,
            e.frequencyHz,
            e.decayPerSecond,
            e.amplitude,
            e.x,
            e.y,
            e.source.impulseNewtonSeconds,
            e.source.massKg,
            e.source.fixture,
            e.source.other,
            static_cast<int>(e.source.kind),
            e.sound,
            e.z,
            e.source.part,
            0};
}

inline std::optional<double> optional(double value) noexcept {
    return value == PHYSVIB_UNKNOWN ? std::nullopt : std::optional{value};
}

/// Converts and checks settings; returns empty, or what is wrong and what was expected.
std::string_view convert(const physvib_renderer_settings& from, RendererSettings& to) noexcept;
std::string_view convert(const physvib_layout& from, EnchanterLayout& to) noexcept;
physvib_layout layoutOf(const EnchanterLayout& from) noexcept;

/// Empty if all events are playable and in time order; otherwise the reason.
std::string_view faultOf(std::span<const physvib_event> events) noexcept;

} // namespace physvib::api
