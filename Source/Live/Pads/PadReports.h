// SPDX-License-Identifier: MIT
// Byte formats of vibration reports for DualSense, Steam and Switch controllers, not tried on hardware;
// Docs/pads.md has the sources.
#pragma once
#include "Io/Text/CleanText.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// A report with its number first.
struct PadReport {
    std::array<std::uint8_t, 142> bytes{};
    std::size_t size = 0;
    std::span<const std::uint8_t> span() const noexcept { return {bytes.data(), size}; }
};

/// One frame: left coil, right coil, -1 to 1.
using CoilFrame = std::array<float, 2>;

/// Format in which a controller receives samples.
struct CoilFormat {
    int rateHz; ///< of its frames
    int frames; ///< number in one report
    /// Frames as a report, `number` counts reports from 0. Any thread.
    PadReport (*encode)(std::span<const CoilFrame> frames, std::uint32_t number) noexcept;
    /// Reports that switch samples on or off, in order, `switchSeconds` apart; empty: none needed.
    std::span<const PadReport> onReports, offReports;
};
constexpr double switchSeconds = 0.01;

/// DualSense by Bluetooth: report 0x32, 32 frames of signed 8 bits at 3,000 Hz.
const CoilFormat& dualSenseSamples() noexcept;
/// Steam Controller (2026): report 0x88, 15 frames of 16 bits at 4,000 Hz, a mode that cable and radio have.
const CoilFormat& steamSamples() noexcept;

/// Two tones of one actuator of a Switch controller.
struct TonePair {
    double lowHz = 160.0, low = 0.0;   ///< 40.9 to 626 Hz; amplitude 0 to 1
    double highHz = 320.0, high = 0.0; ///< 81.8 to 1,253 Hz
    bool operator==(const TonePair&) const = default;
};
/// Switch controllers: report 0x10, with the tones of both sides. Frequencies and amplitudes out of range
/// become the nearest. Any thread.
PadReport switchTones(const TonePair& left, const TonePair& right, std::uint32_t number) noexcept;

// Switches the coils of a DualSense controller from emulated motors to channels 3 and 4 of its audio device.
// Tested on a model of the device, not on hardware (Docs/pads.md).

namespace dualsense {

/// Output report 0x02 without its number, as SDL_GameControllerSendEffect expects it. According to SDL's
/// driver, the kernel's hid-playstation and public descriptions, byte 0 has bit 0 for emulated motors and bit
/// 1 for "no audio on the coils"; bytes 2 and 3 are the motor levels; the other bytes have no effect while
/// their flags are 0. So the whole report is 0.
using Report = std::array<std::uint8_t, 47>;
constexpr std::size_t flagsByte = 0, rightMotorByte = 2, leftMotorByte = 3;
constexpr std::uint8_t emulatesMotors = 0x01, keepsSoundFromCoils = 0x02;
constexpr Report coilsToSound() noexcept { return {}; }

constexpr int outputs = 4, leftCoil = 2, rightCoil = 3; ///< outputs of its audio device, from 0; the first
                                                        ///< two are loudspeaker and headphones

/// Whether an audio device with that name is a DualSense. Over USB the name is "DualSense Wireless
/// Controller" or "DualSense Edge ...".
inline bool isDevice(std::string_view name) {
    return lowerCase(std::string{name}).find("dualsense") != std::string::npos;
}

} // namespace dualsense

} // namespace physvib
