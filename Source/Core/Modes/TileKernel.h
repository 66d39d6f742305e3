// SPDX-License-Identifier: MIT
// What a vector kernel does for one tile of 64 frames. Written once in TileKernels.cpp, compiled once per
// instruction set.
#pragma once
#include "Core/Actuators/LimiterKernel.h"
#include "Core/Modes/InstructionSet.h"
#include "Core/Modes/TileLayers.h"

namespace physvib {

/// One instruction set's functions. R, wait-free.
struct TileKernel {
    InstructionSet set = InstructionSet::scalar;
    void (*advance)(const TileCarriers& carriers) = nullptr;
    void (*render)(const TileLayer& layer, float* out) = nullptr; ///< out[channel * 64 + frame]
    void (*strike)(const TileStrikes& strikes) = nullptr;
    /// out = base + tails
    void (*sum)(const float* base, const double* tails, int count, float* out) = nullptr;
    void (*clear)(float* const* out, int channels, int frames) = nullptr; ///< out[channel][frame] = 0
    LimiterKernel limiter;
};

/// Null for scalar and for sets that this build or processor lacks. Any thread.
const TileKernel* tileKernel(InstructionSet set) noexcept;

} // namespace physvib
