// SPDX-License-Identifier: MIT
// Implementation of the look-ahead limiter: sliding minimum, linear release, moving average, delayed
// multiplication.
#include "Core/Actuators/OutputGuard.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace physvib {

static constexpr std::int32_t infiniteBits = 0x7f800000;

bool LinkedLimiter::prepare(int sampleRateHz, int channels, bool isEnabled, InstructionSet set) noexcept {
    channels_ = channels;
    isEnabled_ = isEnabled;
    window_ = windowAt(sampleRateHz);
    releaseStep_ = static_cast<std::int64_t>(unit / (sampleRateHz * limits::limiterReleaseSeconds));
    const TileKernel* kernels = tileKernel(set);
    kernel_ = kernels != nullptr ? &kernels->limiter : nullptr;
    const auto floats = static_cast<std::size_t>(channels) * floatsPerLine;
    if (!lines_.resize(floats)) return false;
    std::fill_n(lines_.data(), floats, 0.0f);
    silentFrames_ = 0;
    position_ = 0;
    frame_ = 0;
    firstCandidate_ = candidateCount_ = 0;
    releasedGain_ = unit;
    averagedGains_.fill(unit);
    sum_ = unit * window_;
    gain_ = 1.0f;
    nonFinite_ = 0;
    rampFrames_ = static_cast<int>(limits::channelRampSeconds * sampleRateHz);
    isSettled_ = true;
    for (int j = 0; j < limits::maxActuators; ++j) {
        ceilings_[static_cast<std::size_t>(j)].prepare(sampleRateHz, limits::channelRampSeconds, 1.0f);
        setCeiling(j, 1.0f);
    }
    return true;
}

void LinkedLimiter::setCeiling(int channel, float ceiling) noexcept {
    const auto j = static_cast<std::size_t>(channel);
    if (frame_ == 0) { // before the first frame the ceiling needs no ramp
        ceilings_[j].jumpTo(ceiling);
        return setBound(j, ceiling);
    }
    const float before = bounds_[j];
    ceilings_[j].moveTo(ceiling, rampFrames_);
    setBound(j, ceilings_[j].minAhead());
    bounds_[j] = std::max({before, bounds_[j], isEnabled_ ? ceiling : 0.0f});
    settledFrame_ = frame_ + rampFrames_ + latencyFrames();
    isSettled_ = false;
}

void LinkedLimiter::setBound(std::size_t channel, float ceiling) noexcept {
    bounds_[channel] = isEnabled_ ? ceiling : std::numeric_limits<float>::infinity();
    maxBits_[channel] = std::min(std::bit_cast<std::int32_t>(bounds_[channel]), infiniteBits - 1);
}

void LinkedLimiter::settle() noexcept {
    if (isSettled_ || frame_ < settledFrame_) return;
    for (std::size_t j = 0; j < width; ++j) setBound(j, ceilings_[j].current());
    isSettled_ = true;
}

int LinkedLimiter::windowAt(int sampleRateHz) noexcept {
    return std::clamp(static_cast<int>(sampleRateHz * limits::limiterLookAheadSeconds), 1,
                      limits::maxLookAheadFrames);
}

bool LinkedLimiter::process(float* const* io, int frames, bool isSilent) noexcept {
    if (isSilent && silentFrames_ >= window_ && isResting()) {
        skipFrames(static_cast<std::size_t>(frames));
        return true;
    }
    silentFrames_ = isSilent ? silentFrames_ + frames : 0;
    processAll(io, io, frames, nullptr);
    return false;
}

void LinkedLimiter::processInto(const float* const* in, float* const* out, int frames,
                                float* const* copy) noexcept {
    silentFrames_ = 0;
    processAll(in, out, frames, copy);
}

void LinkedLimiter::processAll(const float* const* in, float* const* out, int frames,
                               float* const* copy) noexcept {
    const auto all = static_cast<std::size_t>(frames);
    for (std::size_t first = 0, part; first < all; first += part) {
        settle();
        part = std::min(maxPartFrames, all - first);
        if (!isSettled_) part = std::min(part, static_cast<std::size_t>(settledFrame_ - frame_));
        processPart({in, out, first, part, static_cast<std::size_t>(channels_), lines_.data(), copy,
                     floatsPerLine, frontFloats(), static_cast<std::size_t>(latencyFrames())});
    }
}

// Processes channel by channel, so that the loops over frames are vectorised.
void LinkedLimiter::processPart(const LimiterLines& lines) noexcept {
    if (!storeInputs(lines) && isResting()) {
        skipFrames(lines.frames);
        return writeOutputs(lines, nullptr);
    }
    Gains gains;
    followGains(lines, gains);
    writeOutputs(lines, gains.data());
}

// True if a sample exceeds its ceiling.
bool LinkedLimiter::storeInputs(const LimiterLines& lines) noexcept {
    if (kernel_ != nullptr && !kernel_->storeInputs(lines, maxBits_.data())) return false;
    bool isOver = false;
    for (std::size_t j = 0; j < lines.channels; ++j)
        if (cleanAndCompare(lines.in[j] + lines.first, lines.frames, maxBits_[j],
                            lines.line(j) + lines.front))
            isOver = true;
    return isOver;
}

void LinkedLimiter::writeOutputs(const LimiterLines& lines, const float* gains) noexcept {
    if (kernel_ != nullptr) return kernel_->writeOutputs(lines, gains, bounds_.data());
    for (std::size_t j = 0; j < lines.channels; ++j)
        delayAndLimit(lines.line(j), lines.out[j] + lines.first, lines.frames, gains, bounds_[j]);
}

// Magnitudes are compared as integers, which order as the floats do (IEEE 754).
bool LinkedLimiter::cleanAndCompare(const float* samples, std::size_t frames, std::int32_t maxBits,
                                    float* line) noexcept {
    constexpr std::int32_t minBits = 0x00800000;
    std::int32_t maxMagnitude = 0, nonFinite = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        const auto bits = std::bit_cast<std::int32_t>(samples[n]);
        const std::int32_t magnitude = bits & 0x7fffffff;
        const std::int32_t isFinite = magnitude < infiniteBits ? -1 : 0,
                           isNormal = magnitude >= minBits ? isFinite : 0;
        nonFinite += 1 + isFinite;
        maxMagnitude = std::max(maxMagnitude, magnitude & isNormal);
        line[n] = std::bit_cast<float>(bits & isNormal);
    }
    nonFinite_ += static_cast<std::uint64_t>(nonFinite);
    return maxMagnitude > maxBits;
}

// For each frame: the gain that keeps every channel within its ceiling, then the limiter's smoothed gain.
void LinkedLimiter::followGains(const LimiterLines& lines, Gains& gains) noexcept {
    std::array<double, maxPartFrames> excess;
    excess.fill(1);
    for (std::size_t j = 0; j < lines.channels; ++j) {
        const float* const samples = lines.line(j) + lines.front;
        const auto compare = [&](std::size_t n, float ceiling) {
            excess[n] =
                std::max(excess[n], static_cast<double>(std::abs(samples[n])) / static_cast<double>(ceiling));
        };
        std::size_t n = 0;
        while (n < lines.frames && !ceilings_[j].isResting()) compare(n++, ceilings_[j].next());
        for (const float ceiling = ceilings_[j].current(); n < lines.frames; ++n) compare(n, ceiling);
    }
    for (std::size_t n = 0; n < lines.frames; ++n) {
        const bool isOver = isEnabled_ && excess[n] > 1;
        gain_ = gains[n] =
            advanceGain(isOver ? static_cast<std::int64_t>(static_cast<double>(unit) / excess[n]) : unit);
        position_ = position_ + 1 == window_ ? 0 : position_ + 1;
    }
}

// No sample needed a reduction for a whole window: the gain is 1, and the sliding minimum restarts here.
void LinkedLimiter::skipFrames(std::size_t frames) noexcept {
    gain_ = 1.0f;
    frame_ += static_cast<std::int64_t>(frames);
    if (!isSettled_)
        for (std::size_t j = 0; j < width; ++j) ceilings_[j].skip(static_cast<int>(frames));
    candidates_[firstCandidate_] = {unit, frame_ - 1};
    candidateCount_ = 1;
}

// Rounding may lift the product above the ceiling by one bit, or lower it to a denormal; both are corrected.
void LinkedLimiter::delayAndLimit(float* line, float* samples, std::size_t frames, const float* gains,
                                  float ceiling) const noexcept {
    const float* const delayed = line + frontFloats() - latencyFrames();
    const auto limited = [ceiling](float x, float gain) {
        const float y = std::min(std::max(x * gain, -ceiling), ceiling);
        return std::abs(y) < std::numeric_limits<float>::min() ? 0.0f : y;
    };
    if (gains != nullptr)
        std::transform(delayed, delayed + frames, gains, samples, limited);
    else
        std::copy_n(delayed, frames, samples); // within its ceiling when it came
    std::copy_n(line + frames, frontFloats(), line);
}

// Monotone queue: an entry that needs at least the newcomer's gain can never be the minimum again.
std::int64_t LinkedLimiter::slidingMinimum(std::int64_t neededGain) noexcept {
    const auto at = [this](std::size_t k) -> Candidate& {
        return candidates_[(firstCandidate_ + k) % candidates_.size()];
    };
    while (candidateCount_ > 0 && at(candidateCount_ - 1).neededGain >= neededGain) --candidateCount_;
    at(candidateCount_++) = {neededGain, frame_};
    if (at(0).frame + window_ <= frame_) {
        firstCandidate_ = (firstCandidate_ + 1) % candidates_.size();
        --candidateCount_;
    }
    ++frame_;
    return at(0).neededGain;
}

float LinkedLimiter::advanceGain(std::int64_t neededGain) noexcept {
    releasedGain_ = std::min(slidingMinimum(neededGain), releasedGain_ + releaseStep_);
    auto& oldest = averagedGains_[static_cast<std::size_t>(position_)];
    sum_ += releasedGain_ - oldest;
    oldest = releasedGain_;
    return static_cast<float>(static_cast<double>(sum_) / static_cast<double>(unit * window_));
}

} // namespace physvib
