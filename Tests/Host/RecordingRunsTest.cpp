// SPDX-License-Identifier: GPL-3.0-or-later
// The judge of the recordings is judged: it finds each kind of break, and none where there is none.
#include "Live/RecordingRuns.h"
#include "Support/ClosedForm.h"
#include <gtest/gtest.h>

namespace physvib::test {
namespace {

constexpr int block = 64, channels = 2;

Recording noise(int frames) {
    Random random{5};
    Recording s{{}, channels};
    for (int i = 0; i < frames * channels; ++i)
        s.samples.push_back(static_cast<float>(random.uniform(-1, 1)));
    return s;
}

/// What a recorder gets that starts `early` frames before the render does: silence, then the render.
Recording recorded(const Recording& render, int early) {
    Recording s{std::vector<float>(static_cast<std::size_t>(early * channels), 0.0f), channels};
    s.samples.insert(s.samples.end(), render.samples.begin(), render.samples.end());
    return s;
}

auto at(Recording& s, int blockIndex) { return s.samples.begin() + blockIndex * block * channels; }

TEST(RecordingRuns, ALaterCopyIsOneRunOfEqualBlocks) {
    const auto render = noise(100 * block), recording = recorded(render, 3 * block + 17);
    const auto result = RecordingRuns{recording, render, block}.compare();
    ASSERT_TRUE(result.isAligned);
    EXPECT_EQ(result.offset, 3 * block + 17);
    EXPECT_EQ(result.blocks, 103);
    EXPECT_EQ(result.equal, 103);
    EXPECT_TRUE(result.breaks.empty());
}

TEST(RecordingRuns, BlocksLeftOutAreSkips) {
    const auto render = noise(100 * block);
    auto recording = recorded(render, 17);
    recording.samples.erase(at(recording, 50), at(recording, 53));
    recording.samples.erase(at(recording, 70), at(recording, 71));
    const auto result = RecordingRuns{recording, render, block}.compare();
    ASSERT_EQ(result.breaks.size(), 2u);
    EXPECT_EQ(result.breaks[0].frame, 50 * block);
    EXPECT_EQ(result.breaks[0].skipped, 3);
    EXPECT_EQ(result.breaks[1].skipped, 1);
    EXPECT_EQ(result.equal, result.blocks);
}

TEST(RecordingRuns, BlankTornAndRepeatedBlocksAreOneBreakEach) {
    const auto render = noise(100 * block);
    auto recording = recorded(render, 17);
    std::fill(at(recording, 20), at(recording, 21), 0.0f); // blank
    at(recording, 40)[30] += 0.5f;                         // torn
    // repeated, then goes on
    recording.samples.insert(at(recording, 60), at(recording, 59), at(recording, 60));
    const auto result = RecordingRuns{recording, render, block}.compare();
    ASSERT_EQ(result.breaks.size(), 3u);
    EXPECT_EQ(result.breaks[0].foreign, 1);
    EXPECT_EQ(result.breaks[1].foreign, 1);
    EXPECT_EQ(result.breaks[2].skipped, -1);
    EXPECT_EQ(result.equal, result.blocks - 2);
}

TEST(RecordingRuns, AnotherSignalIsNotAligned) {
    const auto render = noise(100 * block);
    auto other = render;
    for (float& x : other.samples) x *= 0.5f;
    EXPECT_FALSE((RecordingRuns{other, render, block}.compare().isAligned));
}

} // namespace
} // namespace physvib::test
