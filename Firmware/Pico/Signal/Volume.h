// SPDX-License-Identifier: MIT
// Volume and mute of USB Audio Class 2: one of each for all channels, and one of each per channel, as an
// operating system's mixer shows them. Volumes are multiples of 1/256 dB.
#pragma once
#include "Fixed.h"
#include <algorithm>

namespace physvib::pico {

namespace audio_request {
constexpr std::uint8_t current = 1, range = 2;
constexpr std::uint8_t clockFrequency = 1, clockIsValid = 2; // of the clock
constexpr std::uint8_t mute = 1, volume = 2;                 // of the feature unit
} // namespace audio_request

constexpr std::uint8_t unitInput = 1, unitVolume = 2, unitOutput = 3, unitClock = 4; // ids in the descriptors

constexpr int volumeStep = 128; // half a decibel
constexpr int minVolume = -60 * 256, maxVolume = 0;

/// Gain of a volume, 0 to unity; below -64 dB it is 0. Any thread.
constexpr std::int32_t gainOfVolume(int volume) noexcept {
    constexpr auto table = [] {
        std::array<std::int32_t, 129> gains{};
        double gain = unity;
        for (auto& entry : gains) entry = static_cast<std::int32_t>(gain + 0.5), gain *= 0.94406087628592339;
        return gains;
    }();
    const int index = (maxVolume - volume + volumeStep / 2) / volumeStep;
    return index <= 0 ? unity : index >= 129 ? 0 : table[static_cast<std::size_t>(index)];
}

/// What a request for a value is answered with; no bytes: it is refused.
struct AudioReply {
    std::array<std::uint8_t, 16> bytes{};
    std::uint16_t count = 0;

    constexpr void add(std::uint32_t value, int width) noexcept {
        for (int k = 0; k < width; ++k) bytes[count++] = static_cast<std::uint8_t>(value >> 8 * k);
    }
};

/// Main loop only.
template <int channels>
class AudioControls {
public:
    /// Answer to a request for the current value or the range of a control.
    AudioReply get(std::uint8_t unit, std::uint8_t request, std::uint8_t control,
                   std::uint8_t channel) const noexcept {
        AudioReply reply;
        const bool isRange = request == audio_request::range;
        if (!isRange && request != audio_request::current) return reply;
        if (unit == unitClock && channel == 0) {
            if (control == audio_request::clockFrequency)
                addValues(reply, isRange, sampleRateHz, sampleRateHz, 0, 4);
            if (control == audio_request::clockIsValid && !isRange) reply.add(1, 1);
        } else if (unit == unitVolume && channel <= channels) {
            if (control == audio_request::mute && !isRange) reply.add(isMuted_[channel] ? 1 : 0, 1);
            if (control == audio_request::volume)
                addValues(reply, isRange, isRange ? minVolume : volume_[channel], maxVolume, volumeStep, 2);
        }
        return reply;
    }

    /// False: refused, nothing changes.
    bool set(std::uint8_t unit, std::uint8_t request, std::uint8_t control, std::uint8_t channel,
             const std::uint8_t* data, std::uint16_t count) noexcept {
        if (request != audio_request::current) return false;
        if (unit == unitClock) { // one rate: setting that one is no error
            constexpr std::uint32_t rate = sampleRateHz;
            return control == audio_request::clockFrequency && channel == 0 && count == 4 &&
                   std::equal(data, data + 4, littleEndian(rate).begin());
        }
        if (unit != unitVolume || channel > channels) return false;
        if (control == audio_request::mute && count == 1) {
            isMuted_[channel] = data[0] != 0;
            return true;
        }
        if (control != audio_request::volume || count != 2) return false;
        const auto value = static_cast<std::int16_t>(data[0] | data[1] << 8);
        volume_[channel] = std::clamp<int>(value, minVolume, maxVolume); // -32768 means silence: the lowest
        return true;
    }

    /// Gain of a channel, 0 to unity. The lowest volume is silence.
    std::int32_t gain(int channel) const noexcept {
        const auto own = static_cast<std::size_t>(channel) + 1;
        if (isMuted_[0] || isMuted_[own] || volume_[0] == minVolume || volume_[own] == minVolume) return 0;
        return gainOfVolume(volume_[0] + volume_[own]);
    }

private:
    static constexpr std::array<std::uint8_t, 4> littleEndian(std::uint32_t value) noexcept {
        return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8),
                static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 24)};
    }
    static void addValues(AudioReply& reply, bool isRange, int value, int most, int resolution,
                          int width) noexcept {
        if (isRange) reply.add(1, 2); // one range
        reply.add(static_cast<std::uint32_t>(value), width);
        if (!isRange) return;
        reply.add(static_cast<std::uint32_t>(most), width);
        reply.add(static_cast<std::uint32_t>(resolution), width);
    }

    std::array<int, static_cast<std::size_t>(channels) + 1> volume_{}; // [0]: all channels
    std::array<bool, static_cast<std::size_t>(channels) + 1> isMuted_{};
};

} // namespace physvib::pico
