// SPDX-License-Identifier: MIT
// Textures of the Penn Haptic Texture Toolkit (Culbertson, Lopez Delgado, Kuchenbecker 2014): autoregressive
// models over speed and force.
//
// A file is XML: modelSet holds SampleRate, numMACoeff and a model for each speed and force at which
// something was drawn over the material: speedMod (mm/s), forceMod (N), var (of the noise) and ARcoeff, a
// list of values of which the first is 1. Line spectral frequencies, triangles and pictures are passed over.
// Models with a moving average, which the toolkit makes for other rates, are refused: take those at 10 kHz.
// None of these files comes with PhysVib: their licence forbids it.
#pragma once
#include "Io/Result.h"
#include <filesystem>
#include <string_view>
#include <vector>

namespace physvib {

struct TextureModel {
    double metresPerSecond = 0.0, newtons = 0.0; ///< at which it was recorded
    double variance = 0.0;                       ///< of the noise, (m/s^2)^2
    std::vector<double> coefficients;            ///< a[1], a[2]... of y[n] = noise[n] - sum a[k] y[n - k]
};

struct TextureModels {
    double sampleRateHz = 0.0;
    std::vector<TextureModel> models; ///< one at least

    /// Whose speed and force are nearest, as shares of the fastest and the strongest. Any thread.
    const TextureModel& nearest(double metresPerSecond, double newtons) const;
};

/// By the file's ending: .xml, in any case. Any thread.
bool isTextureModels(std::string_view path) noexcept;

/// All of the text is checked; or one line. Any thread.
Result<TextureModels> readTextureModels(std::string_view text, std::string_view name);

/// The same of a file. M only.
Result<TextureModels> loadTextureModels(const std::filesystem::path& path);

} // namespace physvib
