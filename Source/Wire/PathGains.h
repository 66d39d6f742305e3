// SPDX-License-Identifier: MIT
// Computes the gains of a moving tone at any time exactly as the computer's renderer does, so that a board
// can use the same.
//
// That renderer evaluates the panning law at the ends of each tile of its frames and interpolates linearly
// (Core/Voices.h).
#pragma once
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace physvib {

/// Of one event, in a session rendered at one rate. One thread.
class PathGains {
public:
    using Gains = std::array<double, limits::board::channels>;

    PathGains(const CollisionEvent& moving, std::int64_t lifeNs, int sampleRateHz) noexcept
        : moving_{moving}
        , rate_{static_cast<double>(sampleRateHz)}
        , onset_{FrameClock{sampleRateHz}.at(moving.timeNs)}
        , endFrame_{FrameClock{sampleRateHz}.at(moving.timeNs + lifeNs).frame - onset_.frame} {}

    /// `seconds` after the onset. `gainsAt(event)` returns the panner's Gains.
    template <class GainsAt>
    Gains at(double seconds, GainsAt& gainsAt) noexcept {
        constexpr std::int64_t tile = limits::tileFrames;
        // frames here count from the onset's frame
        const double frame = std::max(0.0, seconds * rate_ - onset_.leadFrames);
        const std::int64_t before = onset_.frame % tile;
        const std::int64_t first = (static_cast<std::int64_t>(frame) + before) / tile * tile - before;
        enter(std::max<std::int64_t>(first, 0), std::min(first + tile, endFrame_), gainsAt);
        const double share =
            to_ > from_ ? (frame - static_cast<double>(from_)) / static_cast<double>(to_ - from_) : 0.0;
        Gains gains;
        for (std::size_t j = 0; j < gains.size(); ++j)
            gains[j] = std::lerp(fromGains_[j], toGains_[j], share);
        return gains;
    }

private:
    template <class GainsAt>
    void enter(std::int64_t from, std::int64_t to, GainsAt& gainsAt) noexcept {
        if (from == from_) return;
        from_ = from, to_ = to;
        fromGains_ = gainsThen(from, gainsAt);
        toGains_ = gainsThen(to, gainsAt);
    }

    template <class GainsAt>
    Gains gainsThen(std::int64_t frame, GainsAt& gainsAt) const noexcept {
        const double ageNs = (static_cast<double>(frame) + onset_.leadFrames) / rate_ * 1e9;
        const double share = std::min(1.0, ageNs / static_cast<double>(moving_.course.travelNs));
        return gainsAt(movedAlong(moving_, share));
    }

    CollisionEvent moving_;
    double rate_;
    FramePosition onset_;
    std::int64_t endFrame_;
    std::int64_t from_ = -1, to_ = 0; // of the current tile
    Gains fromGains_{}, toGains_{};
};

} // namespace physvib
