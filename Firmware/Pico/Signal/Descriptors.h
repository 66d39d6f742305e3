// SPDX-License-Identifier: MIT
// USB descriptors of the board, its volume and mute controls, and the format of its feedback: an Audio Class
// 2 function (48 kHz, 16 bit, an asynchronous endpoint with explicit feedback) and a serial port. Written by
// hand from USB 2.0 (chapter 9), Audio Devices 2.0 and CDC 1.2, without TinyUSB, so that tests can read it.
#pragma once
#include "FixedGuard.h"
#include <algorithm>
#include <atomic>
#include <initializer_list>
#include <string_view>

namespace physvib::pico {

// Volume and mute of USB Audio Class 2: one of each for all channels, and one of each per channel, as an
// operating system's mixer shows them. Volumes are multiples of 1/256 dB.

namespace audio_request {
constexpr std::uint8_t current = 1, range = 2;
constexpr std::uint8_t clockFrequency = 1, clockIsValid = 2; // of the clock
constexpr std::uint8_t mute = 1, volume = 2;                 // of the feature unit
} // namespace audio_request

constexpr std::uint8_t unitInput = 1, unitVolume = 2, unitOutput = 3, unitClock = 4; // ids in the descriptors

constexpr int volumeStep = 128; // half a decibel
constexpr int minVolume = -60 * 256, maxVolume = 0;

/// Gain of a volume, 0 to unity; below -64 dB it is 0. Any thread.
constexpr std::int32_t volumeGain(int volume) noexcept {
    constexpr auto table = [] {
        std::array<std::int32_t, 129> gains{};
        double gain = unity;
        for (auto& entry : gains) entry = static_cast<std::int32_t>(gain + 0.5), gain *= 0.94406087628592339;
        return gains;
    }();
    const int index = (maxVolume - volume + volumeStep / 2) / volumeStep;
    return index <= 0 ? unity : index >= 129 ? 0 : table[static_cast<std::size_t>(index)];
}

/// Answer to a request for a value; no bytes: the request is refused.
struct AudioReply {
    std::array<std::uint8_t, 16> bytes{};
    std::uint16_t count = 0;

    constexpr void add(std::uint32_t value, int width) noexcept {
        for (int k = 0; k < width; ++k) bytes[count++] = static_cast<std::uint8_t>(value >> 8 * k);
    }
};

/// Volume and mute of all channels and of each. Main loop only.
template <int channels>
class AudioControls {
    template <class T>
    using PerChannel = std::array<T, static_cast<std::size_t>(channels) + 1>; // [0]: all channels

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

    /// Sets a control; false: the request is refused, and nothing changes.
    bool set(std::uint8_t unit, std::uint8_t request, std::uint8_t control, std::uint8_t channel,
             const std::uint8_t* data, std::uint16_t count) noexcept {
        if (request != audio_request::current) return false;
        if (unit == unitClock) // one rate: setting that one is no error
            return control == audio_request::clockFrequency && channel == 0 && count == 4 &&
                   (data[0] | data[1] << 8 | data[2] << 16 | data[3] << 24) == sampleRateHz;
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

    /// State as bytes, first that of all channels, then one per channel: steps below the highest volume, and
    /// mute in the highest bit. Steps are rounded towards silence.
    PerChannel<std::uint8_t> toBytes() const noexcept {
        PerChannel<std::uint8_t> bytes{};
        for (std::size_t j = 0; j < bytes.size(); ++j)
            bytes[j] = static_cast<std::uint8_t>((maxVolume - volume_[j] + volumeStep - 1) / volumeStep |
                                                 (isMuted_[j] ? 0x80 : 0));
        return bytes;
    }
    void setFromBytes(const PerChannel<std::uint8_t>& bytes) noexcept {
        for (std::size_t j = 0; j < bytes.size(); ++j) {
            volume_[j] = std::max(minVolume, maxVolume - (bytes[j] & 0x7f) * volumeStep);
            isMuted_[j] = (bytes[j] & 0x80) != 0;
        }
    }

    /// Gain of a channel, 0 to unity. The lowest volume is silence.
    std::int32_t gain(int channel) const noexcept {
        const auto slot = static_cast<std::size_t>(channel) + 1;
        if (isMuted_[0] || isMuted_[slot] || volume_[0] == minVolume || volume_[slot] == minVolume) return 0;
        return volumeGain(volume_[0] + volume_[slot]);
    }

private:
    static void addValues(AudioReply& reply, bool isRange, int value, int maximum, int resolution,
                          int width) noexcept {
        if (isRange) reply.add(1, 2); // one range
        reply.add(static_cast<std::uint32_t>(value), width);
        if (!isRange) return;
        reply.add(static_cast<std::uint32_t>(maximum), width);
        reply.add(static_cast<std::uint32_t>(resolution), width);
    }

    PerChannel<int> volume_{};
    PerChannel<bool> isMuted_{};
};

/// Format of feedback that the host reads. At full speed macOS only accepts 10.14 in three bytes, and Windows
/// only 16.16 in four; Linux detects it. After a reset of the bus, macOS asks for a string before it asks for
/// the configuration, the others after it (found by TinyUSB's authors with Windows 10 and 11, Linux 3.16 to
/// 6.8, macOS 13 and 14). isThreeBytes: any context; the others: interrupt of USB.
class FeedbackFormat {
public:
    void reset() noexcept { firstRequest_.store(0, std::memory_order_relaxed); }
    /// `descriptorType`: what the host asks for.
    void onDescriptorRequest(std::uint8_t descriptorType) noexcept {
        if ((descriptorType == configuration || descriptorType == text) &&
            firstRequest_.load(std::memory_order_relaxed) == 0)
            firstRequest_.store(descriptorType, std::memory_order_relaxed);
    }
    bool isThreeBytes() const noexcept { return firstRequest_.load(std::memory_order_relaxed) == text; }

private:
    static constexpr std::uint8_t configuration = 2, text = 3;
    std::atomic<std::uint8_t> firstRequest_{0}; // type of the first request since the reset
};

constexpr std::uint8_t audioControlInterface = 0, audioStreamInterface = 1, serialControlInterface = 2,
                       serialDataInterface = 3;
constexpr std::uint8_t audioEndpoint = 0x01, feedbackEndpoint = 0x81, serialNotifyEndpoint = 0x82,
                       serialOutEndpoint = 0x03, serialInEndpoint = 0x83;
constexpr std::uint16_t packetBytes(int channels) noexcept {
    return static_cast<std::uint16_t>((sampleRateHz / 1000 + 1) * 2 * channels); // 49 frames: feedback
}

/// Descriptors as bytes that can be appended to. Compile time.
struct DescriptorBytes {
    std::array<std::uint8_t, 320> data{};
    std::uint16_t count = 0;

    constexpr void add(std::initializer_list<int> values) noexcept {
        for (const int value : values) data[count++] = static_cast<std::uint8_t>(value);
    }
    // Adds a descriptor with its length before it.
    constexpr void addDescriptor(std::initializer_list<int> values) noexcept {
        add({static_cast<int>(values.size()) + 1});
        add(values);
    }
    constexpr void setWord(std::size_t offset, int value) noexcept {
        data[offset] = static_cast<std::uint8_t>(value);
        data[offset + 1] = static_cast<std::uint8_t>(value >> 8);
    }
};

constexpr int lowByte(int value) noexcept { return value & 255; }
constexpr int highByte(int value) noexcept { return value >> 8; }

namespace descriptor {
constexpr int configuration = 2, interface = 4, endpoint = 5, association = 11, csInterface = 0x24,
              csEndpoint = 0x25;
constexpr int audio = 1, audioVersion = 0x20, serial = 2, serialData = 10;

// Clock -> input terminal (the host's stream) -> volume -> output terminal.
constexpr void addAudioControl(DescriptorBytes& d, int channels) noexcept {
    d.addDescriptor({association, audioControlInterface, 2, audio, 0, audioVersion, 0});
    d.addDescriptor({interface, audioControlInterface, 0, 0, audio, 1, audioVersion, 0});
    const auto header = d.count;
    d.addDescriptor({csInterface, 1, 0x00, 0x02, 1, 0, 0, 0}); // version 2.0, a speaker; total length below
    d.addDescriptor({csInterface, 10, unitClock, 1, 0x05, 0, 0}); // internal, fixed; frequency, validity
                                                                  // readable
    d.addDescriptor({csInterface, 2, unitInput, 0x01, 0x01, 0, unitClock, channels, 0, 0, 0, 0, 0, 0, 0, 0});
    d.add({6 + 4 * (channels + 1), csInterface, 6, unitVolume, unitInput});
    for (int channel = 0; channel <= channels; ++channel) d.add({0x0f, 0, 0, 0}); // mute and volume
    d.add({0});
    d.addDescriptor({csInterface, 3, unitOutput, 0x01, 0x03, 0, unitVolume, unitClock, 0, 0, 0}); // a speaker
    d.setWord(header + 6u, d.count - header);
}

// Alternate setting 0 takes no bandwidth; 1 has the stream and its feedback.
constexpr void addAudioStream(DescriptorBytes& d, int channels, int feedbackBytes) noexcept {
    const int maxBytes = packetBytes(channels);
    d.addDescriptor({interface, audioStreamInterface, 0, 0, audio, 2, audioVersion, 0});
    d.addDescriptor({interface, audioStreamInterface, 1, 2, audio, 2, audioVersion, 0});
    d.addDescriptor({csInterface, 1, unitInput, 0, 1, 1, 0, 0, 0, channels, 0, 0, 0, 0, 0}); // PCM, no places
    d.addDescriptor({csInterface, 2, 1, 2, 16}); // two bytes, 16 bits
    d.addDescriptor(
        {endpoint, audioEndpoint, 0x05, lowByte(maxBytes), highByte(maxBytes), 1}); // asynchronous,
                                                                                    // 1 ms
    d.addDescriptor({csEndpoint, 1, 0, 0, 0, 0, 0});
    d.addDescriptor({endpoint, feedbackEndpoint, 0x11, feedbackBytes, 0, 1}); // every ms
}

constexpr void addSerial(DescriptorBytes& d) noexcept {
    d.addDescriptor({association, serialControlInterface, 2, serial, 2, 0, 0});
    d.addDescriptor({interface, serialControlInterface, 0, 1, serial, 2, 0, 0});
    d.addDescriptor({csInterface, 0, 0x20, 0x01});
    d.addDescriptor({csInterface, 1, 0, serialDataInterface});
    d.addDescriptor({csInterface, 2, 2});
    d.addDescriptor({csInterface, 6, serialControlInterface, serialDataInterface});
    d.addDescriptor({endpoint, serialNotifyEndpoint, 3, 8, 0, 16});
    d.addDescriptor({interface, serialDataInterface, 0, 2, serialData, 0, 0, 0});
    d.addDescriptor({endpoint, serialOutEndpoint, 2, 64, 0, 0});
    d.addDescriptor({endpoint, serialInEndpoint, 2, 64, 0, 0});
}
} // namespace descriptor

/// The configuration descriptor, whole. Compile time.
constexpr DescriptorBytes configurationDescriptor(int channels, int feedbackBytes = 4) noexcept {
    DescriptorBytes d;
    d.addDescriptor({descriptor::configuration, 0, 0, 4, 1, 0, 0x80, 50}); // bus power, max 100 mA
    descriptor::addAudioControl(d, channels);
    descriptor::addAudioStream(d, channels, feedbackBytes);
    descriptor::addSerial(d);
    d.setWord(2, d.count);
    return d;
}

/// The device descriptor. Vendor and product are TinyUSB's numbers for examples, as this project owns none:
/// find the board by its name, which begins with "PhysVib". Windows caches descriptors per version, so the
/// version is that of the image: "1.2.3" is 1.23.
constexpr std::array<std::uint8_t, 18> deviceDescriptor(int channels, std::string_view version) noexcept {
    std::array<int, 3> parts{};
    std::size_t part = 0;
    for (const char c : version) {
        if (c == '.' && ++part < parts.size()) continue;
        if (c < '0' || c > '9' || part >= parts.size()) break;
        parts[part] = std::min(9, 10 * parts[part] + (c - '0')); // a digit each
    }
    const auto product = static_cast<std::uint8_t>(0x50 + channels),
               minor = static_cast<std::uint8_t>(16 * parts[1] + parts[2]),
               major = static_cast<std::uint8_t>(parts[0]);
    // USB 2.0, functions by association; vendor, product and version; texts
    return {18, 1, 0x00, 0x02, 0xef, 2, 1, 64, 0xfe, 0xca, product, 0x40, minor, major, 1, 2, 3, 1};
}

} // namespace physvib::pico
