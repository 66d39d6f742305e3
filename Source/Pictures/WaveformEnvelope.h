// SPDX-License-Identifier: MIT
// Reduces a window of sound to the minimum and maximum sample per column, for drawing.
#pragma once
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
    WaveformEnvelope(int channels, std::int64_t firstFrame, std::int64_t frameCount);

    /// Adds the next block of the render, from frame 0 on without gaps; only the window is kept.
    void add(const float* const* block, int frames);

    int channels() const noexcept { return static_cast<int>(peaks_.size()); }
    std::int64_t firstFrame() const noexcept { return firstFrame_; }
    std::int64_t frameCount() const noexcept { return frameCount_; }
    /// One column; one without a frame repeats the column before. Outside the render: silence.
    SampleRange column(int channel, int index) const noexcept;
    /// Largest magnitude of a channel inside the window.
    float peak(int channel) const noexcept { return peaks_[static_cast<std::size_t>(channel)]; }
    /// Largest magnitude of all channels.
    float peak() const noexcept;

private:
    void addRun(int channel, std::int64_t column, const float* samples, std::int64_t frames);

    std::int64_t firstFrame_;
    std::int64_t frameCount_;
    std::int64_t processedFrames_ = 0; // frames added so far
    std::vector<SampleRange> ranges_;  // channel by channel; lowest > highest: no frame yet
    std::vector<float> peaks_;
};

} // namespace physvib
