// SPDX-License-Identifier: MIT
// Sliding minimum, linear release, moving average, delayed multiply.
#include "Core/Actuators/LinkedLimiter.h"
#include <algorithm>
#include <bit>
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
    silentFrames_ = 0;
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
void LinkedLimiter<P>::process(float* const* io, int frames, bool isSilent) noexcept {
    if (isSilent && silentFrames_ >= window_ && isResting()) return rest(static_cast<std::size_t>(frames));
    silentFrames_ = isSilent ? silentFrames_ + frames : 0;
    const auto all = static_cast<std::size_t>(frames);
    for (std::size_t first = 0; first < all; first += partMost) processPart(io, first, std::min(partMost, all - first));
}

// Channel by channel, so that the loops over frames are vectors.
template <class P>
void LinkedLimiter<P>::processPart(float* const* io, std::size_t first, std::size_t frames) noexcept {
    bool isOver = false;
    for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j)
        if (cleanAndCompare(io[j] + first, frames, ceilings_[j])) isOver = true;
    Gains gains;
    if (!isOver && isResting()) {
        gains.fill(1.0f);
        rest(frames);
    } else {
        followGains(io, first, frames, gains);
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j) delayAndLimit(j, io[j] + first, frames, gains);
}

// True if a sample exceeds the ceiling. Sizes are compared as integers, which order as the floats do (IEEE 754).
template <class P>
bool LinkedLimiter<P>::cleanAndCompare(float* samples, std::size_t frames, float ceiling) noexcept {
    constexpr std::int32_t least = 0x00800000, infinite = 0x7f800000;
    std::int32_t most = 0, bad = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        const auto bits = std::bit_cast<std::int32_t>(samples[n]);
        const std::int32_t size = bits & 0x7fffffff;
        const std::int32_t isFinite = size < infinite ? -1 : 0, isNormal = size >= least ? isFinite : 0;
        bad += 1 + isFinite;
        most = std::max(most, size & isNormal);
        samples[n] = std::bit_cast<float>(bits & isNormal);
    }
    nonFinite_ += static_cast<std::uint64_t>(bad);
    return enabled_ && most > std::bit_cast<std::int32_t>(ceiling);
}

// The gain, in units, that keeps every channel that is heard at its ceiling, and what the limiter makes of it.
template <class P>
void LinkedLimiter<P>::followGains(float* const* io, std::size_t first, std::size_t frames, Gains& gains) noexcept {
    std::array<Real, partMost> excess;
    excess.fill(1);
    for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j)
        for (std::size_t n = 0; n < frames; ++n)
            excess[n] = std::max(excess[n], static_cast<Real>(std::abs(io[j][first + n])) / static_cast<Real>(ceilings_[j]));
    for (std::size_t n = 0; n < frames; ++n) {
        const bool isOver = enabled_ && excess[n] > 1;
        gain_ = gains[n] = advanceGain(isOver ? static_cast<std::int64_t>(static_cast<Real>(unit) / excess[n]) : unit);
        position_ = position_ + 1 == window_ ? 0 : position_ + 1;
    }
}

// Nothing was over for a window and nothing is: the gain is 1, and the next window starts from here.
template <class P>
void LinkedLimiter<P>::rest(std::size_t frames) noexcept {
    gain_ = 1.0f;
    frame_ += static_cast<std::int64_t>(frames);
    candidates_[front_] = {unit, frame_ - 1};
    candidateCount_ = 1;
}

template <class P>
void LinkedLimiter<P>::delayAndLimit(std::size_t channel, float* samples, std::size_t frames, const Gains& gains) noexcept {
    const auto latency = static_cast<std::size_t>(latencyFrames());
    std::array<float, windowMax + partMost> line; // delayed frames, then new ones
    std::copy_n(delayed_[channel].begin(), latency, line.begin());
    std::copy_n(samples, frames, line.begin() + static_cast<std::ptrdiff_t>(latency));
    std::copy_n(line.begin() + static_cast<std::ptrdiff_t>(frames), latency, delayed_[channel].begin());
    // The product may round up past the ceiling by its last bit, or down into the denormals.
    const float ceiling = enabled_ ? ceilings_[channel] : std::numeric_limits<float>::infinity();
    for (std::size_t n = 0; n < frames; ++n) {
        const float y = std::min(std::max(line[n] * gains[n], -ceiling), ceiling);
        samples[n] = std::abs(y) < std::numeric_limits<float>::min() ? 0.0f : y;
    }
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
