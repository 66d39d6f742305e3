// SPDX-License-Identifier: MIT
// Effects common to both MPEG formats: conversion between keyframes on ticks and a clip.
#pragma once
#include "Formats/Clip.h"
#include "Formats/MpegNames.h"
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace physvib::mpeg {

enum class BandType { transient, curve, vectorial, wavelet }; // numbered as in the binary format
constexpr std::array<std::string_view, 4> bandTypes{"Transient", "Curve", "VectorialWave", "WaveletWave"};

constexpr std::string_view noWavelets =
    "expected waves, transients or curves, found wavelets, which are not read";
constexpr std::string_view inTimeOrder = "expected keyframes in time order";

struct Keyframe {
    double seconds = 0.0;
    std::optional<double> amplitude, frequencyHz;
};

struct Effect {
    double phaseRadians = 0.0;
    ClipWaveform waveform = ClipWaveform::sine;
    std::vector<Keyframe> keyframes; ///< in time order
};

struct BandKind {
    BandType type = BandType::vectorial;
    bool isCubic = false; ///< for curves
    double gain = 1.0;    ///< of the channel
};

/// Adds an effect that begins at `startSeconds` to its band, or, if it has transients, to its channel. Any
/// thread.
void takeEffect(const Effect& effect, double startSeconds, const BandKind& kind, ClipBand& band,
                ClipChannel& channel);

/// A written keyframe: ticks since its effect began.
struct TickFrame {
    std::int64_t ticks = 0;
    std::optional<double> amplitude, frequencyHz;
};

/// Amplitudes (unscaled) and frequencies of a wave by tick. Any thread.
std::vector<TickFrame> tickFrames(const ClipWave& wave);

} // namespace physvib::mpeg
