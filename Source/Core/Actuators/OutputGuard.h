// SPDX-License-Identifier: MIT
// The last stage before an actuator: a gain per channel that keeps its mean over 250 ms, and what lies below
// 5 Hz, within limits::guardShare of full scale, whatever was summed. Nobody feels either, and a coil grows
// warm of it.
//
// It decides at the ends of tiles of a third of a millisecond, on a grid from the first frame on, of whole
// numbers: the samples do not depend on the blocks. Where the law leaves the gain at 1, a sample stays as it
// is. How: GuardLaw.
#pragma once
#include "Core/Actuators/GuardLaw.h"
#include <cmath>
#include <cstdint>
#include <limits>

namespace physvib {

/// R only, but for prepare: M.
class OutputGuard {
public:
    /// Nothing has left. M, not while rendering.
    void prepare(int sampleRateHz, int channels, GuardPlace place) noexcept {
        channels_ = static_cast<std::size_t>(channels);
        law_.prepare(channels, place);
        changeRate(sampleRateHz);
    }
    /// What has left stays known. M, not while rendering.
    void changeRate(int sampleRateHz) noexcept {
        tile_ = std::max(1, static_cast<int>(std::lround(sampleRateHz * tileSeconds)));
        law_.setTile(static_cast<float>(tile_) / static_cast<float>(sampleRateHz));
        perUnit_ = 1.0f / (unit * static_cast<float>(sampleRateHz));
        filled_ = 0;
        sums_.fill(0);
        acts_ = hasSums_ = false;
    }

    /// Which frame process() gets next: tiles lie on the grid of these, so that samples do not depend on the
    /// output latency either. Without it they lie on the grid of the frames since prepare. R.
    void moveTo(std::int64_t frame) noexcept {
        const auto at = static_cast<int>((frame % tile_ + tile_) % tile_);
        if (at != filled_ && hasSums_) endTile();
        filled_ = at;
    }

    /// In place: io[channel][0..frames), finite, up to 8 times full scale; null: nothing leaves there.
    /// `isSilent`: all of it is 0.
    void process(float* const* io, int frames, bool isSilent = false) noexcept {
        if (isSilent && !hasSums_ && law_.isAtRest()) {
            filled_ = (filled_ + frames) % tile_;
            return;
        }
        for (int first = 0, count; first < frames; first += count) {
            count = std::min(frames - first, tile_ - filled_);
            if (!isSilent) pass(io, first, count);
            filled_ += count;
            if (filled_ == tile_) endTile();
        }
    }

    float gain() const noexcept { return law_.gain(); } ///< the least of all channels; 1: it does nothing
    std::uint32_t episodes() const noexcept {
        return law_.episodes();
    } ///< how often it began to act, since prepare

private:
    static constexpr double tileSeconds = 1.0 / 3000.0;
    static constexpr float unit = 2097152.0f; // 2^21 are full scale: 64 frames of 8 times that stay within 32
                                              // bits
    static constexpr auto width = static_cast<std::size_t>(limits::maxEnchanters);

    void pass(float* const* io, int first, int count) noexcept {
        hasSums_ = true;
        for (std::size_t j = 0; j < channels_; ++j) {
            if (io[j] == nullptr) continue;
            float* const at = io[j] + first;
            if (acts_ && (law_.from(j) != 1.0f || law_.to(j) != 1.0f)) turnDown(j, at, count);
            std::int32_t sum = 0;
            for (int k = 0; k < count; ++k)
                sum += static_cast<std::int32_t>(std::min(std::max(at[k], -8.0f), 8.0f) * unit);
            sums_[j] += sum;
        }
    }
    void turnDown(std::size_t j, float* at, int count) noexcept {
        const float step = (law_.to(j) - law_.from(j)) / static_cast<float>(tile_);
        for (int k = 0; k < count; ++k) {
            const float y = at[k] * (law_.from(j) + step * static_cast<float>(filled_ + k + 1));
            at[k] = std::abs(y) < std::numeric_limits<float>::min() ? 0.0f : y;
        }
    }
    void endTile() noexcept {
        GuardLaw<limits::maxEnchanters>::Row areas;
        for (std::size_t j = 0; j < channels_; ++j)
            areas[j] = static_cast<float>(sums_[j]) * perUnit_, sums_[j] = 0;
        acts_ = law_.take(areas);
        filled_ = 0;
        hasSums_ = false;
    }

    GuardLaw<limits::maxEnchanters> law_;
    std::array<std::int32_t, width> sums_{};
    std::size_t channels_ = 0;
    int tile_ = 1, filled_ = 0;
    float perUnit_ = 1.0f;
    bool acts_ = false, hasSums_ = false;
};

} // namespace physvib
