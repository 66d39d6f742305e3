// SPDX-License-Identifier: MIT
// Accumulates minimum and maximum samples per column, block by block.
#include "Pictures/WaveformEnvelope.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {
constexpr SampleRange emptyRange{1.0f, -1.0f};
constexpr bool isEmpty(const SampleRange& r) { return r.lowest > r.highest; }
} // namespace

WaveformEnvelope::WaveformEnvelope(int channels, std::int64_t firstFrame, std::int64_t frameCount)
    : firstFrame_(firstFrame)
    , frameCount_(std::max<std::int64_t>(frameCount, 0))
    , ranges_(static_cast<std::size_t>(channels) * columns, emptyRange)
    , peaks_(static_cast<std::size_t>(channels), 0.0f) {}

void WaveformEnvelope::add(const float* const* block, int frames) {
    const std::int64_t blockStart = processedFrames_ - firstFrame_;
    processedFrames_ += frames;
    std::int64_t next = std::max<std::int64_t>(blockStart, 0);
    const std::int64_t end = std::min(blockStart + frames, frameCount_);
    while (next < end) {
        const std::int64_t column = next * columns / frameCount_;
        // the next column begins at a frame that is rounded up, so every frame has one column
        const std::int64_t runEnd = std::min(end, ((column + 1) * frameCount_ + columns - 1) / columns);
        for (int c = 0; c < channels(); ++c) addRun(c, column, block[c] + (next - blockStart), runEnd - next);
        next = runEnd;
    }
}

void WaveformEnvelope::addRun(int channel, std::int64_t column, const float* samples, std::int64_t frames) {
    const auto [low, high] = std::minmax_element(samples, samples + frames);
    auto& range = ranges_[static_cast<std::size_t>(channel * std::int64_t{columns} + column)];
    range = isEmpty(range) ? SampleRange{*low, *high}
                           : SampleRange{std::min(range.lowest, *low), std::max(range.highest, *high)};
    auto& peak = peaks_[static_cast<std::size_t>(channel)];
    peak = std::max({peak, std::abs(*low), std::abs(*high)});
}

SampleRange WaveformEnvelope::column(int channel, int index) const noexcept {
    if (index * frameCount_ / columns >= processedFrames_ - firstFrame_) return {};
    const auto lane = static_cast<std::size_t>(channel) * columns;
    for (auto i = static_cast<std::size_t>(index) + 1; i-- > 0;)
        if (!isEmpty(ranges_[lane + i])) return ranges_[lane + i];
    return {};
}

float WaveformEnvelope::peak() const noexcept {
    return peaks_.empty() ? 0.0f : *std::max_element(peaks_.begin(), peaks_.end());
}

} // namespace physvib
