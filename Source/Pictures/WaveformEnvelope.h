// SPDX-License-Identifier: MIT
// Reduces a window of sound to the minimum and maximum sample per column, for drawing.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace physvib {

/// Lowest and highest sample of one column.
struct SampleRange {
    float lowest = 0.0f;
    float highest = 0.0f;
};

/// Reduces the frames [first, first + count) of a render to `columns` columns per channel. M only.
class WaveformEnvelope {
public:
    static constexpr int columns = 1384; ///< pixels of a lane in the picture

    /// `firstFrame` may be negative: what lies before the render is silence.
    WaveformEnvelope(int channels, std::int64_t firstFrame, std::int64_t frameCount)
        : first_(firstFrame)
        , count_(std::max<std::int64_t>(frameCount, 0))
        , ranges_(static_cast<std::size_t>(channels) * columns, nothing)
        , peaks_(static_cast<std::size_t>(channels), 0.0f) {}

    /// Takes the next block of the render, from frame 0 on and without gaps; looks only at what is in the
    /// window.
    void add(const float* const* block, int frames) {
        const std::int64_t blockStart = now_ - first_;
        now_ += frames;
        std::int64_t at = std::max<std::int64_t>(blockStart, 0);
        const std::int64_t end = std::min(blockStart + frames, count_);
        while (at < end) {
            const std::int64_t column = at * columns / count_;
            const std::int64_t runEnd = std::min(end, columnStart(column + 1));
            for (int c = 0; c < channels(); ++c) addRun(c, column, block[c] + (at - blockStart), runEnd - at);
            at = runEnd;
        }
    }

    int channels() const noexcept { return static_cast<int>(peaks_.size()); }
    std::int64_t firstFrame() const noexcept { return first_; }
    std::int64_t frameCount() const noexcept { return count_; }
    /// One column; where the window has fewer frames than columns, the frame before. Silence outside the
    /// render.
    SampleRange column(int channel, int index) const noexcept {
        if (index * count_ / columns >= now_ - first_) return {};
        const auto lane = static_cast<std::size_t>(channel) * columns;
        for (auto i = static_cast<std::size_t>(index) + 1; i-- > 0;)
            if (!isNothing(ranges_[lane + i])) return ranges_[lane + i];
        return {};
    }
    /// Largest magnitude of a channel inside the window.
    float peak(int channel) const noexcept { return peaks_[static_cast<std::size_t>(channel)]; }
    /// Largest magnitude of all channels.
    float peak() const noexcept {
        return peaks_.empty() ? 0.0f : *std::max_element(peaks_.begin(), peaks_.end());
    }

private:
    static constexpr SampleRange nothing{1.0f, -1.0f};
    static constexpr bool isNothing(const SampleRange& r) { return r.lowest > r.highest; }

    // First frame of a column, counted from the window's start; rounded up, so every frame has one column.
    std::int64_t columnStart(std::int64_t column) const noexcept {
        return (column * count_ + columns - 1) / columns;
    }
    void addRun(int channel, std::int64_t column, const float* samples, std::int64_t frames) {
        const auto [low, high] = std::minmax_element(samples, samples + frames);
        auto& range = ranges_[static_cast<std::size_t>(channel * std::int64_t{columns} + column)];
        range = isNothing(range) ? SampleRange{*low, *high}
                                 : SampleRange{std::min(range.lowest, *low), std::max(range.highest, *high)};
        auto& peak = peaks_[static_cast<std::size_t>(channel)];
        peak = std::max({peak, std::abs(*low), std::abs(*high)});
    }

    std::int64_t first_;
    std::int64_t count_;
    std::int64_t now_ = 0;            // frames taken so far
    std::vector<SampleRange> ranges_; // channel by channel; lowest > highest: nothing there yet
    std::vector<float> peaks_;
};

} // namespace physvib
