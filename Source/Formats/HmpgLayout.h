// SPDX-License-Identifier: MIT
// Field widths and constants of .hmpg, as in MPEG's reference software (Docs/decisions/0082): a file is a
// sequence of units, a unit of packets.
#pragma once
#include "Formats/BitStream.h"
#include "Formats/MpegNames.h"
#include <cstddef>

namespace physvib::hmpg {

enum class Unit { initialization, temporal, spatial, silent };
enum class Packet {
    timing,
    experience,
    perception,
    channel,
    band,
    data,
    library,
    crc32,
    crc16,
    globalCrc16,
    globalCrc32,
    initializationTiming
};
enum class EffectType { basis, reference, composite };
enum class CurveType { unknown, cubic, linear };

constexpr int unitTypeBits = 6, syncBits = 2, layerBits = 4, unitDurationBits = 24, unitLengthBits = 32,
              unitReservedBits = 4;
constexpr int packetTypeBits = 6, packetLengthBits = 17, packetReservedBits = 1;
constexpr int timeBits = 32, timescaleBits = 32, nominalDurationBits = 24, durationDeviationBits = 24;
constexpr int perceptionBits = 8, channelBits = 16, bandBits = 8, effectBits = 16, deviceBits = 8,
              avatarBits = 8;
constexpr int priorityBits = 8, textLengthBits = 8, modalityBits = 8, exponentBits = 8;
constexpr int libraryCountBits = 16, deviceCountBits = 8, channelCountBits = 16, bandCountBits = 8,
              effectCountBits = 16, keyframeCountBits = 16, timelineCountBits = 16, vertexCountBits = 16;
constexpr int bodyMaskBits = 32, deviceMaskBits = 12, realBits = 32, channelMaskBits = 8, axisBits = 8,
              targetCountBits = 8, samplingBits = 32;
constexpr int bandTypeBits = 3, curveTypeBits = 4, bandLimitBits = 16;
constexpr int effectTypeBits = 2, semanticBits = 4 + 8, positionBits = 25, phaseBits = 16, waveformBits = 4;
constexpr int ticksBits = 16, amplitudeBits = 8, hertzBits = 16;

// also for Hz
constexpr BitRange phases{0.0, mpeg::mostPhase}, amplitudes{-1.0, 1.0}, gains{-10'000.0, 10'000.0},
    positives{0.0, 10'000.0};

constexpr int vibrotactile = 6;                   // a modality of perceptions
constexpr int hasBodyMask = 1, hasActuators = 2;  // flags of a channel
constexpr int hasAmplitude = 1, hasFrequency = 2; // flags of a wave's keyframe
constexpr int libraryHasTicks = 1, libraryHasAmplitude = 2, libraryHasFrequency = 4;

constexpr std::size_t most(int bits) { return (std::size_t{1} << bits) - 1; }

} // namespace physvib::hmpg
