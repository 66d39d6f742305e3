// SPDX-License-Identifier: GPL-3.0-or-later
// Delays incoming music by the play-out latency, so that it reaches the renderer together with the events.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/EnchanterLayout.h"
#include "Live/Session/CallbackInputs.h"
#include <array>
#include <cstdint>
#include <vector>

namespace physvib {

/// Of one take: left and right by the renderer's frames, and what each actuator gets of them by its place:
/// all of the left at the layout's left edge, all of the right at its right edge, a line between.
class MusicDelay final : public AddedSamples {
public:
    /// `channels` at least as many as the layout has; nothing older than `longestFrames` is asked for. Any
    /// thread but R.
    MusicDelay(const EnchanterLayout& layout, int channels, int sampleRateHz, std::int64_t longestFrames);

    /// As at first. Any thread but R, while nobody renders.
    void reset() noexcept;

    /// What is heard from the renderer's frame `at` on; what lies between that and the last is silence. R,
    /// wait-free.
    void write(std::int64_t at, const float* left, const float* right, int frames) noexcept;

    /// Frames from `from` to `until`, and for at least `shortestPauseSeconds`, are not played, with ramps of
    /// 10 ms. R, wait-free.
    void silence(std::int64_t from, std::int64_t until) noexcept;
    static constexpr double shortestPauseSeconds = 0.05; // longer than both ramps: it is felt

    /// Where a take has ended, the last sample falls to zero within 10 ms. R, wait-free.
    const float* const* at(std::int64_t frame, int frames) noexcept override;

private:
    struct Pair {
        float left = 0.0f, right = 0.0f;
    };
    Pair& of(std::int64_t frame) noexcept {
        return ring_[static_cast<std::size_t>(frame % static_cast<std::int64_t>(ring_.size()))];
    }
    bool read(std::int64_t frame, int frames) noexcept;

    const int sampleRateHz_;
    std::vector<Pair> ring_;
    std::vector<float> rightShare_, samples_; // per channel; [channel][frame of a tile]
    std::vector<const float*> channels_;
    std::array<Pair, static_cast<std::size_t>(limits::tileFrames)> tile_{};
    Pair last_;
    GainRamp open_;
    std::int64_t end_ = 0, silentFrom_ = 0, silentUntil_ = 0;
};

} // namespace physvib
