// SPDX-License-Identifier: MIT
// Protection stage before the actuators: a gain per channel that keeps its mean over 250 ms, and its content
// below 5 Hz, within limits::guardShare of full scale, whatever was summed. Neither is felt, and both only
// warm a coil.
//
// It decides at the ends of tiles of a third of a millisecond on an absolute grid of whole frames, so samples
// do not depend on block sizes. While the gain is 1, samples stay unchanged. Rule: GuardLaw.
#pragma once
#include "Core/Actuators/GuardLaw.h"
#include <cmath>
#include <cstdint>
#include <limits>

namespace physvib {

/// Render thread (R) only; prepare: message thread (M).
class OutputGuard {
public:
    /// Resets the sums. M, not while rendering.
    void prepare(int sampleRateHz, int channels, GuardPlace place) noexcept {
        channels_ = static_cast<std::size_t>(channels);
        law_.prepare(channels, place);
        sums_.fill(0);
        acts_ = hasSums_ = false;
        changeRate(sampleRateHz);
    }
    /// Changes the sample rate and keeps the sums. M, not while rendering.
    void changeRate(int sampleRateHz) noexcept {
        if (hasSums_) endTile();
        tile_ = std::max(1, static_cast<int>(std::lround(sampleRateHz * tileSeconds)));
        law_.setTile(static_cast<float>(tile_) / static_cast<float>(sampleRateHz));
        perUnit_ = 1.0f / (unit * static_cast<float>(sampleRateHz));
        filled_ = 0;
    }

    /// M, not while rendering.
    GuardSums sums(std::size_t channel) noexcept {
        if (hasSums_) endTile();
        return law_.sums(channel);
    }
    /// Goes on with these, one per channel. M, after prepare().
    void recall(const GuardSums* sums) noexcept {
        for (std::size_t j = 0; j < channels_; ++j) law_.recall(j, sums[j]);
        for (int k = 0; k < 2; ++k) acts_ = law_.take({}); // both ends of the next tile's ramp
    }
    std::size_t channels() const noexcept { return channels_; }
    /// One channel more, at rest. R.
    void widen() noexcept { law_.widen(), ++channels_; }

    /// Sets the absolute number of the next frame. Tiles lie on the grid of these numbers, so that samples do
    /// not depend on the output latency. Without it the grid starts at prepare. R.
    void moveTo(std::int64_t frame) noexcept {
        const auto at = static_cast<int>((frame % tile_ + tile_) % tile_);
        if (at != filled_ && hasSums_) endTile();
        filled_ = at;
    }

    /// In place: io[channel][0..frames), finite, up to 8 times full scale; null: a channel without output.
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

    float gain() const noexcept { return law_.gain(); } ///< lowest of all channels; 1: no reduction
    std::uint32_t episodes() const noexcept {
        return law_.episodes();
    } ///< how often it began to act, since prepare

private:
    static constexpr double tileSeconds = 1.0 / 3000.0;
    static constexpr float unit = 2097152.0f; // 2^21 is full scale: 64 frames of 8 times full scale fit 32
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
