// SPDX-License-Identifier: MIT
#include "Pictures/WaveformEnvelope.h"
#include "Pictures/PictureParts.h"
#include "Pictures/RenderPicture.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

namespace physvib::waveform_envelope_test {

constexpr int columns = WaveformEnvelope::columns;

// A render whose sample n is n.
void addCount(WaveformEnvelope& envelope, int frames, int blockFrames) {
    for (int start = 0; start < frames; start += blockFrames) {
        std::vector<float> block;
        for (int n = start; n < std::min(start + blockFrames, frames); ++n)
            block.push_back(static_cast<float>(n));
        const float* channel = block.data();
        envelope.add(&channel, static_cast<int>(block.size()));
    }
}

TEST(WaveformEnvelope, EveryFrameIsInOneColumn) {
    for (const int frames : {columns, columns + 1, 3 * columns - 1, 100000}) {
        WaveformEnvelope envelope(1, 0, frames);
        addCount(envelope, frames, 100);
        EXPECT_EQ(envelope.column(0, 0).lowest, 0.0f);
        for (int i = 1; i < columns; ++i)
            ASSERT_EQ(envelope.column(0, i).lowest, envelope.column(0, i - 1).highest + 1.0f) << i;
        EXPECT_EQ(envelope.column(0, columns - 1).highest, static_cast<float>(frames - 1));
        EXPECT_EQ(envelope.peak(0), static_cast<float>(frames - 1));
    }
}

TEST(WaveformEnvelope, APeakMayBeBelowZero) {
    WaveformEnvelope envelope(1, 0, 100);
    const std::vector<float> samples{0.25f, -0.75f, 0.5f};
    const float* channel = samples.data();
    envelope.add(&channel, 3);
    EXPECT_EQ(envelope.peak(), 0.75f);
}

TEST(WaveformEnvelope, DoesNotDependOnTheBlocks) {
    WaveformEnvelope one(1, 50, 20000), other(1, 50, 20000);
    addCount(one, 30000, 1);
    addCount(other, 30000, 777);
    for (int i = 0; i < columns; ++i) {
        ASSERT_EQ(one.column(0, i).lowest, other.column(0, i).lowest);
        ASSERT_EQ(one.column(0, i).highest, other.column(0, i).highest);
    }
}

TEST(WaveformEnvelope, SeesItsWindowOnly) {
    WaveformEnvelope envelope(1, 1000, 2 * columns);
    addCount(envelope, 100000, 4096);
    EXPECT_EQ(envelope.column(0, 0).lowest, 1000.0f);
    EXPECT_EQ(envelope.column(0, columns - 1).highest, 1000.0f + 2 * columns - 1);
    EXPECT_EQ(envelope.peak(), 1000.0f + 2 * columns - 1);
}

TEST(WaveformEnvelope, IsSilentOutsideTheRender) {
    WaveformEnvelope envelope(1, -columns,
                              3 * columns); // 3 frames a column, the first third before the render
    const std::vector<float> ones(columns, 1.0f);
    const float* channel = ones.data();
    envelope.add(&channel, columns);
    EXPECT_EQ(envelope.column(0, 0).highest, 0.0f);
    EXPECT_EQ(envelope.column(0, columns / 2).highest, 1.0f);
    EXPECT_EQ(envelope.column(0, columns / 2).lowest, 1.0f);
    EXPECT_EQ(envelope.column(0, columns - 1).highest, 0.0f);
}

TEST(WaveformEnvelope, HoldsAFrameThatIsWiderThanAColumn) {
    WaveformEnvelope envelope(1, 0, 2);
    const float frames[] = {0.5f, -0.25f};
    const float* channel = frames;
    envelope.add(&channel, 2);
    EXPECT_EQ(envelope.column(0, columns / 2 - 1).highest, 0.5f);
    EXPECT_EQ(envelope.column(0, columns - 1).lowest, -0.25f);
}

TEST(WaveformEnvelope, KeepsChannelsApart) {
    WaveformEnvelope envelope(2, 0, columns);
    const std::vector<float> loud(columns, -0.5f), quiet(columns, 0.125f);
    const float* block[] = {loud.data(), quiet.data()};
    envelope.add(block, columns);
    EXPECT_EQ(envelope.peak(0), 0.5f);
    EXPECT_EQ(envelope.peak(1), 0.125f);
    EXPECT_EQ(envelope.peak(), 0.5f);
    EXPECT_EQ(envelope.column(1, 7).lowest, 0.125f);
}

TEST(WaveformEnvelope, APeakIsOfEitherSign) {
    WaveformEnvelope half(1, 0, 2 * columns); // two frames a column, one of either sign
    std::vector<float> turns(2 * columns);
    for (std::size_t n = 0; n < turns.size(); ++n) turns[n] = n % 2 == 0 ? -0.25f : 0.125f;
    const float* pair[] = {turns.data()};
    half.add(pair, 2 * columns);
    EXPECT_EQ(half.peak(), 0.25f);
}

TEST(WaveformEnvelope, NoFramesAreSilence) {
    WaveformEnvelope envelope(1, 0, 0);
    addCount(envelope, 10, 5);
    EXPECT_EQ(envelope.peak(), 0.0f);
    EXPECT_EQ(envelope.column(0, 0).highest, 0.0f);
}

// What channels are called, on both sides of each number at which letters, numbers and names change.

TEST(ChannelLabels, AreLettersAsLongAsThereAreSomeThenNumbersAndAlwaysDifferent) {
    for (const int count : {1, 2, 25, 26, 27, 28, 63, 64}) {
        PictureInput input;
        input.layout.count = count;
        std::set<std::string> labels;
        for (int j = 0; j < count; ++j) {
            const std::string label = picture::actuatorLabel(input, j);
            EXPECT_EQ(label, count <= 26 ? std::string(1, static_cast<char>('A' + j)) : std::to_string(j + 1))
                << j << " of " << count;
            labels.insert(label);
        }
        EXPECT_EQ(static_cast<int>(labels.size()), count);
    }
}

TEST(ChannelLabels, NamesOfTheirOwnComeFirst) {
    for (const std::size_t named : {0U, 1U, 3U, 4U}) {
        PictureInput input;
        input.layout.count = 4;
        std::vector<std::string> names{"one", "two", "three", "four"};
        names.resize(named);
        input.labels = names;
        for (std::size_t j = 0; j < 4; ++j)
            EXPECT_EQ(picture::actuatorLabel(input, static_cast<int>(j)),
                      j < named ? names[j] : std::string(1, static_cast<char>('A' + j)));
    }
}

} // namespace physvib::waveform_envelope_test
