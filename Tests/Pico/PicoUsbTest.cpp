// SPDX-License-Identifier: MIT
// What a USB host sees of the Pico: descriptors that hold together, volume and mute, feedback that keeps the
// buffer, the serial port's text, the LED.
#include "Console.h"
#include "HostClock.h"
#include "Signal/Descriptors.h"
#include "Signal/FrameBuffer.h"
#include "Signal/Indicator.h"
#include "Streams.h"
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace physvib::pico_usb_test {

TEST(PicoDescriptors, HoldTogether) {
    for (const int channels : {4, 8}) {
        const auto d = pico::configurationDescriptor(channels);
        EXPECT_EQ(d.data[2] | d.data[3] << 8, d.count);
        int interfaces = 0, endpoints = 0, streams = 0;
        std::size_t at = 0;
        for (; at < d.count; at += d.data[at]) {
            ASSERT_GE(d.data[at], 2) << at;
            const auto type = d.data[at + 1];
            interfaces += type == 4 && d.data[at + 3] == 0 ? 1 : 0;
            endpoints += type == 5 ? 1 : 0;
            if (type == 0x24 && d.data[at] == 16 && d.data[at + 2] == 1) {
                EXPECT_EQ(d.data[at + 10], channels);
                ++streams;
            }
            if (type == 5 && d.data[at + 2] == pico::audioEndpoint) {
                EXPECT_EQ(d.data[at + 4] | d.data[at + 5] << 8, 49 * 2 * channels);
                EXPECT_LE(49 * 2 * channels, 1023) << "what full speed carries";
            }
            // The class-specific header's length covers all units of the audio function.
            if (type == 0x24 && d.data[at] == 9) {
                std::size_t end = at;
                while (d.data[end + 1] == 0x24) end += d.data[end];
                EXPECT_EQ(d.data[at + 6] | d.data[at + 7] << 8, static_cast<int>(end - at));
            }
        }
        EXPECT_EQ(at, d.count);
        EXPECT_EQ(interfaces, d.data[4]);
        EXPECT_EQ(endpoints, 5);
        EXPECT_EQ(streams, 1);
    }
}

TEST(PicoVolume, IsInDecibels) {
    EXPECT_EQ(pico::volumeGain(0), pico::unity);
    EXPECT_NEAR(pico::volumeGain(-6 * 256), 0.50119 * pico::unity, 1.0);
    EXPECT_NEAR(pico::volumeGain(-60 * 256), 0.001 * pico::unity, 1.0);
    EXPECT_EQ(pico::volumeGain(-120 * 256), 0);
    pico::AudioControls<4> controls;
    const auto set = [&](std::uint8_t control, std::uint8_t channel, int value, int bytes) {
        const std::uint8_t data[] = {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)};
        return controls.set(pico::unitVolume, 1, control, channel, data, static_cast<std::uint16_t>(bytes));
    };
    EXPECT_TRUE(set(pico::audio_request::volume, 2, -12 * 256, 2));
    EXPECT_TRUE(set(pico::audio_request::volume, 0, -6 * 256, 2));
    EXPECT_EQ(controls.gain(1), pico::volumeGain(-18 * 256));
    EXPECT_EQ(controls.gain(0), pico::volumeGain(-6 * 256));
    EXPECT_TRUE(set(pico::audio_request::mute, 1, 1, 1));
    EXPECT_EQ(controls.gain(0), 0);
    EXPECT_TRUE(set(pico::audio_request::volume, 0, -32768, 2));
    EXPECT_EQ(controls.gain(3), 0);
    EXPECT_FALSE(set(pico::audio_request::volume, 5, 0, 2)) << "no such channel";
    EXPECT_FALSE(set(pico::audio_request::volume, 1, 0, 1)) << "one byte";
    const auto range = controls.get(pico::unitVolume, 2, pico::audio_request::volume, 4);
    EXPECT_EQ(range.count, 8);
    EXPECT_EQ(static_cast<std::int16_t>(range.bytes[2] | range.bytes[3] << 8), pico::minVolume);
    EXPECT_EQ(controls.get(pico::unitClock, 2, pico::audio_request::clockFrequency, 0).count, 14);
}

TEST(PicoVolume, IsKeptInAByteAndNeverLouder) {
    for (int volume = pico::minVolume + pico::volumeStep; volume <= 0; volume += 7) {
        pico::AudioControls<4> controls, again;
        const std::uint8_t data[] = {static_cast<std::uint8_t>(volume),
                                     static_cast<std::uint8_t>(volume >> 8)};
        ASSERT_TRUE(controls.set(pico::unitVolume, 1, pico::audio_request::volume, 2, data, 2));
        ASSERT_TRUE(controls.set(pico::unitVolume, 1, pico::audio_request::mute, 3, data, 1));
        again.setFromBytes(controls.toBytes());
        EXPECT_LE(again.gain(1), controls.gain(1)) << volume;
        EXPECT_GE(again.gain(1) + 1, controls.gain(1) * 0.94) << volume << ": half a decibel at most";
        EXPECT_EQ(again.gain(2), controls.gain(2)) << "mute";
        EXPECT_EQ(again.toBytes(), controls.toBytes());
    }
    pico::AudioControls<4> torn;
    torn.setFromBytes({0x7f, 0, 0xff, 0, 0});
    EXPECT_EQ(torn.gain(0), 0) << "below the lowest";
}

TEST(PicoVolume, AnyRequestLeavesAGainOfAtMostOne) {
    pico::AudioControls<8> controls;
    std::minstd_rand random(1);
    for (int k = 0; k < 100000; ++k) {
        std::uint8_t data[64];
        for (auto& byte : data) byte = static_cast<std::uint8_t>(random());
        const auto byte = [&] {
            return static_cast<std::uint8_t>(random() % 2 == 0 ? random() : random() % 10);
        };
        controls.set(byte(), byte(), byte(), byte(), data, static_cast<std::uint16_t>(random() % 64));
        EXPECT_LE(controls.get(byte(), byte(), byte(), byte()).count, 16);
        const auto gain = controls.gain(static_cast<int>(random() % 8));
        ASSERT_TRUE(gain >= 0 && gain <= pico::unity);
    }
}

// Ten minutes.
TEST(PicoFeedback, KeepsTheBufferWhereverTheHostsClockGoes) {
    for (const double ppm : {-500.0, 0.0, 500.0}) {
        test::Stream<4> stream;
        const auto& player = *stream.player;
        std::uint32_t least = 1000, most = 0;
        test::playByHostClock(stream, ppm, 600000, [&](int ms, int frames, std::uint32_t level) {
            EXPECT_TRUE(frames >= 47 && frames <= 49);
            if (ms > 1000) least = std::min(least, level), most = std::max(most, level);
        });
        std::cout << ppm << " ppm: " << least << " to " << most << " frames after a packet\n";
        EXPECT_EQ(player.underruns(), 0u) << ppm;
        EXPECT_EQ(player.buffer.overruns(), 0u) << ppm;
        EXPECT_GT(least, 96u) << ppm;
        EXPECT_LT(most, 176u) << ppm;
    }
}

TEST(PicoConsole, AnswersAndSilences) {
    pico::Console console;
    const pico::Console::Status facts{8, "E661", true, 32767, 1, 2, 8, 3, 4, 5, 6, 7};
    const auto ask = [&](const std::string& line) {
        bool isDue = false;
        for (const char c : line) EXPECT_FALSE(console.receive(c));
        isDue = console.receive('\n');
        return isDue ? std::string(console.answer(facts)) : "";
    };
    EXPECT_EQ(ask("info").substr(0, 22), "physvib pico8 version ");
    EXPECT_NE(ask("info").find(" serial E661\r\n"), std::string::npos);
    EXPECT_EQ(ask("counters"), "playing underruns 1 overruns 2 missing_packets 8 wrong_sizes 3 restarts 4 "
                               "limited_tiles 5 level_frames 6 "
                               "ceiling 32767 worst_tile_cycles 7\r\n");
    for (const char* line :
         {"silence on", "silence", "silence maybe", "silence off and a long text behind it"}) {
        EXPECT_EQ(ask(line), "silence on\r\n") << line;
        EXPECT_TRUE(console.isSilenced()) << line;
        EXPECT_EQ(ask("silence off"), "silence off\r\n");
        EXPECT_FALSE(console.isSilenced());
    }
    EXPECT_EQ(ask("").size(), 0u);
    EXPECT_EQ(ask("help"), "expected: info, counters, silence on, or silence off\r\n");
    EXPECT_EQ(ask(std::string(1000, 'x')), "expected: info, counters, silence on, or silence off\r\n");
}

TEST(PicoIndicator, ShowsFourStates) {
    pico::Indicator indicator;
    using pico::Light;
    constexpr std::uint32_t second = pico::tilesPerSecond;
    EXPECT_EQ(indicator.update(0, false, 0, 0), Light::waiting);
    EXPECT_EQ(indicator.update(1, true, 0, 0), Light::playing);
    EXPECT_EQ(indicator.update(2, true, 1, 0), Light::limiting);
    EXPECT_EQ(indicator.update(2 + second, true, 1, 0), Light::playing);
    EXPECT_EQ(indicator.update(2 + second, true, 1, 1), Light::error);
    EXPECT_EQ(indicator.update(2 + 6 * second, true, 1, 1), Light::playing);
    const auto flashes = [](Light light) { // in six seconds
        int count = 0;
        for (std::uint32_t t = 1; t < 6 * second; ++t)
            count += pico::Indicator::isOn(light, t) && !pico::Indicator::isOn(light, t - 1) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(flashes(Light::playing), 0);
    EXPECT_EQ(flashes(Light::waiting), 2);
    EXPECT_EQ(flashes(Light::limiting), 47);
    EXPECT_EQ(flashes(Light::error), 11);
}

// The descriptors follow what Windows and macOS ask of a USB sound card beyond the standards, by their
// documents: Microsoft's "USB Audio 2.0 drivers" (usbaudio2.sys) and Apple's TN2274, "USB Audio on the Mac".
// Neither system was tried.

using Bytes = std::vector<std::uint8_t>;

int word(const Bytes& d, std::size_t at) { return d[at] | d[at + 1] << 8; }

// One alternate setting of one interface, and what belongs to it.
struct Setting {
    Bytes interface;
    std::vector<Bytes> own, endpoints; // of the class
};

class PicoHostRules : public testing::TestWithParam<int> {
protected:
    static constexpr int audioClass = 1, control = 1, streaming = 2;

    const int channels = GetParam();
    std::vector<Setting> settings;
    std::map<int, Bytes> entities; // of the audio function, by id

    PicoHostRules() {
        const auto all = pico::configurationDescriptor(channels);
        for (std::size_t at = 9; at < all.count; at += all.data[at]) {
            const Bytes d(all.data.begin() + static_cast<std::ptrdiff_t>(at),
                          all.data.begin() + static_cast<std::ptrdiff_t>(at + all.data[at]));
            if (d[1] == pico::descriptor::interface) settings.push_back({d, {}, {}});
            if (d[1] == pico::descriptor::csInterface) settings.back().own.push_back(d);
            if (d[1] == pico::descriptor::endpoint) settings.back().endpoints.push_back(d);
        }
        const auto controls = of(control);
        for (const auto& d : controls.front().own) {
            if (d[2] == 1) continue; // the header
            EXPECT_TRUE(entities.emplace(d[3], d).second) << "an id twice: " << int{d[3]};
        }
    }
    std::vector<Setting> of(int subclass) const {
        std::vector<Setting> found;
        for (const auto& s : settings)
            if (s.interface[5] == audioClass && s.interface[6] == subclass) found.push_back(s);
        return found;
    }
    Bytes entity(int subtype) const {
        for (const auto& [id, d] : entities)
            if (d[2] == subtype) return d;
        return {};
    }
};

INSTANTIATE_TEST_SUITE_P(Channels, PicoHostRules, testing::Values(4, 8));

constexpr int inputTerminal = 2, outputTerminal = 3, featureUnit = 6, clockSource = 10;

TEST_P(PicoHostRules, WindowsFindsTheFunction) {
    const auto device = pico::deviceDescriptor(channels, "1.2.13-rc.1");
    EXPECT_EQ(device[12] | device[13] << 8, 0x0129) << "the version, a digit each";
    EXPECT_EQ((std::vector<int>{device[4], device[5], device[6]}), (std::vector<int>{0xef, 2, 1}))
        << "functions by association, or Windows makes one device of all interfaces";
    const auto all = pico::configurationDescriptor(channels);
    const auto* association = all.data.data() + 9;
    EXPECT_EQ(association[1], pico::descriptor::association);
    EXPECT_EQ(association[3], 2) << "interfaces of the audio function";
    EXPECT_EQ(association[4], audioClass);
    EXPECT_EQ(association[6], 0x20) << "what usbaudio2.inf asks for";
    ASSERT_EQ(of(control).size(), 1u);
    EXPECT_EQ(of(control).front().interface[7], 0x20);
    EXPECT_GE(of(streaming).size(), 1u);
    EXPECT_LE(channels, 8) << "more are not in shared mode";
}

TEST_P(PicoHostRules, WindowsFollowsClocksAndUnits) {
    int clocks = 0;
    for (const auto& [id, d] : entities) clocks += d[2] == clockSource ? 1 : 0;
    EXPECT_EQ(clocks, 1) << "it supports one";
    const int clock = entity(clockSource)[3];
    EXPECT_EQ(entity(inputTerminal)[7], clock);
    EXPECT_EQ(entity(outputTerminal)[8], clock);
    // From the speaker back to the stream, each step to another entity.
    const auto feature = entities.at(entity(outputTerminal)[7]);
    EXPECT_EQ(feature[2], featureUnit);
    EXPECT_EQ(entities.at(feature[4])[2], inputTerminal);
    EXPECT_EQ(entities.size(), 4u);
}

TEST_P(PicoHostRules, WindowsTakesTheStream) {
    const auto streams = of(streaming);
    ASSERT_EQ(streams.size(), 2u);
    EXPECT_EQ(streams[0].interface[3], 0);
    EXPECT_TRUE(streams[0].endpoints.empty()) << "alternate setting 0 takes no bandwidth";
    EXPECT_EQ(streams[1].interface[3], 1) << "ascending";
    ASSERT_EQ(streams[1].own.size(), 2u);
    const auto &general = streams[1].own[0], &format = streams[1].own[1];
    EXPECT_EQ(entities.at(general[3])[2], inputTerminal) << "the link names a terminal";
    EXPECT_EQ(general[5], format[3]) << "type of format, said twice";
    const auto formats = static_cast<unsigned>(word(general, 6) | word(general, 8) << 16);
    EXPECT_TRUE(formats != 0 && (formats & (formats - 1)) == 0) << "exactly one bit";
    EXPECT_EQ(format[4], 2);
    EXPECT_EQ(format[5], 16);
    EXPECT_EQ(general[10], channels);
    ASSERT_EQ(streams[1].endpoints.size(), 2u);
    const auto &data = streams[1].endpoints[0], &feedback = streams[1].endpoints[1];
    EXPECT_EQ(data[3], 0x05) << "isochronous, asynchronous, data";
    EXPECT_EQ(feedback[3], 0x11) << "explicit feedback, in the same setting";
    EXPECT_EQ(feedback[2] & 0x80, 0x80);
    EXPECT_EQ(word(feedback, 4), 4) << "four bytes, against USB 2.0's three: it takes nothing else";
}

TEST_P(PicoHostRules, WindowsReadsClockAndVolumes) {
    const pico::AudioControls<8> controls;
    const auto frequency = pico::audio_request::clockFrequency, volume = pico::audio_request::volume;
    EXPECT_EQ(entity(clockSource)[5] & 3, 1) << "the frequency can be read";
    const auto rate = controls.get(pico::unitClock, 2, frequency, 0);
    const auto rateAt = [&](std::size_t at) {
        return rate.bytes[at] | rate.bytes[at + 1] << 8 | rate.bytes[at + 2] << 16;
    };
    EXPECT_EQ(rate.bytes[0], 1) << "one range";
    EXPECT_EQ(rateAt(2), 48000);
    EXPECT_EQ(rateAt(6), 48000) << "a discrete rate: least and most are the same";
    EXPECT_EQ(rateAt(10), 0) << "and the step is 0";
    EXPECT_EQ(controls.get(pico::unitClock, 1, frequency, 0).count, 4);
    EXPECT_EQ(controls.get(pico::unitVolume, 2, volume, 1).bytes[0], 1) << "one range";
    EXPECT_EQ((pico::maxVolume - pico::minVolume) % pico::volumeStep, 0) << "whole steps";
    const auto feature = entity(featureUnit);
    ASSERT_EQ(feature.size(), static_cast<std::size_t>(6 + 4 * (channels + 1)));
    for (int channel = 1; channel <= channels; ++channel)
        EXPECT_EQ(feature[static_cast<std::size_t>(5 + 4 * channel)], 0x0f)
            << "it ignores the one for all where each channel has mute and volume";
}

TEST_P(PicoHostRules, TheMacReservesAPacketWithOneFrameMore) {
    const auto data = of(streaming)[1].endpoints[0];
    EXPECT_EQ(word(data, 4), (48 + 1) * 2 * channels);
    EXPECT_LE(word(data, 4), 1023) << "full speed";
    EXPECT_EQ(data[6], 1) << "one packet a millisecond";
    pico::Feedback low, high;
    for (int k = 0; k < 100; ++k) { // packets differ by a frame at most, whatever the level
        EXPECT_LE(high.next(0, 128, true), 49u << 16);
        EXPECT_GE(low.next(512, 128, true), 47u << 16);
    }
}

TEST_P(PicoHostRules, TheMacFindsControlsAndName) {
    const auto feature = entities.at(entity(outputTerminal)[7]);
    EXPECT_EQ(feature[2], featureUnit) << "the unit beside the output terminal, with volume and mute in one";
    for (const auto& s : settings)
        EXPECT_EQ(s.interface[8], 0) << "an interface's name would replace the product's";
    EXPECT_EQ(pico::deviceDescriptor(channels, "1.0")[15], 2) << "the product's name";
    EXPECT_EQ(word(entity(inputTerminal), 9), 0) << "channels are no loudspeakers";
}

} // namespace physvib::pico_usb_test
