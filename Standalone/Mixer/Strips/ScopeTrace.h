// SPDX-License-Identifier: GPL-3.0-or-later
// Ring buffer of recent samples of every channel, as minimum and maximum of each scope column.
#pragma once
#include "Core/Limits.h"
#include "Pictures/WaveformEnvelope.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace physvib {

/// Message thread only.
class ScopeTrace {
public:
    static constexpr int columns = 800;
    static constexpr double seconds = 1.0;

    ScopeTrace() { clear(); }

    /// Restarts the current column.
    void setRate(int sampleRateHz) {
        framesPerColumn_ = std::max(1, static_cast<int>(seconds * sampleRateHz / columns));
        filled_ = 0;
    }
    void clear() {
        for (auto& lane : lanes_) lane.assign(columns, {});
        newest_ = 0;
        filled_ = 0;
        begun_ = 0;
    }

    /// Appends frames of the first `heard` channels.
    void add(const float* const* channels, int heard, int frames) {
        for (int done = 0; done < frames;) {
            const int part = std::min(frames - done, framesPerColumn_ - filled_);
            for (int j = 0; j < heard; ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = lanes_[static_cast<std::size_t>(j)][static_cast<std::size_t>(newest_)];
                column = filled_ == 0
                             ? SampleRange{*low, *high}
                             : SampleRange{std::min(column.lowest, *low), std::max(column.highest, *high)};
            }
            done += part;
            filled_ += part;
            if (filled_ < framesPerColumn_) continue;
            filled_ = 0;
            newest_ = (newest_ + 1) % columns;
            ++begun_;
        }
    }

    /// Column `index` of a channel; 0 is the oldest.
    SampleRange at(int channel, int index) const {
        return lanes_[static_cast<std::size_t>(channel)]
                     [static_cast<std::size_t>((newest_ + 1 + index) % columns)];
    }

    /// What a trace of so many pixels has at pixel `x`: all of its columns, and the way from the pixel
    /// before.
    SampleRange shown(int channel, int x, int width) const {
        const auto columnOf = [width](int pixel) { return pixel * (columns - 1) / std::max(1, width); };
        const int first = columnOf(x), last = std::max(first, columnOf(x + 1) - 1);
        SampleRange range = at(channel, first);
        const auto take = [&range](float low, float high) {
            range = {std::min(range.lowest, low), std::max(range.highest, high)};
        };
        for (int k = first + 1; k <= last; ++k) take(at(channel, k).lowest, at(channel, k).highest);
        if (first == 0 || columnOf(x - 1) == first) return range;
        const SampleRange before = at(channel, first - 1);
        take(before.highest, before.lowest); // only what lies between
        return range;
    }

    /// Number of columns begun so far.
    std::int64_t columnsBegun() const noexcept { return begun_; }

private:
    std::array<std::vector<SampleRange>, limits::maxEnchanters> lanes_;
    int framesPerColumn_ = 60, newest_ = 0, filled_ = 0;
    std::int64_t begun_ = 0;
};

} // namespace physvib
