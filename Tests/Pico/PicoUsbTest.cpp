// SPDX-License-Identifier: MIT
// What a USB host sees of the Pico: descriptors that hold together, volume and mute, feedback that keeps the
// buffer, the serial port's text, the LED.
#include "Console.h"
#include "HostClock.h"
#include "Signal/Descriptors.h"
#include "Signal/Indicator.h"
#include "Streams.h"
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <string>

namespace physvib {
namespace {

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
    EXPECT_EQ(pico::gainOfVolume(0), pico::unity);
    EXPECT_NEAR(pico::gainOfVolume(-6 * 256), 0.50119 * pico::unity, 1.0);
    EXPECT_NEAR(pico::gainOfVolume(-60 * 256), 0.001 * pico::unity, 1.0);
    EXPECT_EQ(pico::gainOfVolume(-120 * 256), 0);
    pico::AudioControls<4> controls;
    const auto set = [&](std::uint8_t control, std::uint8_t channel, int value, int bytes) {
        const std::uint8_t data[] = {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)};
        return controls.set(pico::unitVolume, 1, control, channel, data, static_cast<std::uint16_t>(bytes));
    };
    EXPECT_TRUE(set(pico::audio_request::volume, 2, -12 * 256, 2));
    EXPECT_TRUE(set(pico::audio_request::volume, 0, -6 * 256, 2));
    EXPECT_EQ(controls.gain(1), pico::gainOfVolume(-18 * 256));
    EXPECT_EQ(controls.gain(0), pico::gainOfVolume(-6 * 256));
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
        again.restore(controls.kept());
        EXPECT_LE(again.gain(1), controls.gain(1)) << volume;
        EXPECT_GE(again.gain(1) + 1, controls.gain(1) * 0.94) << volume << ": half a decibel at most";
        EXPECT_EQ(again.gain(2), controls.gain(2)) << "mute";
        EXPECT_EQ(again.kept(), controls.kept());
    }
    pico::AudioControls<4> torn;
    torn.restore({0x7f, 0, 0xff, 0, 0});
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
    const pico::Console::Facts facts{8, "E661", true, 32767, 1, 2, 8, 3, 4, 5, 6, 7};
    const auto ask = [&](const std::string& line) {
        bool isDue = false;
        for (const char c : line) EXPECT_FALSE(console.take(c));
        isDue = console.take('\n');
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
    EXPECT_EQ(indicator.see(0, false, 0, 0), Light::waiting);
    EXPECT_EQ(indicator.see(1, true, 0, 0), Light::playing);
    EXPECT_EQ(indicator.see(2, true, 1, 0), Light::limiting);
    EXPECT_EQ(indicator.see(2 + second, true, 1, 0), Light::playing);
    EXPECT_EQ(indicator.see(2 + second, true, 1, 1), Light::fault);
    EXPECT_EQ(indicator.see(2 + 6 * second, true, 1, 1), Light::playing);
    const auto flashes = [](Light light) { // in six seconds
        int count = 0;
        for (std::uint32_t t = 1; t < 6 * second; ++t)
            count += pico::Indicator::isOn(light, t) && !pico::Indicator::isOn(light, t - 1) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(flashes(Light::playing), 0);
    EXPECT_EQ(flashes(Light::waiting), 2);
    EXPECT_EQ(flashes(Light::limiting), 47);
    EXPECT_EQ(flashes(Light::fault), 11);
}

} // namespace
} // namespace physvib
