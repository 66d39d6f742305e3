// SPDX-License-Identifier: MIT
// Linked look-ahead limiter: one gain for all channels, so that a phantom stays in place while no channel
// exceeds its ceiling.
//
// Window of W frames (limits::limiterLookAheadSeconds): the lowest gain that any of the last W frames needs
// (sliding minimum), released linearly, averaged over W frames, applied to the input of W - 1 frames ago.
// Each averaged value is at most what the delayed frame needs, so the ceiling holds. The average limits the
// attack's slope to 1/W per frame, the release to 1/(limits::limiterReleaseSeconds * rate). Gains are
// integers (2^30 = 1): their running sum neither drifts nor differs between machines, and the gain returns to
// exactly 1. A change of ceiling is a ramp of at most limits::channelRampSeconds: each frame is limited by
// the ceiling of its own time.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include "Core/Modes/InstructionSet.h"
#include "Core/Storage.h"
#include <array>
#include <cstdint>

namespace physvib {

struct LimiterKernel;
struct LimiterLines;

/// R only, but for prepare: M.
class LinkedLimiter {
public:
    /// Resets everything; ceilings 1. If disabled, it only delays and replaces invalid samples. The bits do
    /// not depend on the instruction set. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, int channels, bool enabled,
                 InstructionSet set = InstructionSet::best) noexcept;

    /// Largest absolute sample of that channel, > 0 and finite. After the first frame it changes in a ramp.
    void setCeiling(int channel, float ceiling) noexcept;

    /// In place: io[channel][0..frames) becomes the limited input of latencyFrames() earlier. NaN, infinite
    /// and denormal samples become 0 (those that are not finite are counted). `isSilent`: all input is +0; if
    /// the delayed frames are 0 too, nothing is computed. True if the output is silent.
    bool process(float* const* io, int frames, bool isSilent = false) noexcept;

    /// The same from `in` to `out`, and `in` is copied to `kept`. Only if canPass.
    void pass(const float* const* in, float* const* out, int frames, float* const* kept) noexcept;
    bool canPass() const noexcept { return kernel_ != nullptr; }

    int latencyFrames() const noexcept { return window_ - 1; }
    static int latencyFramesAt(int sampleRateHz) noexcept { return windowAt(sampleRateHz) - 1; }
    double maxAttackPerFrame() const noexcept { return 1.0 / window_; }
    double maxReleasePerFrame() const noexcept { return static_cast<double>(releaseStep_) / unit; }
    float gain() const noexcept { return gain_; } ///< the last one applied
    std::uint64_t nonFiniteSamples() const noexcept { return nonFinite_; }

private:
    static constexpr std::int64_t unit = std::int64_t{1} << 30;
    static constexpr auto windowMax = static_cast<std::size_t>(limits::maxLookAheadFrames);
    static constexpr auto width = static_cast<std::size_t>(limits::maxEnchanters);

    static constexpr auto partMost = static_cast<std::size_t>(limits::tileFrames);
    using Gains = std::array<float, partMost>;

    static int windowAt(int sampleRateHz) noexcept;
    void processAll(const float* const* in, float* const* out, int frames, float* const* kept) noexcept;
    void processPart(const LimiterLines& lines) noexcept;
    bool takeIn(const LimiterLines& lines) noexcept;
    void giveOut(const LimiterLines& lines, const float* gains) noexcept;
    bool cleanAndCompare(const float* samples, std::size_t frames, std::int32_t mostBits,
                         float* line) noexcept;
    void followGains(const LimiterLines& lines, Gains& gains) noexcept;
    void delayAndLimit(float* line, float* samples, std::size_t frames, const float* gains,
                       float ceiling) const noexcept;
    bool isResting() const noexcept { return released_ == unit && sum_ == unit * window_; }
    void rest(std::size_t frames) noexcept;
    void boundBy(std::size_t channel, float ceiling) noexcept;
    void settle() noexcept;
    std::int64_t slidingMinimum(std::int64_t needed) noexcept;
    float advanceGain(std::int64_t needed) noexcept;

    int channels_ = 1;
    int window_ = 1;
    bool enabled_ = true;
    std::int64_t releaseStep_ = unit;
    static constexpr std::size_t step = 16, // floats of the widest vector
        floatsPerLine = (windowMax + partMost + 2 * step - 2) / step * step;
    // of latencyFrames(), whole vectors
    std::size_t front() const noexcept {
        return (static_cast<std::size_t>(window_) + step - 2) / step * step;
    }
    const LimiterKernel* kernel_ = nullptr;
    std::array<GainRamp, width> ceilings_{}; // of the input
    std::array<float, width> bounds_{}; // ceiling of the output, during a ramp the highest; infinite if the
                                        // limiter is off
    std::array<std::int32_t, width> mostBits_{}; // magnitudes up to this need no reduction, even at the
                                                 // lowest ceiling of a ramp, and are finite
    std::int64_t settledFrame_ = 0; // from here on no delayed frame is subject to a ramp's ceiling
    int rampFrames_ = 1;
    bool isSettled_ = true;
    Storage<float, width * floatsPerLine, true> lines_; // per channel the last latencyFrames() inputs, in
                                                        // order
    std::int64_t silentFrames_ = 0;                     // trailing silent inputs
    int position_ = 0;                                  // in the ring of `window_` gains
    std::int64_t frame_ = 0;
    struct Candidate {
        std::int64_t needed = unit;
        std::int64_t frame = 0;
    };
    std::array<Candidate, windowMax + 1> candidates_{}; // rising gains: the front is the window's minimum
    std::size_t front_ = 0;
    std::size_t candidateCount_ = 0;
    std::int64_t released_ = unit;
    std::array<std::int64_t, windowMax> averaged_{};
    std::int64_t sum_ = 0;
    float gain_ = 1.0f;
    std::uint64_t nonFinite_ = 0;
};

} // namespace physvib
