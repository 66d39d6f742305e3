// SPDX-License-Identifier: MIT
// The descriptors follow what Windows and macOS ask of a USB sound card beyond the standards, by their
// documents: Microsoft's "USB Audio 2.0 drivers" (usbaudio2.sys) and Apple's TN2274, "USB Audio on the Mac".
// Neither system was tried.
#include "Signal/Descriptors.h"
#include "Signal/FrameBuffer.h"
#include <gtest/gtest.h>
#include <map>
#include <vector>

namespace physvib {
namespace {

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
            if (d[1] == pico::descriptor::ofInterface) settings.back().own.push_back(d);
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

} // namespace
} // namespace physvib
