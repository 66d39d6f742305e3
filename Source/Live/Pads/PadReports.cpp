// SPDX-License-Identifier: MIT
// Encoders of reports. All numbers are little-endian.
#include "Live/Pads/PadReports.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

/// CRC-32 (as of Ethernet), as if the byte 0xA2 came first: Bluetooth's header of an output report.
std::uint32_t bluetoothCrc(std::span<const std::uint8_t> bytes) noexcept {
    std::uint32_t crc = 0xFFFFFFFFu;
    const auto addByte = [&crc](std::uint8_t byte) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0u ? 0xEDB88320u : 0u);
    };
    addByte(0xA2);
    for (const std::uint8_t byte : bytes) addByte(byte);
    return ~crc;
}

int quantised(float sample, int scale) noexcept {
    return static_cast<int>(std::lround(std::clamp(sample, -1.0f, 1.0f) * static_cast<float>(scale)));
}

// Two blocks in one report: 0x11 with seven bytes of audio settings, the last of which counts, and 0x12 with
// the frames; bit 7 of a block's number says that a length follows. The CRC is the report's end.
PadReport encodeDualSense(std::span<const CoilFrame> frames, std::uint32_t number) noexcept {
    PadReport report;
    auto& b = report.bytes;
    report.size = 142;
    b[0] = 0x32;
    b[1] = static_cast<std::uint8_t>((number & 0xFu) << 4);
    b[2] = 0x80 | 0x11, b[3] = 7;
    b[4] = 0xFE, b[9] = 0xFF, b[10] = static_cast<std::uint8_t>(number);
    b[11] = 0x80 | 0x12, b[12] = 64;
    std::size_t position = 13;
    for (const CoilFrame& frame : frames)
        for (const float sample : frame) b[position++] = static_cast<std::uint8_t>(quantised(sample, 127));
    const std::uint32_t crc = bluetoothCrc({b.data(), 138});
    for (std::size_t k = 0; k < 4; ++k) b[138 + k] = static_cast<std::uint8_t>(crc >> (8 * k));
    return report;
}

// Bytes of a channel, then 31 places for the left one and 31 for the right one.
PadReport encodeSteam(std::span<const CoilFrame> frames, std::uint32_t) noexcept {
    PadReport report;
    report.size = 64;
    report.bytes[0] = 0x88;
    report.bytes[1] = static_cast<std::uint8_t>(2 * frames.size());
    for (std::size_t n = 0; n < frames.size(); ++n)
        for (std::size_t side = 0; side < 2; ++side) {
            const int value = quantised(frames[n][side], 32767);
            report.bytes[2 + 31 * side + 2 * n] = static_cast<std::uint8_t>(value & 0xFF);
            report.bytes[3 + 31 * side + 2 * n] = static_cast<std::uint8_t>(value >> 8 & 0xFF);
        }
    return report;
}

// Operation 1: off, 2: on; actuators 2 (both trackpads) and 5 (both grips); 1: 4,000 Hz at 16 bits.
constexpr PadReport steamMode(std::uint8_t operation, std::uint8_t actuators, std::uint8_t mode) noexcept {
    PadReport report;
    report.bytes[0] = 0x86, report.bytes[1] = operation, report.bytes[2] = actuators, report.bytes[3] = mode;
    report.size = 4;
    return report;
}
constexpr std::array steamOff{steamMode(1, 2, 0), steamMode(1, 5, 0)};
constexpr std::array steamOn{steamOff[0], steamOff[1], steamMode(2, 2, 1), steamMode(2, 5, 1)};

// 32 steps an octave above 10 Hz.
int toneStep(double hz, int minStep, int maxStep) noexcept {
    return std::clamp(static_cast<int>(std::lround(32.0 * portable::log2(std::max(hz, 10.0) / 10.0))),
                      minStep, maxStep);
}

// 0 to 100: steps of a quarter octave up to 0.112, a sixteenth up to 0.23, then a thirty-second. 100 is full
// scale; what is above may damage the actuator.
int amplitudeStep(double amplitude) noexcept {
    if (!(amplitude >= 0.0085)) return 0;
    const double step = amplitude > 0.23    ? 32.0 * portable::log2(8.7 * amplitude)
                        : amplitude > 0.115 ? 16.0 * portable::log2(17.0 * amplitude)
                                            : std::min(15.0, 1.0 + 4.0 * portable::log2(amplitude / 0.01));
    return std::clamp(static_cast<int>(std::lround(step)), 1, 100);
}

void writeTones(const TonePair& tones, std::uint8_t* bytes) noexcept {
    const int high = 4 * (toneStep(tones.highHz, 0x61, 0xDF) - 0x60), highLevel = amplitudeStep(tones.high);
    const int low = toneStep(tones.lowHz, 0x41, 0xBF) - 0x40, lowLevel = amplitudeStep(tones.low);
    bytes[0] = static_cast<std::uint8_t>(high & 0xFF);
    bytes[1] = static_cast<std::uint8_t>(2 * highLevel + (high >> 8));
    bytes[2] = static_cast<std::uint8_t>(low + ((lowLevel & 1) != 0 ? 0x80 : 0));
    bytes[3] = static_cast<std::uint8_t>(0x40 + lowLevel / 2);
}

} // namespace

const CoilFormat& dualSenseSamples() noexcept {
    static constexpr CoilFormat format{3000, 32, encodeDualSense, {}, {}};
    return format;
}

const CoilFormat& steamSamples() noexcept {
    static constexpr CoilFormat format{4000, 15, encodeSteam, steamOn, steamOff};
    return format;
}

PadReport switchTones(const TonePair& left, const TonePair& right, std::uint32_t number) noexcept {
    PadReport report;
    report.size = 10;
    report.bytes[0] = 0x10;
    report.bytes[1] = static_cast<std::uint8_t>(number & 0xFu);
    writeTones(left, report.bytes.data() + 2);
    writeTones(right, report.bytes.data() + 6);
    return report;
}

} // namespace physvib
