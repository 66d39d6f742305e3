// SPDX-License-Identifier: MIT
// What a surface is like to what rolls or slides along it: two numbers, as simple as a frequency and a decay.
#pragma once
#include "Core/StandardGravity.h"
#include <string_view>

namespace physvib {

/// random: as cloth, stone or wood. regular: ridges, which are felt as a tone of speed / spacing.
enum class GrainPattern { random, regular };

/// Grains of a surface. What passes one gives a small blow to both bodies, and their cameras feel it as any
/// other.
struct Texture {
    static constexpr double finestMetres = 1.0e-5;  ///< between grains
    static constexpr double coarsestMetres = 10.0;  ///< between grains
    static constexpr double mostRoughness = 1000.0; ///< of `roughness`

    double grainMetres = 0.0; ///< mean spacing; 0, or finer than finestMetres: smooth, and silent
    double roughness = 1.0;   ///< strength, see grainImpulse()
    GrainPattern pattern = GrainPattern::random; ///< how they lie
    double rolling = 0.2; ///< share that is felt of what rolls; 1: as much as of what slides

    /// Something is felt of it.
    bool isRough() const noexcept { return grainMetres >= finestMetres && roughness > 0.0; }
};

/// N s that one grain gives, for a load in N and the speed in m/s at which it is passed: it lifts the mass
/// that presses (load / g) along a slope of 10 % of the roughness, so its blow grows with both. Any thread.
constexpr double grainImpulse(double roughness, double loadNewtons, double metresPerSecond) noexcept {
    constexpr double slope = 0.1;
    return slope * roughness * loadNewtons / standardGravity * metresPerSecond;
}

/// What is wrong with a texture, and what was expected; empty if it can be used. Any thread.
inline std::string_view faultOf(const Texture& texture) noexcept {
    if (!(texture.grainMetres >= 0.0 && texture.grainMetres <= Texture::coarsestMetres))
        return "grain: expected 0 (smooth) to 10 m";
    if (!(texture.roughness >= 0.0 && texture.roughness <= Texture::mostRoughness))
        return "roughness: expected 0 to 1000";
    if (!(texture.rolling >= 0.0 && texture.rolling <= 1.0)) return "rolling: expected 0 to 1";
    return {};
}

} // namespace physvib
