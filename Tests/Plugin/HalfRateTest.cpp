// SPDX-License-Identifier: GPL-3.0-or-later
// Hosts at 8 to 384 kHz are not silent; above 192 kHz what is played is that of half the rate, at the latency
// that is told, in blocks of any size.
#include "PluginTesting.h"

namespace physvib {
namespace {

using namespace test;

constexpr int noteFrame = 9000;

/// A key at that frame of 384 kHz, in blocks of any size.
Samples keyAt(double rate, int frame, const std::vector<int>& blocks, std::int64_t length,
              int* latency = nullptr) {
    PluginProcessor plugin{"PhysVib", {}};
    plugin.setNonRealtime(true);
    const int largest = std::ranges::max(blocks);
    plugin.setRateAndBufferSizeDetails(rate, largest);
    plugin.prepareToPlay(rate, largest);
    if (latency) *latency = plugin.getLatencySamples();
    juce::AudioBuffer<float> buffer{
        std::max(plugin.getTotalNumInputChannels(), plugin.getTotalNumOutputChannels()), largest};
    Samples signal(4);
    for (std::int64_t done = 0, b = 0; done < length; ++b) {
        const int frames = blocks[static_cast<std::size_t>(b) % blocks.size()];
        buffer.setSize(buffer.getNumChannels(), frames, false, false, true);
        buffer.clear();
        juce::MidiBuffer midi;
        if (frame >= done && frame < done + frames)
            midi.addEvent(juce::MidiMessage::noteOn(1, 45, juce::uint8{127}), static_cast<int>(frame - done));
        plugin.processBlock(buffer, midi);
        for (int c = 0; c < 4; ++c)
            signal[static_cast<std::size_t>(c)].insert(signal[static_cast<std::size_t>(c)].end(),
                                                       buffer.getReadPointer(c),
                                                       buffer.getReadPointer(c) + frames);
        done += frames;
    }
    for (auto& c : signal) c.resize(static_cast<std::size_t>(length));
    return signal;
}

TEST(HalfRate, From8To384KilohertzAKeyIsFelt) {
    for (const double rate :
         {8000.0, 22050.0, 44100.0, 48000.0, 88200.0, 96000.0, 176400.0, 192000.0, 352800.0, 384000.0})
        EXPECT_NEAR(peakOf(keyAt(rate, 10, {512}, static_cast<std::int64_t>(rate / 5))), 0.5f, 0.05f) << rate;
}

TEST(HalfRate, IsHalfTheRatesSamplesAndTheirMeansAtTheToldLatency) {
    int slowLatency = 0, latency = 0;
    const auto slow = keyAt(192000.0, noteFrame / 2, {256}, 30000, &slowLatency);
    const auto fast = keyAt(384000.0, noteFrame, {512}, 60000, &latency);
    EXPECT_EQ(latency, 2 * slowLatency + 1);
    for (std::size_t n = 1; n < 30000; ++n) {
        ASSERT_EQ(fast[0][2 * n], 0.5f * (slow[0][n - 1] + slow[0][n])) << n;
        if (2 * n + 1 < fast[0].size()) ASSERT_EQ(fast[0][2 * n + 1], slow[0][n]) << n;
    }
    EXPECT_EQ(fast[0][static_cast<std::size_t>(noteFrame + latency - 2)], 0.0f);
    EXPECT_NE(fast[0][static_cast<std::size_t>(noteFrame + latency + 2)], 0.0f) << "a sine begins with 0";
}

TEST(HalfRate, BlocksOfAnySizeAreTheSame) {
    const auto expected = keyAt(384000.0, noteFrame, {512}, 60000);
    for (const auto& blocks : std::vector<std::vector<int>>{{64}, {2048}, {8192}, {1, 2, 511}, {7}, {333, 1}})
        EXPECT_TRUE(keyAt(384000.0, noteFrame, blocks, 60000) == expected) << blocks.front();
}

} // namespace
} // namespace physvib
