// SPDX-License-Identifier: MIT
// Sliding minimum, linear release, moving average, delayed multiply.
#include "Core/LinkedLimiter.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace physvib {

template <class P>
void LinkedLimiter<P>::prepare(int sampleRateHz, int channels, bool enabled) noexcept {
    channels_ = channels;
    enabled_ = enabled;
    window_ = windowAt(sampleRateHz);
    releaseStep_ = static_cast<std::int64_t>(unit / (sampleRateHz * limits::limiterReleaseSeconds));
    ceilings_.fill(1.0f);
    delayed_ = {};
    position_ = 0;
    frame_ = 0;
    front_ = candidateCount_ = 0;
    released_ = unit;
    averaged_.fill(unit);
    sum_ = unit * window_;
    gain_ = 1.0f;
    nonFinite_ = 0;
}

template <class P>
int LinkedLimiter<P>::windowAt(int sampleRateHz) noexcept {
    return std::clamp(static_cast<int>(sampleRateHz * limits::limiterLookAheadSeconds), 1, P::maxLookAheadFrames);
}

template <class P>
void LinkedLimiter<P>::process(float* const* io, int frames) noexcept {
    for (int n = 0; n < frames; ++n) {
        gain_ = advanceGain(neededGain(io, n));
        const auto now = static_cast<std::size_t>(position_);
        position_ = position_ + 1 == window_ ? 0 : position_ + 1;
        const auto oldest = static_cast<std::size_t>(position_);
        for (int j = 0; j < channels_; ++j) {
            const auto channel = static_cast<std::size_t>(j);
            delayed_[channel][now] = io[j][n];
            float y = delayed_[channel][oldest] * gain_;
            // The product may round up past the ceiling by its last bit, or down into the denormals.
            if (enabled_) y = std::clamp(y, -ceilings_[channel], ceilings_[channel]);
            io[j][n] = std::abs(y) < std::numeric_limits<float>::min() ? 0.0f : y;
        }
    }
}

template <class P>
float LinkedLimiter<P>::clean(float sample) noexcept {
    const float size = std::abs(sample);
    if (size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max()) return sample;
    if (!(size < std::numeric_limits<float>::min())) ++nonFinite_;
    return 0.0f;
}

// Cleans frame n and tells the gain, in units, that keeps every channel that is heard at its ceiling.
template <class P>
std::int64_t LinkedLimiter<P>::neededGain(float* const* io, int n) noexcept {
    Real excess = 1;
    for (int j = 0; j < channels_; ++j) {
        const auto channel = static_cast<std::size_t>(j);
        io[j][n] = clean(io[j][n]);
        excess = std::max(excess, static_cast<Real>(std::abs(io[j][n])) / static_cast<Real>(ceilings_[channel]));
    }
    return enabled_ && excess > 1 ? static_cast<std::int64_t>(static_cast<Real>(unit) / excess) : unit;
}

// The classic monotone queue: whoever needs more gain than a newcomer will never be the minimum again.
template <class P>
std::int64_t LinkedLimiter<P>::slidingMinimum(std::int64_t needed) noexcept {
    const auto at = [this](std::size_t k) -> Candidate& { return candidates_[(front_ + k) % candidates_.size()]; };
    while (candidateCount_ > 0 && at(candidateCount_ - 1).needed >= needed) --candidateCount_;
    at(candidateCount_++) = {needed, frame_};
    if (at(0).frame + window_ <= frame_) {
        front_ = (front_ + 1) % candidates_.size();
        --candidateCount_;
    }
    ++frame_;
    return at(0).needed;
}

template <class P>
float LinkedLimiter<P>::advanceGain(std::int64_t needed) noexcept {
    released_ = std::min(slidingMinimum(needed), released_ + releaseStep_);
    auto& oldest = averaged_[static_cast<std::size_t>(position_)];
    sum_ += released_ - oldest;
    oldest = released_;
    return static_cast<float>(static_cast<Real>(sum_) / static_cast<Real>(unit * window_));
}

template class LinkedLimiter<DesktopProfile>;
template class LinkedLimiter<BoardProfile>;

} // namespace physvib
