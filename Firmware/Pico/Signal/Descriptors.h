// SPDX-License-Identifier: MIT
// What the board tells a USB host about itself: an Audio Class 2 function (48 kHz, 16 bit, an asynchronous
// endpoint with explicit feedback, volume and mute) and a serial port for text. Written by hand from the
// standards (USB 2.0 chapter 9; Audio Devices 2.0; CDC 1.2), without TinyUSB, so that tests can read it.
#pragma once
#include "Volume.h"
#include <initializer_list>

namespace physvib::pico {

constexpr std::uint8_t audioControlInterface = 0, audioStreamInterface = 1, serialControlInterface = 2,
                       serialDataInterface = 3;
constexpr std::uint8_t audioEndpoint = 0x01, feedbackEndpoint = 0x81, serialNotifyEndpoint = 0x82,
                       serialOutEndpoint = 0x03, serialInEndpoint = 0x83;
constexpr std::uint16_t packetBytes(int channels) noexcept {
    return static_cast<std::uint16_t>((sampleRateHz / 1000 + 1) * 2 * channels); // 49 frames: room for
                                                                                 // feedback
}

/// Bytes that grow. Compile time.
struct DescriptorBytes {
    std::array<std::uint8_t, 320> data{};
    std::uint16_t count = 0;

    constexpr void add(std::initializer_list<int> values) noexcept {
        for (const int value : values) data[count++] = static_cast<std::uint8_t>(value);
    }
    // A descriptor: its length goes first.
    constexpr void put(std::initializer_list<int> values) noexcept {
        add({static_cast<int>(values.size()) + 1});
        add(values);
    }
    constexpr void setWord(std::size_t at, int value) noexcept {
        data[at] = static_cast<std::uint8_t>(value);
        data[at + 1] = static_cast<std::uint8_t>(value >> 8);
    }
};

constexpr int lowByte(int value) noexcept { return value & 255; }
constexpr int highByte(int value) noexcept { return value >> 8; }

namespace descriptor {
constexpr int configuration = 2, interface = 4, endpoint = 5, association = 11, ofInterface = 0x24,
              ofEndpoint = 0x25;
constexpr int audio = 1, audioVersion = 0x20, serial = 2, serialData = 10;

// Clock -> input terminal (the host's stream) -> volume -> output terminal.
constexpr void addAudioControl(DescriptorBytes& d, int channels) noexcept {
    d.put({association, audioControlInterface, 2, audio, 0, audioVersion, 0});
    d.put({interface, audioControlInterface, 0, 0, audio, 1, audioVersion, 0});
    const auto header = d.count;
    d.put({ofInterface, 1, 0x00, 0x02, 1, 0, 0, 0});    // version 2.0, a speaker; total length below
    d.put({ofInterface, 10, unitClock, 1, 0x05, 0, 0}); // internal, fixed; frequency and validity can be read
    d.put({ofInterface, 2, unitInput, 0x01, 0x01, 0, unitClock, channels, 0, 0, 0, 0, 0, 0, 0, 0});
    d.add({6 + 4 * (channels + 1), ofInterface, 6, unitVolume, unitInput});
    for (int channel = 0; channel <= channels; ++channel) d.add({0x0f, 0, 0, 0}); // mute and volume
    d.add({0});
    d.put({ofInterface, 3, unitOutput, 0x01, 0x03, 0, unitVolume, unitClock, 0, 0, 0}); // a speaker
    d.setWord(header + 6u, d.count - header);
}

// Alternate setting 0 takes no bandwidth; 1 has the stream and its feedback.
constexpr void addAudioStream(DescriptorBytes& d, int channels) noexcept {
    const int most = packetBytes(channels);
    d.put({interface, audioStreamInterface, 0, 0, audio, 2, audioVersion, 0});
    d.put({interface, audioStreamInterface, 1, 2, audio, 2, audioVersion, 0});
    d.put({ofInterface, 1, unitInput, 0, 1, 1, 0, 0, 0, channels, 0, 0, 0, 0, 0}); // PCM; places not named
    d.put({ofInterface, 2, 1, 2, 16});                                             // two bytes, 16 bits
    d.put({endpoint, audioEndpoint, 0x05, lowByte(most), highByte(most), 1});      // asynchronous, every ms
    d.put({ofEndpoint, 1, 0, 0, 0, 0, 0});
    d.put({endpoint, feedbackEndpoint, 0x11, 4, 0, 1}); // feedback, every ms
}

constexpr void addSerial(DescriptorBytes& d) noexcept {
    d.put({association, serialControlInterface, 2, serial, 2, 0, 0});
    d.put({interface, serialControlInterface, 0, 1, serial, 2, 0, 0});
    d.put({ofInterface, 0, 0x20, 0x01});
    d.put({ofInterface, 1, 0, serialDataInterface});
    d.put({ofInterface, 2, 2});
    d.put({ofInterface, 6, serialControlInterface, serialDataInterface});
    d.put({endpoint, serialNotifyEndpoint, 3, 8, 0, 16});
    d.put({interface, serialDataInterface, 0, 2, serialData, 0, 0, 0});
    d.put({endpoint, serialOutEndpoint, 2, 64, 0, 0});
    d.put({endpoint, serialInEndpoint, 2, 64, 0, 0});
}
} // namespace descriptor

/// The configuration descriptor, whole. Compile time.
constexpr DescriptorBytes configurationDescriptor(int channels) noexcept {
    DescriptorBytes d;
    d.put({descriptor::configuration, 0, 0, 4, 1, 0, 0x80, 50}); // powered by the bus, 100 mA at most
    descriptor::addAudioControl(d, channels);
    descriptor::addAudioStream(d, channels);
    descriptor::addSerial(d);
    d.setWord(2, d.count);
    return d;
}

/// The device descriptor. The vendor number is TinyUSB's for examples: this project owns none, so nothing may
/// find the board by number; its name begins with "PhysVib".
constexpr std::array<std::uint8_t, 18> deviceDescriptor(int channels) noexcept {
    return {18,   1,    0x00,
            0x02, 0xef, 2,
            1,    64, // USB 2.0, functions by association
            0xfe, 0xca, static_cast<std::uint8_t>(0x50 + channels),
            0x40, 0x00, 0x01,
            1,    2,    3,
            1};
}

} // namespace physvib::pico
