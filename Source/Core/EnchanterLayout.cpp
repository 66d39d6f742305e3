// SPDX-License-Identifier: MIT
// Preset actuator layouts: PHONE and RING with 1 to 4 actuators, and a pinball cabinet; those on a body
// (Core/EnchanterLayout.h); and the checks of any layout.
#include "Core/EnchanterLayout.h"
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace physvib {
namespace {

struct Preset {
    std::string_view name;
    ActuatorPlace extent;
    std::span<const ActuatorPlace> shares; // place of each actuator, as a share of the extent
};

constexpr std::array<ActuatorPlace, 1> centre{{{0.5, 0.5}}};
constexpr std::array<ActuatorPlace, 2> sides{{{0.0, 0.5}, {1.0, 0.5}}};
constexpr std::array<ActuatorPlace, 3> triangle{{{0.0, 1.0}, {1.0, 1.0}, {0.5, 0.0}}};
constexpr std::array<ActuatorPlace, 4> corners{{{0.0, 1.0}, {1.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}};

constexpr std::array<ActuatorPlace, 8> grid{{{0.0, 1.0},
                                             {1 / 3.0, 1.0},
                                             {2 / 3.0, 1.0},
                                             {1.0, 1.0},
                                             {0.0, 0.0},
                                             {1 / 3.0, 0.0},
                                             {2 / 3.0, 0.0},
                                             {1.0, 0.0}}};

constexpr std::array nearFirst{corners[2], corners[3], corners[0], corners[1]};

// The thesis gives no coordinates. Assumed: actuators on the back of a phone of about 138 x 69 mm, and on
// fingers of two hands that hold a phone in landscape grip.
// The inside of a virtual pinball cabinet of common size is assumed too; its first two are near the player.
// So is the pad under both hands for a Pico, whose actuators can be attached anywhere.
constexpr ActuatorPlace phone{0.12, 0.06}, ring{0.16, 0.08}, cabinet{0.56, 1.1}, pad{0.24, 0.08};
constexpr std::array presets{
    Preset{"phone1", phone, centre},  Preset{"phone2", phone, sides}, Preset{"phone3", phone, triangle},
    Preset{"phone4", phone, corners}, Preset{"ring1", ring, centre},  Preset{"ring2", ring, sides},
    Preset{"ring3", ring, triangle},  Preset{"ring4", ring, corners}, Preset{"cabinet4", cabinet, nearFirst},
    Preset{"pico4", pad, corners},    Preset{"pico8", pad, grid}};
constexpr auto presetNames = [] {
    std::array<std::string_view, presets.size() + bodyLayouts.size()> names{};
    auto next = names.begin();
    for (const Preset& preset : presets) *next++ = preset.name;
    for (const BodyLayout& layout : bodyLayouts) *next++ = layout.name;
    return names;
}();

ActuatorLayout layoutOf(const Preset& preset) noexcept {
    const ActuatorPlace extent = preset.extent;
    ActuatorLayout layout{extent.xMetres, extent.yMetres, static_cast<int>(preset.shares.size()), {}};
    for (std::size_t j = 0; j < preset.shares.size(); ++j)
        layout.places[j] = {preset.shares[j].xMetres * extent.xMetres,
                            preset.shares[j].yMetres * extent.yMetres};
    return layout;
}

bool isPositive(double metres) noexcept { return std::isfinite(metres) && metres > 0.0; }

} // namespace

constinit const std::span<const std::string_view> layoutPresetNames{presetNames};

bool isValid(const ActuatorLayout& layout) noexcept {
    if (layout.count < 1 || layout.count > limits::maxActuators) return false;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j)
        if (!std::isfinite(layout.places[j].xMetres) || !std::isfinite(layout.places[j].yMetres) ||
            !std::isfinite(layout.places[j].zMetres) || layout.places[j].part < 0)
            return false;
    return isPositive(layout.extentWidthMetres) && isPositive(layout.extentHeightMetres);
}

bool isFlat(const ActuatorLayout& layout) noexcept {
    for (std::size_t j = 1; j < static_cast<std::size_t>(layout.count); ++j)
        if (layout.places[j].zMetres != layout.places[0].zMetres) return false;
    return true;
}

bool hasParts(const ActuatorLayout& layout) noexcept {
    return std::any_of(layout.places.begin(), layout.places.begin() + layout.count,
                       [](const ActuatorPlace& place) { return place.part != 0; });
}

bool layoutPreset(std::string_view name, ActuatorLayout& layout) noexcept {
    for (const Preset& preset : presets)
        if (preset.name == name) {
            layout = layoutOf(preset);
            return true;
        }
    for (const BodyLayout& body : bodyLayouts)
        if (body.name == name) {
            layout = {body.widthMetres, body.heightMetres, static_cast<int>(body.places.size()), {}};
            std::ranges::copy(body.places, layout.places.begin());
            return true;
        }
    return false;
}

} // namespace physvib
