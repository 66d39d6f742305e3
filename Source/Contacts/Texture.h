// SPDX-License-Identifier: MIT
// Surface texture for rolling and sliding: spacing and strength of the roughness elements (grains).
#pragma once
#include "Core/Units.h"
#include <string_view>

namespace physvib {

/// random: like cloth, stone or wood. regular: ridges, felt as a tone of frequency speed / spacing.
enum class GrainPattern { random, regular };

/// Grains of a surface. Passing a grain gives both bodies a small impact.
struct Texture {
    static constexpr double finestMetres = 1.0e-5;  ///< between grains
    static constexpr double coarsestMetres = 10.0;  ///< between grains
    static constexpr double mostRoughness = 1000.0; ///< of `roughness`

    double grainMetres = 0.0; ///< mean spacing; 0, or finer than finestMetres: smooth, and silent
    double roughness = 1.0;   ///< strength factor, see grainImpulse()
    GrainPattern pattern = GrainPattern::random; ///< spacing of the grains
    double rolling = 0.2;                        ///< strength of rolling relative to sliding, 0 to 1

    /// True if the texture gives impacts.
    bool isRough() const noexcept { return grainMetres >= finestMetres && roughness > 0.0; }
};

/// Impulse of one grain in N s, for a load in N and the speed in m/s at which it is passed. The pressing mass
/// (load / g) is lifted along a slope of 10 % of the roughness, so the impulse is proportional to both. Any
/// thread.
constexpr double grainImpulse(double roughness, double loadNewtons, double metresPerSecond) noexcept {
    constexpr double slope = 0.1;
    return slope * roughness * loadNewtons / standardGravity * metresPerSecond;
}

/// The error of a value, with what was expected; empty if all are valid. Any thread.
inline std::string_view faultOf(const Texture& texture) noexcept {
    if (!(texture.grainMetres >= 0.0 && texture.grainMetres <= Texture::coarsestMetres))
        return "grain: expected 0 (smooth) to 10 m";
    if (!(texture.roughness >= 0.0 && texture.roughness <= Texture::mostRoughness))
        return "roughness: expected 0 to 1000";
    if (!(texture.rolling >= 0.0 && texture.rolling <= 1.0)) return "rolling: expected 0 to 1";
    return {};
}

} // namespace physvib
