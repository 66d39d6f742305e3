// SPDX-License-Identifier: MIT
// Reader for textures of the Penn Haptic Texture Toolkit (Culbertson, Lopez Delgado, Kuchenbecker 2014):
// autoregressive models over speed and force.
//
// A file is XML: modelSet holds SampleRate, numMACoeff and a model for each recorded speed and force:
// speedMod (mm/s), forceMod (N), var (of the noise) and ARcoeff, a list of values of which the first is 1.
// Line spectral frequencies, triangles and pictures are ignored. Models with a moving average, which the
// toolkit makes for other sample rates, are refused: use those at 10 kHz. PhysVib includes none of these
// files, because their licence forbids it.
#pragma once
#include "Io/Result.h"
#include <filesystem>
#include <string_view>
#include <vector>

namespace physvib {

struct TextureModel {
    double metresPerSecond = 0.0, newtons = 0.0; ///< recording conditions
    double variance = 0.0;                       ///< of the noise, (m/s^2)^2
    std::vector<double> coefficients;            ///< a[1], a[2]... of y[n] = noise[n] - sum a[k] y[n - k]
};

struct TextureModels {
    double sampleRateHz = 0.0;
    std::vector<TextureModel> models; ///< at least one

    /// The model with the nearest speed and force, relative to the largest. Any thread.
    const TextureModel& nearest(double metresPerSecond, double newtons) const;
};

/// By the file's ending .xml, case-insensitive. Any thread.
bool isTextureModels(std::string_view path) noexcept;

/// Checks the whole text; or a one-line error. Any thread.
Result<TextureModels> readTextureModels(std::string_view text, std::string_view name);

/// The same for a file. Message thread (M) only.
Result<TextureModels> loadTextureModels(const std::filesystem::path& path);

} // namespace physvib
