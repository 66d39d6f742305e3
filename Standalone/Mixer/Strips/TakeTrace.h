// SPDX-License-Identifier: GPL-3.0-or-later
// Waveform of a whole scene run, as minimum and maximum of each column over the scene's time.
#pragma once
#include "Core/Limits.h"
#include "Pictures/WaveformEnvelope.h"
#include <algorithm>
#include <array>
#include <vector>

namespace physvib {

/// When the columns are full, their duration doubles. Message thread only.
class TakeTrace {
public:
    static constexpr std::size_t columns = 1024;
    static constexpr double firstSeconds = 0.01; ///< initial duration of a column

    TakeTrace() { begin(0); }

    /// Starts another scene run.
    void begin(std::size_t take) {
        take_ = take;
        columnSeconds_ = firstSeconds;
        seconds_ = 0.0;
        for (auto& lane : lanes_) lane.assign(columns, {});
    }
    std::size_t take() const noexcept { return take_; }

    /// Sets the scene time of the frames that follow.
    void moveTo(double seconds) { seconds_ = std::max(0.0, seconds); }

    /// Appends frames of the first `heard` channels, which last `sceneSeconds` of scene time.
    void add(const float* const* channels, int heard, int frames, double sceneSeconds) {
        for (int done = 0; done < frames;) {
            while (seconds_ >= columnSeconds_ * static_cast<double>(columns)) widen();
            const double perFrame = sceneSeconds / frames;
            const int part = perFrame > 0.0
                                 ? std::clamp(static_cast<int>(columnSeconds_ / perFrame), 1, frames - done)
                                 : frames - done;
            const auto at = static_cast<std::size_t>(seconds_ / columnSeconds_);
            for (std::size_t j = 0; j < static_cast<std::size_t>(heard); ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = lanes_[j][at];
                column = {std::min(column.lowest, *low), std::max(column.highest, *high)};
            }
            done += part;
            seconds_ += part * perFrame;
        }
    }

    double seconds() const noexcept { return seconds_; } ///< scene time so far

    /// Minimum and maximum over the columns of [from, to).
    SampleRange range(int channel, double from, double to) const {
        SampleRange all;
        const auto first = static_cast<std::size_t>(std::max(0.0, from / columnSeconds_));
        for (std::size_t i = first;
             i < columns && (i == first || static_cast<double>(i) * columnSeconds_ < to); ++i) {
            const SampleRange& column = lanes_[static_cast<std::size_t>(channel)][i];
            all = {std::min(all.lowest, column.lowest), std::max(all.highest, column.highest)};
        }
        return all;
    }

private:
    void widen() {
        columnSeconds_ *= 2.0;
        for (auto& lane : lanes_) {
            for (std::size_t i = 0; i < columns / 2; ++i)
                lane[i] = {std::min(lane[2 * i].lowest, lane[2 * i + 1].lowest),
                           std::max(lane[2 * i].highest, lane[2 * i + 1].highest)};
            std::fill(lane.begin() + columns / 2, lane.end(), SampleRange{});
        }
    }

    std::array<std::vector<SampleRange>, limits::maxEnchanters> lanes_;
    std::size_t take_ = 0;
    double columnSeconds_ = firstSeconds, seconds_ = 0.0;
};

} // namespace physvib
